// SPDX-License-Identifier: MIT
// The algebra a second time, for the tests to compare with: plain 4×4 arrays of double, every
// rotation a full matrix from an angle (paper, sections 3.1 and 4.1–4.3). It knows nothing of forms
// and shares no code with the library.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace reference {

struct Vector {
  std::array<double, 4> component{};
  double& operator[](std::size_t i) { return component[i]; }
  double operator[](std::size_t i) const { return component[i]; }
};
struct Matrix {
  std::array<Vector, 4> row{};
  Vector& operator[](std::size_t i) { return row[i]; }
  const Vector& operator[](std::size_t i) const { return row[i]; }
};
using Axis = std::array<double, 3>;

struct Axes {
  Axis x, y;
};

inline double dot(const Axis& a, const Axis& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Axis cross(const Axis& a, const Axis& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline Matrix from_rows(const std::array<std::array<double, 4>, 4>& rows) {
  Matrix m;
  for (std::size_t r = 0; r < 4; ++r) m[r].component = rows[r];
  return m;
}

/// R(φ): the frame turned by φ, counter-clockwise in the receiver's view.
inline Matrix rotation(double angle) {
  const double c = std::cos(2 * angle), s = std::sin(2 * angle);
  return from_rows({{{1, 0, 0, 0}, {0, c, s, 0}, {0, -s, c, 0}, {0, 0, 0, 1}}});
}

/// G F⁻¹.
inline Matrix rotation(const Axes& from, const Axes& to) {
  return rotation(std::atan2(dot(from.y, to.x), dot(from.x, to.x)));
}

inline Matrix operator*(const Matrix& a, const Matrix& b) {
  Matrix m{};
  for (std::size_t r = 0; r < 4; ++r)
    for (std::size_t c = 0; c < 4; ++c)
      for (std::size_t k = 0; k < 4; ++k) m[r][c] += a[r][k] * b[k][c];
  return m;
}
inline Vector operator*(const Matrix& a, const Vector& v) {
  Vector result{};
  for (std::size_t r = 0; r < 4; ++r)
    for (std::size_t k = 0; k < 4; ++k) result[r] += a[r][k] * v[k];
  return result;
}
inline Matrix operator+(Matrix a, const Matrix& b) {
  for (std::size_t r = 0; r < 4; ++r)
    for (std::size_t c = 0; c < 4; ++c) a[r][c] += b[r][c];
  return a;
}
inline Vector operator+(Vector a, const Vector& b) {
  for (std::size_t r = 0; r < 4; ++r) a[r] += b[r];
  return a;
}
inline double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}
inline Matrix transposed(const Matrix& m) {
  Matrix t{};
  for (std::size_t r = 0; r < 4; ++r)
    for (std::size_t c = 0; c < 4; ++c) t[r][c] = m[c][r];
  return t;
}

}  // namespace reference
