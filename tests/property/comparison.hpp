// SPDX-License-Identifier: MIT
// Comparison of the library's results with the reference's, modulo frames. Comparisons return what
// differs, in words, and require_same fails a property with them.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <sstream>
#include <string>

#include "property/operands.hpp"

namespace test {

/// Rounding of a short chain of 4×4 products of numbers up to 2.
template <class T>
inline constexpr double tolerance = 400 * static_cast<double>(std::numeric_limits<T>::epsilon());

/// False for NaN.
template <class T>
bool agree(double got, double expected) {
  return std::abs(got - expected) <= tolerance<T> * (1 + std::abs(expected));
}

inline std::string describe(const std::string& what, std::size_t component, std::size_t channel,
                            double got, double expected) {
  std::ostringstream out;
  out.precision(10);
  out << what << ", component " << component << " of channel " << channel << ": got " << got
      << ", expected " << expected;
  return out.str();
}

/// Empty where the numbers agree, else what differs.
template <class T>
std::string difference(const std::string& what, double got, double expected) {
  return agree<T>(got, expected) ? std::string() : describe(what, 0, 0, got, expected);
}

template <malus::SpectralValue V>
std::string difference(const V& got, const std::array<double, channels<V>>& expected) {
  for (std::size_t i = 0; i < channels<V>; ++i) {
    const double x = static_cast<double>(malus::channel(got, i));
    if (!agree<malus::scalar_t<V>>(x, expected[i])) return describe("value", 0, i, x, expected[i]);
  }
  return {};
}

template <class T, class Q>
std::string matrix_difference(const Q& got, std::size_t i, const reference::Matrix& expected) {
  for (std::size_t k = 0; k < 16; ++k) {
    const double x = static_cast<double>(
        malus::channel(got(static_cast<int>(k / 4), static_cast<int>(k % 4)), i));
    if (!agree<T>(x, expected[k / 4][k % 4]))
      return describe(name(got.form()), k, i, x, expected[k / 4][k % 4]);
  }
  return {};
}

template <class V, class Q>
std::string vector_difference(const std::string& what, const Q& got, std::size_t i,
                              const reference::Vector& expected) {
  for (std::size_t k = 0; k < 4; ++k) {
    const double x = static_cast<double>(malus::channel(got[k], i));
    if (!agree<malus::scalar_t<V>>(x, expected[k])) return describe(what, k, i, x, expected[k]);
  }
  return {};
}

/// Compares a Mueller matrix with the reference's, modulo frames.
template <class M, class V = typename M::value_type>
std::string difference(const M& got, const Matrices<V>& expected)
  requires malus::MuellerType<M>
{
  using T = malus::scalar_t<V>;
  const MuellerForm form = got.form();
  const reference::Axes from_enter = to_axes(expected.enter), from_exit = to_axes(expected.exit);
  reference::Axes enter = from_enter;
  reference::Axes exit = is_collinear(form) ? from_enter : from_exit;
  if constexpr (needs_enter_frame(M::static_form))
    if (needs_enter_frame(form)) enter = to_axes(got.enter());
  if constexpr (needs_exit_frame(M::static_form))
    if (needs_exit_frame(form)) exit = to_axes(got.exit());
  for (std::size_t i = 0; i < channels<V>; ++i) {
    const reference::Matrix m = reference::rotation(from_exit, exit) * expected.m[i] *
                                reference::rotation(enter, from_enter);
    const std::string d = matrix_difference<T>(got, i, m);
    if (!d.empty()) return d;
  }
  return {};
}

template <class W, class V = typename W::value_type>
std::string difference(const W& got, const Measurements<V>& expected)
  requires malus::ImportanceType<W>
{
  const reference::Axes from = to_axes(expected.frame);
  reference::Axes to = from;
  if constexpr (needs_frame(W::static_form))
    if (needs_frame(got.form())) to = to_axes(got.frame());
  for (std::size_t i = 0; i < channels<V>; ++i) {
    const std::string d = matrix_difference<malus::scalar_t<V>>(
        got, i, expected.m[i] * reference::rotation(to, from));
    if (!d.empty()) return d;
  }
  return {};
}

/// Compares light, or a row, with the reference's, modulo frames.
template <class S, class V = typename S::value_type>
std::string difference(const S& got, const Vectors<V>& expected)
  requires(malus::StokesType<S> || malus::AnalyzerType<S>)
{
  const reference::Axes from = to_axes(expected.frame);
  reference::Axes to = from;
  if constexpr (needs_frame(S::static_form))
    if (needs_frame(got.form())) to = to_axes(got.frame());
  for (std::size_t i = 0; i < channels<V>; ++i) {
    const std::string d = vector_difference<V>(name(got.form()), got, i,
                                               reference::rotation(from, to) * expected.v[i]);
    if (!d.empty()) return d;
  }
  return {};
}

template <class V>
std::string difference(const malus::Measurement<V>& got,
                       const std::array<reference::Vector, channels<V>>& expected) {
  for (std::size_t i = 0; i < channels<V>; ++i) {
    const std::string d = vector_difference<V>("readings", got, i, expected[i]);
    if (!d.empty()) return d;
  }
  return {};
}

/// Fails the property, naming the operands.
inline void require_same(const std::string& operands, const std::string& found) {
  if (!found.empty()) RC_FAIL(operands + ": " + found);
}
template <class Form>
void require_form(const std::string& operands, Form got, Form expected) {
  if (got != expected) RC_FAIL(operands + ": the form is " + name(got) + ", not " + name(expected));
}

}  // namespace test
