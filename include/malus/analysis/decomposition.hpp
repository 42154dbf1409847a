// SPDX-License-Identifier: MIT
// What a Mueller matrix does, in parts: as a chain of a diattenuator, a retarder and a depolarizer
// (Lu & Chipman 1996, J. Opt. Soc. Am. A 13, 1106), and as a sum of four matrices that do not
// depolarise (Cloude 1986), with the numbers that go with them.
#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <concepts>
#include <cstddef>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>

#include <malus/analysis/physicality.hpp>
#include <malus/detail/hermitian.hpp>
#include <malus/detail/length.hpp>
#include <malus/detail/singular_values.hpp>
#include <malus/mueller.hpp>

namespace malus {

/// A matrix with a frame on either side, which its factors can be given: a block or a full one.
template <class M>
concept FramedMueller =
    MuellerType<M> && needs_enter_frame(M::static_form) && needs_exit_frame(M::static_form);

namespace detail {

/// GLM matrices, m[c][r]; the product is the ordinary one.
template <std::floating_point T>
struct PolarFactors {
  glm::mat<4, 4, T> depolarizer, retarder, diattenuator;
};

/// Rows (a, bᵀ) and (c, m).
template <std::floating_point T>
glm::mat<4, 4, T> bordered(T a, const glm::vec<3, T>& b, const glm::vec<3, T>& c,
                           const glm::mat<3, 3, T>& m) {
  return {{a, c.x, c.y, c.z},
          {b.x, m[0].x, m[0].y, m[0].z},
          {b.y, m[1].x, m[1].y, m[1].z},
          {b.z, m[2].x, m[2].y, m[2].z}};
}

/// The rotation R and symmetric S of m = S·R: m = U Σ Vᵀ has R = ±U Vᵀ and S = ±U Σ Uᵀ, with the
/// sign of det m. Where m is singular, R is the smallest rotation that will do.
template <std::floating_point T>
void symmetric_times_rotation(const glm::mat<3, 3, T>& m, glm::mat<3, 3, T>& symmetric,
                              glm::mat<3, 3, T>& rotation) {
  constexpr T none = 64 * std::numeric_limits<T>::epsilon();
  const auto [scaled, v] = singular_values(m);
  glm::mat<3, 3, T> u(0);
  symmetric = glm::mat<3, 3, T>(0);
  int rank = 0;
  for (; rank < 3; ++rank) {
    const T sigma = glm::length(scaled[rank]);
    if (!(sigma > none)) break;
    u[rank] = scaled[rank] / sigma;
    symmetric += sigma * glm::outerProduct(u[rank], u[rank]);
  }
  if (rank == 2) u[2] = glm::cross(u[0], u[1]);
  if (rank >= 2) {
    const T sign = glm::dot(glm::cross(u[0], u[1]), u[2]) < 0 ? T(-1) : T(1);
    rotation = sign * (u * glm::transpose(v));
    symmetric *= sign;
  } else {
    rotation = rank == 1 ? smallest_rotation(v[0], u[0]) : glm::mat<3, 3, T>(1);
  }
}

template <std::floating_point T>
PolarFactors<T> polar_factors(const glm::mat<4, 4, T>& m) {
  using Vector = glm::vec<3, T>;
  using Matrix = glm::mat<3, 3, T>;
  const Vector zero(0);
  const Matrix identity(1);
  const T m00 = m[0][0];
  if (!(m00 > 0)) return {glm::mat<4, 4, T>(1), glm::mat<4, 4, T>(1), glm::mat<4, 4, T>(0)};
  const Vector d = Vector(m[1][0], m[2][0], m[3][0]) / m00;
  const T d2 = glm::dot(d, d), root2 = 1 - d2;
  const T root = std::sqrt(root2 > 0 ? root2 : T(0));
  // (1 − √(1 − D²))/D² without cancellation.
  const T k = 1 / (1 + root);
  const Matrix dd = glm::outerProduct(d, d);
  const glm::mat<4, 4, T> diattenuator = m00 * bordered(T(1), d, d, root * identity + k * dd);

  if (!(root2 > 1000 * std::numeric_limits<T>::epsilon())) {
    // A polarizer comes first, M = m00 (1, P)(1, D)ᵀ: D is turned to P and shortened.
    const Vector p = Vector(m[0][1], m[0][2], m[0][3]) / m00;
    const T length = glm::length(p);
    const Matrix turn =
        length > 0 ? smallest_rotation(glm::normalize(d), p / length) : Matrix(identity);
    return {bordered(T(1), zero, zero, length * identity), bordered(T(1), zero, zero, turn),
            diattenuator};
  }
  const glm::mat<4, 4, T> inverse =
      bordered(1 / root2, -d / root2, -d / root2, (root * identity + k * dd) / root2);
  const glm::mat<4, 4, T> rest = (m / m00) * inverse;
  Matrix symmetric, rotation;
  symmetric_times_rotation(
      Matrix(Vector(rest[1][1], rest[1][2], rest[1][3]), Vector(rest[2][1], rest[2][2], rest[2][3]),
             Vector(rest[3][1], rest[3][2], rest[3][3])),
      symmetric, rotation);
  return {bordered(T(1), zero, Vector(rest[0][1], rest[0][2], rest[0][3]), symmetric),
          bordered(T(1), zero, zero, rotation), diattenuator};
}

template <class V>
using MuellerRows = std::array<std::array<V, 4>, 4>;

template <SpectralValue V, std::floating_point T>
void set_channel_of_rows(MuellerRows<V>& rows, std::size_t i, const glm::mat<4, 4, T>& m) {
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c)
      set_channel(rows[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)], i, m[c][r]);
}

