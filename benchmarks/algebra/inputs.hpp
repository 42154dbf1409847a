// SPDX-License-Identifier: MIT
// Random operands, and one operand in three representations: naive, with its form as a flag, with
// its form as a type.
//
// The arrays are small enough for the first-level cache and too varied for the compiler to know
// anything about them.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <deque>
#include <numbers>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include <malus/analyzer.hpp>
#include <malus/form.hpp>
#include <malus/importance.hpp>
#include <malus/mueller.hpp>
#include <malus/stokes.hpp>

#include "../naive.hpp"

namespace inputs {

template <class T>
inline constexpr std::size_t count = 256 / sizeof(T);

template <class T>
using Rgb = malus::Spectrum<T, naive::channels>;

/// Three directions a light path takes one after the other; frames of one place describe light of
/// one direction.
enum class Place : unsigned { first, second, third };

struct Here {};
template <class T>
using SharedFrame = malus::StaticFrame<Here>;

/// Operands live as long as the program. An operation holds but their addresses, which stay in
/// registers while it is timed.
template <class Q>
std::span<const Q> kept(std::vector<Q> operands) {
  static std::deque<std::vector<Q>> all;
  return all.emplace_back(std::move(operands));
}

template <class T>
T random(std::mt19937& generator, double from, double to) {
  return static_cast<T>(std::uniform_real_distribution<double>(from, to)(generator));
}

template <class T>
std::span<const malus::Frame<T>> frames(Place place, unsigned seed) {
  std::mt19937 directions(static_cast<unsigned>(place)), turns(seed);
  std::vector<malus::Frame<T>> result;
  for (std::size_t i = 0; i < count<T>; ++i) {
    const double z = random<double>(directions, -1, 1), r = std::sqrt(1 - z * z);
    const double phi = random<double>(directions, 0, 2 * std::numbers::pi);
    const std::array<double, 3> d{r * std::cos(phi), r * std::sin(phi), z};
    result.push_back(malus::Frame<T>::about(d).turned(random<T>(turns, 0, std::numbers::pi)));
  }
  return kept(std::move(result));
}

template <class T>
std::span<const naive::Stokes<T>> lights(Place place, unsigned seed,
                                         malus::StokesForm form = malus::StokesForm::full) {
  std::mt19937 generator(seed);
  const auto frame = frames<T>(place, seed + 1);
  std::vector<naive::Stokes<T>> result(count<T>);
  for (std::size_t i = 0; i < count<T>; ++i) {
    result[i].frame = frame[i];
    for (auto& s : result[i].value)
      for (int r = 0; r < 4; ++r)
        s[r] = malus::detail::slot(form, r) < 0 ? T(0) : random<T>(generator, r == 0 ? 1 : -1, 1.5);
  }
  return kept(std::move(result));
}

/// Components that share a place among a form's values are equal; those without one are zero.
template <class T, class Form>
glm::mat<4, 4, T> random_matrix(std::mt19937& generator, Form form) {
  std::array<T, 16> value;
  for (T& v : value) v = random<T>(generator, 0.1, 1);
  glm::mat<4, 4, T> matrix;
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c) {
      const int place = malus::detail::slot(form, r, c);
      matrix[c][r] = place < 0 ? T(0) : value[static_cast<std::size_t>(place)];
    }
  return matrix;
}

/// From one place to the next.
template <class T>
std::span<const naive::Mueller<T>> matrices(Place from, Place to, unsigned seed,
                                            malus::MuellerForm form) {
  std::mt19937 generator(seed);
  const auto enter = frames<T>(from, seed + 1), exit = frames<T>(to, seed + 2);
  std::vector<naive::Mueller<T>> result(count<T>);
  for (std::size_t i = 0; i < count<T>; ++i) {
    // A collinear matrix has no frames: the naive one is given one on both sides.
    result[i].enter = enter[i];
    result[i].exit = malus::is_collinear(form) ? enter[i] : exit[i];
    for (auto& m : result[i].value) m = random_matrix<T>(generator, form);
  }
  return kept(std::move(result));
}

