// SPDX-License-Identifier: MIT
// Physical realisability. Light: S0 ≥ 0 and S0² ≥ S1² + S2² + S3² (paper, section 3.1). A Mueller
// matrix: its coherency matrix H = ¼ Σ Mᵢⱼ σᵢ ⊗ σⱼ* has no negative eigenvalue, i.e. it is a sum of
// Jones matrices (Cloude 1986).
#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>

#include <malus/detail/hermitian.hpp>
#include <malus/detail/length.hpp>
#include <malus/mueller.hpp>

namespace malus {

namespace detail {

/// Component (r, c) of the Pauli matrix σᵢ with Sᵢ = E† σᵢ E, for fields exp(−iωt) and S3 = −2
/// Im(Ex* Ey).
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
      return r == c ? std::complex<T>(0) : std::complex<T>(0, r == 0 ? T(1) : T(-1));
  }
}

/// One channel's coherency matrix H = ¼ Σ Mᵢⱼ σᵢ ⊗ σⱼ*; of a Jones matrix J it is ½ v v†, where v
/// are the components of J by rows.
template <class M, class T = typename M::scalar_type>
ComplexMatrix<T, 4> coherency_matrix(const M& m, std::size_t channel_index) {
  ComplexMatrix<T, 4> h{};
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c) {
      std::complex<T> sum = 0;
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
          sum += channel(m(i, j), channel_index) * pauli<T>(i, r / 2, c / 2) *
                 std::conj(pauli<T>(j, r % 2, c % 2));
      h[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)] = T(0.25) * sum;
    }
  return h;
}

}  // namespace detail

/// True where every channel is light that can exist: S0 ≥ 0 and a degree of polarisation of at most
/// 1 + tolerance. NaN and infinity are not, compiled with -ffast-math too.
template <StokesType S>
bool is_physical(const S& s, typename S::scalar_type tolerance) {
  for (std::size_t i = 0; i < channel_count<typename S::value_type>; ++i) {
    const auto v = s.to_vec4(i);
    for (int k = 0; k < 4; ++k)
      if (!is_finite(v[k])) return false;
    const auto polarized = detail::length_of(v.y, v.z, v.w);
    if (!(v.x >= 0) || !(polarized <= v.x * (1 + tolerance))) return false;
  }
  return true;
}

/// The four eigenvalues of the coherency matrix of one channel, largest first; their sum is m00.
/// One alone is positive for a matrix that does not depolarise; a negative one is unphysical. To 16
/// ulp of the largest, whatever its size.
template <MuellerType M>
std::array<typename M::scalar_type, 4> coherency_eigenvalues(const M& m,
                                                             std::size_t channel_index = 0) {
  return detail::hermitian_eigen(detail::coherency_matrix(m, channel_index)).values;
}

/// True where every channel is a matrix that can exist: no eigenvalue of its coherency matrix is
/// below −tolerance · m00.
template <MuellerType M>
bool is_physical(const M& m, typename M::scalar_type tolerance) {
  for (std::size_t i = 0; i < channel_count<typename M::value_type>; ++i) {
    const auto m00 = channel(m.m00(), i);
    for (int k = 0; k < 16; ++k)
      if (!is_finite(channel(m(k / 4, k % 4), i))) return false;
    if (!(m00 >= 0) || !(coherency_eigenvalues(m, i)[3] >= -tolerance * m00)) return false;
  }
  return true;
}

}  // namespace malus
