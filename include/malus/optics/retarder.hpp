// SPDX-License-Identifier: MIT
// Ideal retarders: Q(φ) of the paper's section 3.1 (without the factor ½ printed there, with which
// its equation 1 would not hold), and the general elliptical one. A retarder turns the Poincaré
// sphere about its eigenpolarisation.
#pragma once

#include <array>
#include <cmath>

#include <malus/optics/turned.hpp>
#include <malus/product.hpp>

namespace malus {

/// Q(φ) in the given frame: the fast axis is x, light along y lags by `phase` radians,
/// finite; to 2 ulp.
/// Mirror-symmetric.
template <SpectralValue V, FrameType F>
BlockMueller<V, incident, exitant, F> linear_retarder(const V& transmittance, const V& phase,
                                                      const F& frame) {
  const V c = transmittance * map_channels([](auto x) { return std::cos(x); }, phase);
  const V s = transmittance * map_channels([](auto x) { return std::sin(x); }, phase);
  const V none = V(0);
  return BlockMueller<V, incident, exitant, F>::block({transmittance, none, none, transmittance},
                                                      {c, s, -s, c}, frame, frame);
}

/// Q(φ) with the fast axis at θ radians, counter-clockwise from x in the receiver's view: R(−θ)
/// Q(φ) R(θ).
template <SpectralValue V, FrameType F>
auto linear_retarder(const V& transmittance, const V& phase, const F& frame, scalar_t<V> theta) {
  return turned(linear_retarder(transmittance, phase, frame), theta);
}

/// The general retarder: `fast` is the unit vector (S1, S2, S3) of the polarisation that is ahead
/// of its opposite by `phase`. (1, 0, 0) is Q(φ); (0, 0, 1) makes right circular light the fast one
/// and so turns the plane of polarisation by −φ/2. To 5 ulp; a vector of another length makes no
/// retarder.
template <SpectralValue V, FrameType F>
FullMueller<V, incident, exitant, F> elliptical_retarder(const V& transmittance,
                                                         const std::array<scalar_t<V>, 3>& fast,
                                                         const V& phase, const F& frame) {
  const V c = map_channels([](auto x) { return std::cos(x); }, phase);
  const V s = map_channels([](auto x) { return std::sin(x); }, phase);
  const auto [a, b, e] = fast;
  const V t = V(scalar_t<V>(1)) - c, none = V(0);
  // Rodrigues' rotation of (S1, S2, S3) about `fast` by −φ.
  return FullMueller<V, incident, exitant, F>::from_rows(
             {{{V(scalar_t<V>(1)), none, none, none},
               {none, c + t * (a * a), t * (a * b) + s * e, t * (a * e) - s * b},
               {none, t * (a * b) - s * e, c + t * (b * b), t * (b * e) + s * a},
               {none, t * (a * e) + s * b, t * (b * e) - s * a, c + t * (e * e)}}},
             frame, frame) *
         transmittance;
}

}  // namespace malus