template <class T>
std::span<const naive::Importance<T>> importances(Place place, unsigned seed,
                                                  malus::ImportanceForm form) {
  std::mt19937 generator(seed);
  const auto frame = frames<T>(place, seed + 1);
  std::vector<naive::Importance<T>> result(count<T>);
  for (std::size_t i = 0; i < count<T>; ++i) {
    result[i].frame = frame[i];
    for (auto& w : result[i].value) w = random_matrix<T>(generator, form);
  }
  return kept(std::move(result));
}

template <class T>
std::span<const naive::Value<T>> values(unsigned seed) {
  std::mt19937 generator(seed);
  std::vector<naive::Value<T>> result(count<T>);
  for (auto& value : result)
    for (T& x : value) x = random<T>(generator, 0.1, 1);
  return kept(std::move(result));
}

// the library's representations of the same

template <class F, class T>
F frame_as(const malus::Frame<T>& frame) {
  if constexpr (malus::StaticFrameType<F>)
    return F{};
  else
    return frame;
}

template <class T>
Rgb<T> spectrum(const naive::Value<T>& value) {
  return Rgb<T>(value[0], value[1], value[2]);
}

template <class T>
Rgb<T> component(const std::array<glm::mat<4, 4, T>, naive::channels>& m, int r, int c) {
  return {m[0][c][r], m[1][c][r], m[2][c][r]};
}

template <class T>
std::array<Rgb<T>, 4> row(const std::array<glm::mat<4, 4, T>, naive::channels>& m, int r) {
  return {component(m, r, 0), component(m, r, 1), component(m, r, 2), component(m, r, 3)};
}

/// A Stokes vector or an Analyzer, whose four components are of one shape.
template <class Q, class T>
Q four_as(const naive::Stokes<T>& s) {
  const auto v = [&](int r) { return Rgb<T>(s.value[0][r], s.value[1][r], s.value[2][r]); };
  if constexpr (Q::static_form == malus::StokesForm::unpolarized)
    return Q::unpolarized(v(0));
  else
    return Q(v(0), v(1), v(2), v(3), frame_as<typename Q::frame_type>(s.frame));
}

template <class M, class T>
M mueller_as(const naive::Mueller<T>& naive) {
  using enum malus::MuellerForm;
  const auto& m = naive.value;
  constexpr auto form = M::static_form;
  if constexpr (form == plain) {
    return M::plain(component(m, 0, 0));
  } else if constexpr (form == depolarizing) {
    return M::depolarizing(component(m, 0, 0));
  } else {
    const auto enter = frame_as<typename M::enter_frame_type>(naive.enter);
    const auto exit = frame_as<typename M::exit_frame_type>(naive.exit);
    if constexpr (form == block)
      return M::block(
          {component(m, 0, 0), component(m, 0, 1), component(m, 1, 0), component(m, 1, 1)},
          {component(m, 2, 2), component(m, 2, 3), component(m, 3, 2), component(m, 3, 3)}, enter,
          exit);
    else
      return M::from_rows({row(m, 0), row(m, 1), row(m, 2), row(m, 3)}, enter, exit);
  }
}

template <class W, class T>
W importance_as(const naive::Importance<T>& naive) {
  const auto& w = naive.value;
  const auto frame = frame_as<typename W::frame_type>(naive.frame);
  if constexpr (W::static_form == malus::ImportanceForm::plain)
    return W::plain(component(w, 0, 0), frame);
  else
    return W::from_rows({row(w, 0), row(w, 1), row(w, 2), row(w, 3)}, frame);
}

/// All of them as quantities of type Q.
template <class Q, class Naive>
std::span<const Q> as(std::span<const Naive> naive) {
  std::vector<Q> result;
  for (const Naive& x : naive) {
    if constexpr (malus::MuellerType<Q>)
      result.push_back(mueller_as<Q>(x));
    else if constexpr (malus::ImportanceType<Q>)
      result.push_back(importance_as<Q>(x));
    else
      result.push_back(four_as<Q>(x));
  }
  return kept(std::move(result));
}

/// All of them with the form as a flag.
template <class Dynamic, class Static>
std::span<const Dynamic> flagged(std::span<const Static> quantities) {
  return kept(std::vector<Dynamic>(quantities.begin(), quantities.end()));
}

}  // namespace inputs
