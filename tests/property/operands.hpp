// SPDX-License-Identifier: MIT
// Operands for property tests: each is drawn as plain numbers and axes, of which both the library's
// quantity and the reference's full matrix are made.
//
// Whatever lies behind a flag (values beyond the form's, frames that the form doesn't need) is
// filled with NaN, so that any operation that reads it gives itself away.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <rapidcheck.h>

#include <malus/adjoint.hpp>
#include <malus/propagate.hpp>
#include <malus/sum.hpp>

#include "property/reference_algebra.hpp"

namespace test {

using malus::ImportanceForm;
using malus::MuellerForm;
using malus::StokesForm;

inline constexpr std::array all_mueller_forms = {
    MuellerForm::zero,
    MuellerForm::plain,
    MuellerForm::partial,
    MuellerForm::depolarizing,
    MuellerForm::depolarizing_enter,
    MuellerForm::depolarizing_exit,
    MuellerForm::block,
    MuellerForm::full,
};
inline constexpr std::array all_stokes_forms = {StokesForm::zero, StokesForm::unpolarized,
                                                StokesForm::full};
inline constexpr std::array all_importance_forms = {ImportanceForm::zero, ImportanceForm::plain,
                                                    ImportanceForm::depolarizing,
                                                    ImportanceForm::full};

inline std::string name(MuellerForm f) {
  constexpr const char* names[] = {
      "zero",  "plain", "partial", "depolarizing", "depolarizing_enter", "depolarizing_exit",
      "block", "full",  "dynamic"};
  return names[static_cast<std::size_t>(f)];
}
inline std::string name(StokesForm f) {
  constexpr const char* names[] = {"zero", "unpolarized", "full", "dynamic"};
  return names[static_cast<std::size_t>(f)];
}
inline std::string name(ImportanceForm f) {
  constexpr const char* names[] = {"zero", "plain", "depolarizing", "full", "dynamic"};
  return names[static_cast<std::size_t>(f)];
}

// Drawing

/// A number of [−2, 2] that float holds exactly.
inline rc::Gen<double> component() {
  return rc::gen::map(rc::gen::inRange(-1024, 1025), [](int i) { return i / 512.0; });
}
inline rc::Gen<double> positive() {
  return rc::gen::map(rc::gen::inRange(1, 1025), [](int i) { return i / 512.0; });
}
/// Degrees of a whole turn, in radians.
inline rc::Gen<double> angle() {
  return rc::gen::map(rc::gen::inRange(-1800, 1801),
                      [](int i) { return i * std::numbers::pi / 1800; });
}
inline rc::Gen<std::vector<double>> components(std::size_t count) {
  return rc::gen::container<std::vector<double>>(count, component());
}

inline reference::Axis direction_of(double polar, double azimuth) {
  return {std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
          std::cos(polar)};
}
/// Any direction of the sphere, the poles and the equator among them.
inline rc::Gen<reference::Axis> direction() {
  return rc::gen::apply(
      direction_of,
      rc::gen::map(rc::gen::inRange(0, 181), [](int i) { return i * std::numbers::pi / 180; }),
      angle());
}

/// The frame about a direction whose x lies at an angle to the polar one.
inline reference::Axes axes_about(const reference::Axis& d, double turn) {
  const std::size_t least = std::abs(d[0]) < std::abs(d[1])
                                ? (std::abs(d[0]) < std::abs(d[2]) ? 0 : 2)
                                : (std::abs(d[1]) < std::abs(d[2]) ? 1 : 2);
  reference::Axis e{};
  e[least] = 1;
  reference::Axis x = reference::cross(e, d);
  const double length = std::sqrt(reference::dot(x, x));
  for (double& component : x) component /= length;
  const reference::Axis y = reference::cross(d, x);
  reference::Axes axes{};
  for (std::size_t i = 0; i < 3; ++i) {
    axes.x[i] = std::cos(turn) * x[i] + std::sin(turn) * y[i];
    axes.y[i] = std::cos(turn) * y[i] - std::sin(turn) * x[i];
  }
  return axes;
}

template <class T>
malus::Frame<T> to_frame(const reference::Axes& axes) {
  return {axes.x, axes.y};
}
template <class T>
reference::Axes to_axes(const malus::Frame<T>& frame) {
  reference::Axes axes{};
  for (int i = 0; i < 3; ++i) {
    axes.x[static_cast<std::size_t>(i)] = static_cast<double>(frame.x()[i]);
    axes.y[static_cast<std::size_t>(i)] = static_cast<double>(frame.y()[i]);
  }
  return axes;
}

template <class T>
malus::Frame<T> draw_frame(const reference::Axis& d) {
  return to_frame<T>(axes_about(d, *angle()));
}

// Which components a form may have, for the reference

/// 'a' is one value, 'b' another, '*' each its own, '.' zero.
inline const char* pattern(MuellerForm f) {
  constexpr const char* patterns[] = {"................", "a....a....a....a", "a....b....b....b",
                                      "*...............", "*...*...*...*...", "****............",
                                      "**..**....**..**", "****************"};
  return patterns[static_cast<std::size_t>(f)];
}
inline const char* pattern(ImportanceForm f) {
  constexpr const char* patterns[] = {"................", "a....a....a....a", "*...*...*...*...",
                                      "****************"};
  return patterns[static_cast<std::size_t>(f)];
}
inline const char* pattern(StokesForm f) {
  constexpr const char* patterns[] = {"....", "*...", "****"};
  return patterns[static_cast<std::size_t>(f)];
}

template <class Form>
reference::Matrix masked_matrix(Form form, const std::vector<double>& drawn, std::size_t offset) {
  reference::Matrix m{};
  for (std::size_t i = 0; i < 16; ++i) {
    const char kind = pattern(form)[i];
    if (kind == '*') m[i / 4][i % 4] = drawn[offset + i];
    if (kind == 'a') m[i / 4][i % 4] = drawn[offset];
    if (kind == 'b') m[i / 4][i % 4] = drawn[offset + 1];
  }
  return m;
}

// Operands

template <malus::SpectralValue V>
inline constexpr std::size_t channels = malus::channel_count<V>;

/// One value a channel: component i of all channels.
template <class V, class Read>
V value_of(Read&& read) {
  V value(malus::scalar_t<V>(0));
  for (std::size_t i = 0; i < channels<V>; ++i)
    malus::set_channel(value, i, static_cast<malus::scalar_t<V>>(read(i)));
  return value;
}

template <class T>
inline constexpr T not_a_number = std::numeric_limits<T>::quiet_NaN();

template <class T>
malus::Frame<T> poisoned_frame() {
  const std::array<T, 3> axis = {not_a_number<T>, not_a_number<T>, not_a_number<T>};
  return {axis, axis};
}

/// The same quantity with NaN behind its flag.
template <class Q>
Q poisoned(Q q) {
  using V = typename Q::value_type;
  using T = typename Q::scalar_type;
  using Access = malus::detail::Access;
  if constexpr (Q::is_dynamic) {
    for (std::size_t i = value_count(q.form()); i < value_count(Q::static_form); ++i)
      Access::values(q)[i] = V(not_a_number<T>);
    if constexpr (malus::MuellerType<Q>) {
      if (!needs_enter_frame(q.form())) Access::enter(q).frame = poisoned_frame<T>();
      if (!needs_exit_frame(q.form())) Access::exit(q).frame = poisoned_frame<T>();
    } else {
      if (!needs_frame(q.form())) Access::frame(q).frame = poisoned_frame<T>();
    }
  }
  return q;
}

/// A matrix as the reference sees it: one full 4×4 a channel, between two frames. A collinear one
/// has one frame.
template <class V>
struct Matrices {
  using T = malus::scalar_t<V>;
  MuellerForm form;
  std::array<reference::Matrix, channels<V>> m;
  malus::Frame<T> enter, exit;