template <SpectralValue V>
MuellerRows<V> zero_rows() {
  MuellerRows<V> rows;
  for (auto& row : rows) row.fill(V(0));
  return rows;
}

/// x / whole where there is any, else 0.
template <class T>
T part_of(T x, T whole) {
  return whole > 0 ? x / whole : T(0);
}

}  // namespace detail

/// M = depolarizer · retarder · diattenuator, each a full matrix. The diattenuator is in M's enter
/// frame, the depolarizer in its exit frame; the retarder leads from the one to the other.
template <SpectralValue V, FrameType FI, FrameType FO>
struct PolarDecomposition {
  FullMueller<V, incident, exitant, FO, FO> depolarizer;
  FullMueller<V, incident, exitant, FI, FO> retarder;
  FullMueller<V, incident, exitant, FI, FI> diattenuator;
};

/// Lu & Chipman's decomposition of a physical matrix, channel by channel. All of m00 is the
/// diattenuator's; the depolarizer has the polarizance that is left. Where M is singular the
/// smallest retardance that will do is taken. The product of the factors is M to 20 ulp; of m00 ≤ 0
/// it is nothing.
template <FramedMueller M>
  requires(std::same_as<typename M::in_side, incident> &&
           std::same_as<typename M::out_side, exitant>)
auto polar_decomposition(const M& m) {
  using V = typename M::value_type;
  using Result = PolarDecomposition<V, typename M::enter_frame_type, typename M::exit_frame_type>;
  auto depolarizer = detail::zero_rows<V>(), retarder = depolarizer, diattenuator = depolarizer;
  for (std::size_t i = 0; i < channel_count<V>; ++i) {
    const auto factors = detail::polar_factors(m.to_mat4(i));
    detail::set_channel_of_rows(depolarizer, i, factors.depolarizer);
    detail::set_channel_of_rows(retarder, i, factors.retarder);
    detail::set_channel_of_rows(diattenuator, i, factors.diattenuator);
  }
  return Result{decltype(Result::depolarizer)::from_rows(depolarizer, m.exit(), m.exit()),
                decltype(Result::retarder)::from_rows(retarder, m.enter(), m.exit()),
                decltype(Result::diattenuator)::from_rows(diattenuator, m.enter(), m.enter())};
}

