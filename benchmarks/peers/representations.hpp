// SPDX-License-Identifier: MIT
// Mueller matrices and Stokes vectors of three colours as one would write them with a library of
// linear algebra: GLM or Eigen, a matrix for each colour; or Eigen with the colours innermost.
//
// A representation has Matrix and Vector, makes them of the benchmark's operands, multiplies them,
// and turns the frame of what a matrix is applied to. Where frames have to be carried, Framed pairs
// a quantity with them.
#pragma once

#include <array>
#include <cstddef>

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#ifdef MALUS_HAVE_EIGEN
#include <Eigen/Core>
#endif

#include <malus/frame.hpp>

#include "../naive.hpp"

namespace representations {

inline constexpr std::size_t channels = naive::channels;

template <class T>
using NaiveMatrix = std::array<glm::mat<4, 4, T>, channels>;
template <class T>
using NaiveVector = std::array<glm::vec<4, T>, channels>;

/// A colour after the other: Algebra says what a matrix of one colour is.
template <class Algebra>
struct PerColour {
  using Scalar = typename Algebra::Scalar;
  using Matrix = std::array<typename Algebra::Matrix, channels>;
  using Vector = std::array<typename Algebra::Vector, channels>;

  static Matrix matrix(const NaiveMatrix<Scalar>& m) {
    Matrix result;
    for (std::size_t i = 0; i < channels; ++i)
      for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c) Algebra::at(result[i], r, c) = m[i][c][r];
    return result;
  }
  static Vector vector(const NaiveVector<Scalar>& s) {
    Vector result;
    for (std::size_t i = 0; i < channels; ++i)
      for (int r = 0; r < 4; ++r) result[i][r] = s[i][r];
    return result;
  }
  static Scalar at(const Matrix& m, std::size_t i, int r, int c) { return Algebra::at(m[i], r, c); }
  static Scalar at(const Vector& s, std::size_t i, int r) { return s[i][r]; }

  static Matrix product(const Matrix& n, const Matrix& m) {
    Matrix result;
    for (std::size_t i = 0; i < channels; ++i) result[i] = n[i] * m[i];
    return result;
  }
  static Vector product(const Matrix& m, const Vector& s) {
    Vector result;
    for (std::size_t i = 0; i < channels; ++i) result[i] = m[i] * s[i];
    return result;
  }
  /// R·x by a full product, with one matrix R for all colours.
  template <class Quantity>
  static Quantity turned(const Quantity& x, malus::Rotation<Scalar> rotation) {
    const auto turn = Algebra::rotation(rotation.cos2, rotation.sin2);
    Quantity result;
    for (std::size_t i = 0; i < channels; ++i) result[i] = turn * x[i];
    return result;
  }
};

template <class T>
struct GlmAlgebra {
  using Scalar = T;
  using Matrix = glm::mat<4, 4, T>;
  using Vector = glm::vec<4, T>;
  static T& at(Matrix& m, int r, int c) { return m[c][r]; }
  static T at(const Matrix& m, int r, int c) { return m[c][r]; }
  static Matrix rotation(T c, T s) { return {1, 0, 0, 0, 0, c, -s, 0, 0, s, c, 0, 0, 0, 0, 1}; }
};

#ifdef MALUS_HAVE_EIGEN

template <class T>
struct EigenAlgebra {
  using Scalar = T;
  using Matrix = Eigen::Matrix<T, 4, 4>;
  using Vector = Eigen::Matrix<T, 4, 1>;
  static T& at(Matrix& m, int r, int c) { return m(r, c); }
  static T at(const Matrix& m, int r, int c) { return m(r, c); }
  static Matrix rotation(T c, T s) {
    Matrix m = Matrix::Identity();
    m(1, 1) = m(2, 2) = c;
    m(1, 2) = s;
    m(2, 1) = -s;
    return m;
  }
};

/// The colours of one component beside each other, in an array of Eigen's with a fourth, unused
/// lane; the products of components are written out.
template <class T>
struct EigenArrays {
  using Scalar = T;
  using Lanes = Eigen::Array<T, 4, 1>;
  using Matrix = std::array<std::array<Lanes, 4>, 4>;
  using Vector = std::array<Lanes, 4>;

  static Matrix matrix(const NaiveMatrix<T>& m) {
    Matrix result;
    for (int r = 0; r < 4; ++r)
      for (int c = 0; c < 4; ++c)
        result[std::size_t(r)][std::size_t(c)] = Lanes(m[0][c][r], m[1][c][r], m[2][c][r], 0);
    return result;
  }
  static Vector vector(const NaiveVector<T>& s) {
    Vector result;
    for (int r = 0; r < 4; ++r) result[std::size_t(r)] = Lanes(s[0][r], s[1][r], s[2][r], 0);
    return result;
  }
  static T at(const Matrix& m, std::size_t i, int r, int c) {
    return m[std::size_t(r)][std::size_t(c)][Eigen::Index(i)];
  }
  static T at(const Vector& s, std::size_t i, int r) { return s[std::size_t(r)][Eigen::Index(i)]; }

  static Matrix product(const Matrix& n, const Matrix& m) {
    Matrix result;
    for (std::size_t r = 0; r < 4; ++r)
      for (std::size_t c = 0; c < 4; ++c)
        result[r][c] =
            n[r][0] * m[0][c] + n[r][1] * m[1][c] + n[r][2] * m[2][c] + n[r][3] * m[3][c];
    return result;
  }
  static Vector product(const Matrix& m, const Vector& s) {
    Vector result;
    for (std::size_t r = 0; r < 4; ++r)
      result[r] = m[r][0] * s[0] + m[r][1] * s[1] + m[r][2] * s[2] + m[r][3] * s[3];
    return result;
  }
  /// The two rows that turn.
  static Matrix turned(const Matrix& m, malus::Rotation<T> rotation) {
    Matrix result = m;
    for (std::size_t c = 0; c < 4; ++c) {
      result[1][c] = rotation.cos2 * m[1][c] + rotation.sin2 * m[2][c];
      result[2][c] = rotation.cos2 * m[2][c] - rotation.sin2 * m[1][c];
    }
    return result;
  }
  static Vector turned(const Vector& s, malus::Rotation<T> rotation) {
    return {s[0], rotation.cos2 * s[1] + rotation.sin2 * s[2],
            rotation.cos2 * s[2] - rotation.sin2 * s[1], s[3]};
  }
};

#endif

template <class Matrix, class T>
struct FramedMatrix {
  Matrix value;
  malus::Frame<T> enter, exit;
};
template <class Vector, class T>
struct FramedVector {
  Vector value;
  malus::Frame<T> frame;
};

}  // namespace representations