  template <class In = malus::incident, class Out = malus::exitant>
  malus::Mueller<V, In, Out> quantity() const {
    using M = malus::Mueller<V, In, Out>;
    const auto at = [&](std::size_t r, std::size_t c) {
      return value_of<V>([&](std::size_t i) { return m[i][r][c]; });
    };
    using enum MuellerForm;
    switch (form) {
      case zero:
        return poisoned(M());
      case plain:
        return poisoned(M::plain(at(0, 0)));
      case partial:
        return poisoned(M::partial(at(0, 0), at(1, 1)));
      case depolarizing:
        return poisoned(M::depolarizing(at(0, 0)));
      case depolarizing_enter:
        return poisoned(M::depolarizing_enter({at(0, 0), at(1, 0), at(2, 0), at(3, 0)}, exit));
      case depolarizing_exit:
        return poisoned(M::depolarizing_exit({at(0, 0), at(0, 1), at(0, 2), at(0, 3)}, enter));
      case block:
        return poisoned(M::block({at(0, 0), at(0, 1), at(1, 0), at(1, 1)},
                                 {at(2, 2), at(2, 3), at(3, 2), at(3, 3)}, enter, exit));
      default: {
        typename M::rows_type rows;
        for (std::size_t r = 0; r < 4; ++r)
          for (std::size_t c = 0; c < 4; ++c) rows[r][c] = at(r, c);
        return poisoned(M::from_rows(rows, enter, exit));
      }
    }
  }
};

template <class V>
Matrices<V> matrices(MuellerForm form, const std::vector<double>& drawn,
                     const malus::Frame<malus::scalar_t<V>>& enter,
                     const malus::Frame<malus::scalar_t<V>>& exit) {
  Matrices<V> result{form, {}, enter, exit};
  for (std::size_t i = 0; i < channels<V>; ++i) result.m[i] = masked_matrix(form, drawn, 16 * i);
  return result;
}

/// Light or one row of a measurement.
template <class V>
struct Vectors {
  using T = malus::scalar_t<V>;
  StokesForm form;
  std::array<reference::Vector, channels<V>> v;
  malus::Frame<T> frame;

