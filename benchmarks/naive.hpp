// SPDX-License-Identifier: MIT
// What the library is compared with: polarised light as a renderer writes it down first. Every
// matrix is a whole 4×4 matrix a channel (GLM's, or another that is indexed by column and row),
// every change of frame a product with a rotation matrix, made by atan2, sin and cos.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include <malus/frame.hpp>

namespace naive {

inline constexpr std::size_t channels = 3;

template <class T>
struct Stokes {
  std::array<glm::vec<4, T>, channels> value;
  malus::Frame<T> frame;
};

template <class T, class M = glm::mat<4, 4, T>>
struct Mueller {
  std::array<M, channels> value;
  malus::Frame<T> enter, exit;
};

/// Rows are measurements of light in the frame.
template <class T, class M = glm::mat<4, 4, T>>
struct Importance {
  std::array<M, channels> value;
  malus::Frame<T> frame;
};

template <class T>
using Readings = std::array<glm::vec<4, T>, channels>;

template <class T>
using Value = std::array<T, channels>;

/// G F⁻¹ as a matrix; its constructor takes columns, as GLM's does.
template <class T, class M = glm::mat<4, 4, T>>
M rotation_matrix(const malus::Frame<T>& from, const malus::Frame<T>& to) {
  const T angle = std::atan2(glm::dot(from.y(), to.x()), glm::dot(from.x(), to.x()));
  const T c = std::cos(2 * angle), s = std::sin(2 * angle);
  return {1, 0, 0, 0, 0, c, -s, 0, 0, s, c, 0, 0, 0, 0, 1};
}

template <class T, class M>
Stokes<T> rotated(const Stokes<T>& s, const M& turn, const malus::Frame<T>& frame) {
  Stokes<T> result;
  for (std::size_t i = 0; i < channels; ++i) result.value[i] = turn * s.value[i];
  result.frame = frame;
  return result;
}

template <class T>
Stokes<T> expressed_in(const Stokes<T>& s, const malus::Frame<T>& frame) {
  return rotated(s, rotation_matrix(s.frame, frame), frame);
}

/// The frames agree: no rotation.
template <class T, class M>
Stokes<T> apply_in_frame(const Mueller<T, M>& m, const Stokes<T>& s) {
  Stokes<T> result;
  for (std::size_t i = 0; i < channels; ++i) result.value[i] = m.value[i] * s.value[i];
  result.frame = m.exit;
  return result;
}

template <class T, class M>
Stokes<T> operator*(const Mueller<T, M>& m, const Stokes<T>& s) {
  return apply_in_frame(m, rotated(s, rotation_matrix<T, M>(s.frame, m.enter), m.enter));
}

template <class T, class M>
Mueller<T, M> multiply_in_frame(const Mueller<T, M>& n, const Mueller<T, M>& m) {
  Mueller<T, M> result;
  for (std::size_t i = 0; i < channels; ++i) result.value[i] = n.value[i] * m.value[i];
  result.enter = m.enter;
  result.exit = n.exit;
  return result;
}

template <class T, class M>
Mueller<T, M> operator*(const Mueller<T, M>& n, const Mueller<T, M>& m) {
  const auto turn = rotation_matrix<T, M>(m.exit, n.enter);
  Mueller<T, M> result;
  for (std::size_t i = 0; i < channels; ++i) result.value[i] = n.value[i] * (turn * m.value[i]);
  result.enter = m.enter;
  result.exit = n.exit;
  return result;
}

template <class T, class M>
Mueller<T, M> operator+(const Mueller<T, M>& a, const Mueller<T, M>& b) {
  const auto exit_turn = rotation_matrix<T, M>(b.exit, a.exit),
             enter_turn = rotation_matrix<T, M>(a.enter, b.enter);
  Mueller<T, M> result;
  for (std::size_t i = 0; i < channels; ++i)
    result.value[i] = a.value[i] + exit_turn * b.value[i] * enter_turn;
  result.enter = a.enter;
  result.exit = a.exit;
  return result;
}

template <class T, class M>
Mueller<T, M> operator*(const Mueller<T, M>& m, const Value<T>& k) {
  Mueller<T, M> result;
  for (std::size_t i = 0; i < channels; ++i) result.value[i] = m.value[i] * k[i];
  result.enter = m.enter;
  result.exit = m.exit;
  return result;
}

template <class T, class M>
Mueller<T, M> adjoint(const Mueller<T, M>& m) {
  Mueller<T, M> result;
  for (std::size_t i = 0; i < channels; ++i) result.value[i] = glm::transpose(m.value[i]);
  result.enter = m.exit;
  result.exit = m.enter;
  return result;
}

template <class T>
Stokes<T> operator+(const Stokes<T>& a, const Stokes<T>& b) {
  const auto turn = rotation_matrix(b.frame, a.frame);
  Stokes<T> result;
  for (std::size_t i = 0; i < channels; ++i) result.value[i] = a.value[i] + turn * b.value[i];
  result.frame = a.frame;
  return result;
}

template <class T, class M>
Importance<T, M> operator*(const Importance<T, M>& w, const Mueller<T, M>& m) {
  const auto turn = rotation_matrix<T, M>(m.exit, w.frame);
  Importance<T, M> result;
  for (std::size_t i = 0; i < channels; ++i) result.value[i] = w.value[i] * (turn * m.value[i]);
  result.frame = m.enter;
  return result;
}

template <class T, class M>
Readings<T> operator*(const Importance<T, M>& w, const Stokes<T>& s) {
  const auto turn = rotation_matrix<T, M>(s.frame, w.frame);
  Readings<T> result;
  for (std::size_t i = 0; i < channels; ++i) result[i] = w.value[i] * (turn * s.value[i]);
  return result;
}

/// One filter, a row, before a matrix.
template <class T, class M>
Stokes<T> filter(const Stokes<T>& row, const Mueller<T, M>& m) {
  const auto turn = rotation_matrix<T, M>(m.exit, row.frame);
  Stokes<T> result;
  for (std::size_t i = 0; i < channels; ++i) result.value[i] = row.value[i] * (turn * m.value[i]);
  result.frame = m.enter;
  return result;
}

template <class T>
Value<T> inner_product(const Stokes<T>& a, const Stokes<T>& b) {
  const auto turn = rotation_matrix(b.frame, a.frame);
  Value<T> result;
  for (std::size_t i = 0; i < channels; ++i) result[i] = glm::dot(a.value[i], turn * b.value[i]);
  return result;
}

}  // namespace naive
