// SPDX-License-Identifier: MIT
// Small Hermitian matrices: eigenvalues and eigenvectors by cyclic Jacobi rotations (Golub & Van
// Loan, Matrix Computations, section 8.5), which stay accurate where eigenvalues coincide.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <utility>

namespace malus::detail {

template <class T, std::size_t N>
using ComplexMatrix = std::array<std::array<std::complex<T>, N>, N>;

/// A power of two that brings a matrix's components to the order of 1, as far as one can; products
/// with it are exact. Without it the squares of large and of small matrices are no numbers.
template <class T, std::size_t N>
T scale_of(const ComplexMatrix<T, N>& a) {
  T largest = 0;
  for (const auto& row : a)
    for (const auto& x : row) largest = std::max({largest, std::abs(x.real()), std::abs(x.imag())});
  constexpr int most = std::numeric_limits<T>::max_exponent - 2;
  return largest > 0 ? std::ldexp(T(1), std::clamp(-std::ilogb(largest), -most, most)) : T(1);
}

/// Eigenvalues, largest first; vectors[k] is the unit eigenvector of values[k].
template <class T, std::size_t N>
struct HermitianEigen {
  std::array<T, N> values;
  ComplexMatrix<T, N> vectors;
};

/// One rotation that makes a[p][q] zero, and the same of the columns of v.
template <class T, std::size_t N>
void jacobi_rotation(ComplexMatrix<T, N>& a, ComplexMatrix<T, N>& v, std::size_t p, std::size_t q) {
  const T size = std::abs(a[p][q]);
  if (size == 0) return;
  // The phase w of axis q makes a[p][q] real; the rest is the rotation of a real matrix.
  const std::complex<T> w = std::conj(a[p][q]) / size;
  const T theta = (a[q][q].real() - a[p][p].real()) / (2 * size);
  const T t = std::copysign(T(1), theta) / (std::abs(theta) + std::sqrt(theta * theta + 1));
  const T c = 1 / std::sqrt(t * t + 1), s = t * c;
  const auto turn = [c, s](std::complex<T>& x, std::complex<T>& y, std::complex<T> phase) {
    const std::complex<T> turned = y * phase;
    y = s * x + c * turned;
    x = c * x - s * turned;
  };
  for (std::size_t k = 0; k < N; ++k) turn(a[k][p], a[k][q], w);
  for (std::size_t k = 0; k < N; ++k) turn(a[p][k], a[q][k], std::conj(w));
  for (std::size_t k = 0; k < N; ++k) turn(v[k][p], v[k][q], w);
}

template <class T, std::size_t N>
HermitianEigen<T, N> hermitian_eigen(ComplexMatrix<T, N> a) {
  ComplexMatrix<T, N> v{};
  for (std::size_t i = 0; i < N; ++i) v[i][i] = 1;
  const T scale = scale_of(a);
  for (auto& row : a)
    for (auto& x : row) x *= scale;
  constexpr int sweeps = 30;
  constexpr T epsilon = std::numeric_limits<T>::epsilon();
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    T off = 0, diagonal = 0;
    for (std::size_t i = 0; i < N; ++i) {
      diagonal += std::norm(a[i][i]);
      for (std::size_t j = 0; j < i; ++j) off += std::norm(a[i][j]);
    }
    if (!(off > epsilon * epsilon * diagonal)) break;
    for (std::size_t p = 0; p + 1 < N; ++p)
      for (std::size_t q = p + 1; q < N; ++q) jacobi_rotation(a, v, p, q);
  }
  HermitianEigen<T, N> result;
  for (std::size_t k = 0; k < N; ++k) {
    result.values[k] = a[k][k].real() / scale;
    for (std::size_t i = 0; i < N; ++i) result.vectors[k][i] = v[i][k];
    for (std::size_t j = k; j > 0 && result.values[j] > result.values[j - 1]; --j) {
      std::swap(result.values[j], result.values[j - 1]);
      std::swap(result.vectors[j], result.vectors[j - 1]);
    }
  }
  return result;
}

}  // namespace malus::detail
