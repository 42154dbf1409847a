// SPDX-License-Identifier: MIT
// Ideal polarizers: P(θ) of the paper's section 3.1, and the homogeneous circular ones.
#pragma once

#include <cmath>

#include <malus/mueller.hpp>
#include <malus/optics/turned.hpp>

namespace malus {

/// P(0) in the given frame: passes light polarised along x, half of unpolarised light, times
/// `transmittance`. Mirror-symmetric.
template <SpectralValue V, FrameType F>
constexpr BlockMueller<V, incident, exitant, F> linear_polarizer(const V& transmittance,
                                                                 const F& frame) {
  const V half = V(scalar_t<V>(0.5)) * transmittance, none = V(0);
  return BlockMueller<V, incident, exitant, F>::block({half, half, half, half},
                                                      {none, none, none, none}, frame, frame);
}

/// P(θ): passes light polarised at θ radians, counter-clockwise from x in the receiver's view. A
/// block in a turned run-time frame; full in a static one.
template <SpectralValue V, FrameType F>
auto linear_polarizer(const V& transmittance, const F& frame, scalar_t<V> theta) {
  return turned(linear_polarizer(transmittance, frame), theta);
}

enum class Handedness { right, left };  ///< In the receiver's view; right is S3 > 0.

/// Passes right (left) circular light unchanged, blocks the other, and lets half of unpolarised
/// light leave as right (left) circular, from whichever side it is used.
template <SpectralValue V, FrameType F>
constexpr FullMueller<V, incident, exitant, F> circular_polarizer(const V& transmittance,
                                                                  Handedness hand, const F& frame) {
  const V a = V(scalar_t<V>(0.5)) * transmittance, none = V(0);
  const V h = hand == Handedness::right ? a : -a;
  return FullMueller<V, incident, exitant, F>::from_rows({{{a, none, none, h},
                                                           {none, none, none, none},
                                                           {none, none, none, none},
                                                           {h, none, none, a}}},
                                                         frame, frame);
}

}  // namespace malus