/// Cloude's decomposition: four matrices, each of a single Jones matrix, that sum to M. Their m00
/// are the eigenvalues of M's coherency matrix, largest first in each channel; those of an
/// unphysical M may be negative. The sum is M to 64 ulp, whatever its size.
template <FramedMueller M>
auto cloude_decomposition(const M& m) {
  using V = typename M::value_type;
  using T = typename M::scalar_type;
  using Part = FullMueller<V, typename M::in_side, typename M::out_side,
                           typename M::enter_frame_type, typename M::exit_frame_type>;
  std::array<detail::MuellerRows<V>, 4> rows;
  rows.fill(detail::zero_rows<V>());
  for (std::size_t channel_index = 0; channel_index < channel_count<V>; ++channel_index) {
    const auto eigen = detail::hermitian_eigen(detail::coherency_matrix(m, channel_index));
    for (std::size_t part = 0; part < 4; ++part) {
      const auto& v = eigen.vectors[part];
      // Mᵢⱼ = λ v† (σᵢ ⊗ σⱼ*) v, since the σᵢ ⊗ σⱼ* are orthogonal.
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) {
          std::complex<T> sum = 0;
          for (int r = 0; r < 4; ++r)
            for (int c = 0; c < 4; ++c)
              sum += std::conj(v[static_cast<std::size_t>(r)]) * detail::pauli<T>(i, r / 2, c / 2) *
                     std::conj(detail::pauli<T>(j, r % 2, c % 2)) * v[static_cast<std::size_t>(c)];
          set_channel(rows[part][static_cast<std::size_t>(i)][static_cast<std::size_t>(j)],
                      channel_index, eigen.values[part] * sum.real());
        }
    }
  }
  const auto framed = [&](std::size_t k) { return Part::from_rows(rows[k], m.enter(), m.exit()); };
  return std::array<Part, 4>{framed(0), framed(1), framed(2), framed(3)};
}

/// D = (Tmax − Tmin)/(Tmax + Tmin), to 4 ulp: 0 where m00 ≤ 0 or the transmittance is the same for
/// all light, 1 of a polarizer.
template <MuellerType M>
auto diattenuation(const M& m) {
  return map_channels([](auto m00, auto a, auto b,
                         auto c) { return detail::part_of(detail::length_of(a, b, c), m00); },
                      m(0, 0), m(0, 1), m(0, 2), m(0, 3));
}

/// P: the degree of polarisation that unpolarised light leaves with, to 4 ulp; 0 where m00 ≤ 0.
template <MuellerType M>
auto polarizance(const M& m) {
  return map_channels([](auto m00, auto a, auto b,
                         auto c) { return detail::part_of(detail::length_of(a, b, c), m00); },
                      m(0, 0), m(1, 0), m(2, 0), m(3, 0));
}

/// √((Σ mᵢⱼ² − m00²)/3)/m00 (Gil & Bernabéu 1986): 1 where nothing is depolarised, 0 where all is
/// and where m00 ≤ 0. To 4 ulp.
template <MuellerType M>
auto depolarization_index(const M& m) {
  using V = typename M::value_type;
  V sum(0);
  const auto ratio = [](auto x, auto m00) { return detail::part_of(x, m00); };
  for (int i = 1; i < 16; ++i) {
    const V part = map_channels(ratio, m(i / 4, i % 4), m(0, 0));
    sum += part * part;
  }
  return map_channels([](auto squares) { return std::sqrt(squares / 3); }, sum);
}

/// 1 − |tr mΔ|/3 of the depolarizer of a polar decomposition, to 2 ulp: 0 of none, 1 of an ideal
/// one.
template <MuellerType M>
auto depolarization_power(const M& depolarizer) {
  return map_channels([](auto m00, auto a, auto b,
                         auto c) { return 1 - detail::part_of(std::abs(a + b + c), m00) / 3; },
                      depolarizer(0, 0), depolarizer(1, 1), depolarizer(2, 2), depolarizer(3, 3));
}

/// The phase, in [0, π], by which the retarder of a polar decomposition turns the Poincaré sphere;
/// to 4 ulp of π.
template <MuellerType M>
auto retardance(const M& retarder) {
  return map_channels(
      [](auto a, auto b, auto c, auto cosine) {
        // Twice the sine and twice the cosine: accurate at all angles, as arccos is not.
        return std::atan2(std::sqrt(a * a + b * b + c * c), cosine);
      },
      retarder(2, 3) - retarder(3, 2), retarder(3, 1) - retarder(1, 3),
      retarder(1, 2) - retarder(2, 1),
      retarder(1, 1) + retarder(2, 2) + retarder(3, 3) - retarder(0, 0));
}

}  // namespace malus
