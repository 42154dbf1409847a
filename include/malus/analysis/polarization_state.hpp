// SPDX-License-Identifier: MIT
// What a Stokes vector says of the light: degrees, angle and ellipse of polarisation (Goldstein,
// Polarized Light, chapter 5). A result is a value a channel; angles are in the Stokes vector's own
// frame, in radians.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <malus/detail/length.hpp>
#include <malus/stokes.hpp>

namespace malus {

namespace detail {
/// x / s0 where there is light, else 0.
template <class T>
T fraction_of(T x, T s0) {
  return s0 > 0 ? x / s0 : T(0);
}
}  // namespace detail

/// DoP = √(S1² + S2² + S3²)/S0: 0 unpolarised (and where S0 ≤ 0), 1 fully polarised; more is
/// unphysical. To 4 ulp, whatever the size of the light.
template <StokesType S>
auto degree_of_polarization(const S& s) {
  return map_channels(
      [](auto s0, auto s1, auto s2, auto s3) {
        return detail::fraction_of(detail::length_of(s1, s2, s3), s0);
      },
      s[0], s[1], s[2], s[3]);
}

/// DoLP = √(S1² + S2²)/S0, to 4 ulp; 0 where S0 ≤ 0.
template <StokesType S>
auto degree_of_linear_polarization(const S& s) {
  return map_channels(
      [](auto s0, auto s1, auto s2) { return detail::fraction_of(detail::length_of(s1, s2), s0); },
      s[0], s[1], s[2]);
}

/// DoCP = S3/S0, to 1 ulp: 1 right circular, −1 left circular; 0 where S0 ≤ 0.
template <StokesType S>
auto degree_of_circular_polarization(const S& s) {
  return map_channels([](auto s0, auto s3) { return detail::fraction_of(s3, s0); }, s[0], s[3]);
}

/// AoLP = ½ atan2(S2, S1) in [0, π), counter-clockwise from x in the receiver's view; 0 where there
/// is no linear polarisation. To 2 ulp of π.
template <StokesType S>
auto angle_of_linear_polarization(const S& s) {
  return map_channels(
      [](auto s1, auto s2) {
        using T = decltype(s1);
        if (s1 == 0 && s2 == 0) return T(0);
        const T angle = T(0.5) * std::atan2(s2, s1);
        const T positive = angle < 0 ? angle + std::numbers::pi_v<T> : angle;
        return positive < std::numbers::pi_v<T> ? positive : T(0);
      },
      s[1], s[2]);
}

/// χ in [−π/4, π/4], the ellipticity: tan χ is the ratio of the ellipse's axes, χ > 0 right-handed.
/// 0 where unpolarised. To 4 ulp, whatever the size of the light.
template <StokesType S>
auto ellipticity(const S& s) {
  return map_channels(
      [](auto s1, auto s2, auto s3) {
        using T = decltype(s1);
        return T(0.5) * std::atan2(s3, detail::length_of(s1, s2));
      },
      s[1], s[2], s[3]);
}

/// Light of an intensity, degree of polarisation, orientation ψ and ellipticity χ, in radians;
/// to 3 ulp of the intensity.
template <SideTag Side = exitant, SpectralValue V, FrameType F>
Stokes<V, Side, F> from_ellipse(const V& intensity, scalar_t<V> degree, scalar_t<V> orientation,
                                scalar_t<V> chi, const F& frame) {
  const V polarized = intensity * V(degree);
  const auto linear = std::cos(2 * chi);
  return {intensity, polarized * V(linear * std::cos(2 * orientation)),
          polarized * V(linear * std::sin(2 * orientation)), polarized * V(std::sin(2 * chi)),
          frame};
}

}  // namespace malus