  V at(std::size_t k) const {
    return value_of<V>([&](std::size_t i) { return v[i][k]; });
  }
  template <class Side = malus::incident>
  malus::Stokes<V, Side> light() const {
    using S = malus::Stokes<V, Side>;
    if (form == StokesForm::zero) return poisoned(S());
    if (form == StokesForm::unpolarized) return poisoned(S::unpolarized(at(0)));
    return {at(0), at(1), at(2), at(3), frame};
  }
  template <class Side = malus::incident>
  malus::Analyzer<V, Side> analyzer() const {
    using W = malus::Analyzer<V, Side>;
    if (form == StokesForm::zero) return poisoned(W());
    if (form == StokesForm::unpolarized) return poisoned(W::intensity(at(0)));
    return {at(0), at(1), at(2), at(3), frame};
  }
};

template <class V>
Vectors<V> vectors(StokesForm form, const std::vector<double>& drawn,
                   const malus::Frame<malus::scalar_t<V>>& frame) {
  Vectors<V> result{form, {}, frame};
  for (std::size_t i = 0; i < channels<V>; ++i)
    for (std::size_t k = 0; k < 4; ++k)
      if (pattern(form)[k] == '*') result.v[i][k] = drawn[4 * i + k];
  return result;
}

/// Four simultaneous measurements.
template <class V>
struct Measurements {
  using T = malus::scalar_t<V>;
  ImportanceForm form;
  std::array<reference::Matrix, channels<V>> m;
  malus::Frame<T> frame;

  template <class Side = malus::incident>
  malus::Importance<V, Side> quantity() const {
    using W = malus::Importance<V, Side>;
    const auto at = [&](std::size_t r, std::size_t c) {
      return value_of<V>([&](std::size_t i) { return m[i][r][c]; });
    };
    using enum ImportanceForm;
    switch (form) {
      case zero:
        return poisoned(W());
      case plain:
        return poisoned(W::plain(at(0, 0), frame));
      case depolarizing:
        return poisoned(W::depolarizing({at(0, 0), at(1, 0), at(2, 0), at(3, 0)}));
      default: {
        typename W::rows_type rows;
        for (std::size_t r = 0; r < 4; ++r)
          for (std::size_t c = 0; c < 4; ++c) rows[r][c] = at(r, c);
        return poisoned(W::from_rows(rows, frame));
      }
    }
  }
};

template <class V>
Measurements<V> measurements(ImportanceForm form, const std::vector<double>& drawn,
                             const malus::Frame<malus::scalar_t<V>>& frame) {
  Measurements<V> result{form, {}, frame};
  for (std::size_t i = 0; i < channels<V>; ++i) result.m[i] = masked_matrix(form, drawn, 16 * i);
  return result;
}

}  // namespace test
