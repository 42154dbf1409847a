// SPDX-License-Identifier: MIT
// Physical realisability. Light: S0 ≥ 0 and S0² ≥ S1² + S2² + S3² (paper, section 3.1). A Mueller
// matrix: its coherency matrix H = ¼ Σ Mᵢⱼ σᵢ ⊗ σⱼ* has no negative eigenvalue, i.e. it is a sum of
// Jones matrices (Cloude 1986).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>

#include <malus/mueller.hpp>

namespace malus {

namespace detail {

/// Eigenvalues of a real symmetric matrix by cyclic Jacobi rotations (Golub & Van Loan,
/// section 8.5), in no order.
template <class T, std::size_t N>
std::array<T, N> symmetric_eigenvalues(std::array<std::array<T, N>, N> a) {
  constexpr int sweeps = 30;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    T off = 0, diagonal = 0;
    for (std::size_t i = 0; i < N; ++i) {
      diagonal += a[i][i] * a[i][i];
      for (std::size_t j = 0; j < i; ++j) off += a[i][j] * a[i][j];
    }
    if (!(off > std::numeric_limits<T>::epsilon() * std::numeric_limits<T>::epsilon() * diagonal))
      break;
    for (std::size_t p = 0; p + 1 < N; ++p)
      for (std::size_t q = p + 1; q < N; ++q) {
        if (a[p][q] == 0) continue;
        const T theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
        const T t = std::copysign(T(1), theta) / (std::abs(theta) + std::sqrt(theta * theta + 1));
        const T c = 1 / std::sqrt(t * t + 1), s = t * c;
        for (std::size_t k = 0; k < N; ++k) {
          const T kp = a[k][p], kq = a[k][q];
          a[k][p] = c * kp - s * kq;
          a[k][q] = s * kp + c * kq;
        }
        for (std::size_t k = 0; k < N; ++k) {
          const T pk = a[p][k], qk = a[q][k];
          a[p][k] = c * pk - s * qk;
          a[q][k] = s * pk + c * qk;
        }
      }
  }
  std::array<T, N> values;
  for (std::size_t i = 0; i < N; ++i) values[i] = a[i][i];
  return values;
}

/// Component (r, c) of the Pauli matrix that Stokes component i stands for.
template <class T>
constexpr std::complex<T> pauli(int i, int r, int c) {
  switch (i) {
    case 0:
      return r == c ? T(1) : T(0);
    case 1:
      return r != c ? T(0) : r == 0 ? T(1) : T(-1);
    case 2:
      return r != c ? T(1) : T(0);
    default:
      return r == c ? std::complex<T>(0) : std::complex<T>(0, r == 0 ? T(-1) : T(1));
  }
}

}  // namespace detail

/// True where every channel is light that can exist: S0 ≥ 0 and a degree of polarisation of at most
/// 1 + tolerance.
template <StokesType S>
bool is_physical(const S& s, typename S::scalar_type tolerance) {
  for (std::size_t i = 0; i < channel_count<typename S::value_type>; ++i) {
    const auto v = s.to_vec4(i);
    const auto polarized = std::sqrt(v.y * v.y + v.z * v.z + v.w * v.w);
    if (!(v.x >= 0) || !(polarized <= v.x * (1 + tolerance))) return false;
  }
  return true;
}

/// The four eigenvalues of the coherency matrix of one channel, largest first; their sum is m00.
/// One alone is positive for a matrix that does not depolarise; a negative one is unphysical.
template <MuellerType M>
std::array<typename M::scalar_type, 4> coherency_eigenvalues(const M& m,
                                                             std::size_t channel_index = 0) {
  using T = typename M::scalar_type;
  // H = A + iB is Hermitian; the real symmetric (A −B; B A) has each of its eigenvalues twice.
  std::array<std::array<T, 8>, 8> real{};
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c) {
      std::complex<T> h = 0;
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
          h += channel(m(i, j), channel_index) * detail::pauli<T>(i, r / 2, c / 2) *
               std::conj(detail::pauli<T>(j, r % 2, c % 2));
      h *= T(0.25);
      const auto row = static_cast<std::size_t>(r), column = static_cast<std::size_t>(c);
      real[row][column] = real[row + 4][column + 4] = h.real();
      real[row][column + 4] = -h.imag();
      real[row + 4][column] = h.imag();
    }
  auto twice = detail::symmetric_eigenvalues(real);
  std::sort(twice.begin(), twice.end(), [](T a, T b) { return a > b; });
  return {twice[0], twice[2], twice[4], twice[6]};
}

/// True where every channel is a matrix that can exist: no eigenvalue of its coherency matrix is
/// below −tolerance · m00.
template <MuellerType M>
bool is_physical(const M& m, typename M::scalar_type tolerance) {
  for (std::size_t i = 0; i < channel_count<typename M::value_type>; ++i) {
    const auto m00 = channel(m.m00(), i);
    if (!(m00 >= 0) || !(coherency_eigenvalues(m, i)[3] >= -tolerance * m00)) return false;
  }
  return true;
}

}  // namespace malus
