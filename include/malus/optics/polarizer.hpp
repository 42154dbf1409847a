// SPDX-License-Identifier: MIT
// Ideal polarizers: P(θ) of the paper's section 3.1, and the homogeneous circular ones.
#pragma once

#include <cmath>

#include <malus/mueller.hpp>

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

/// P(θ): passes light polarised at θ radians, counter-clockwise from x in the receiver's view.
template <SpectralValue V, std::floating_point T>
requires std::same_as<T, scalar_t<V>> BlockMueller<V> linear_polarizer(const V& transmittance,
                                                                       const Frame<T>& frame,
                                                                       T theta) {
  return linear_polarizer(transmittance, frame.turned(theta));
}
template <SpectralValue V, StaticFrameType F>
constexpr FullMueller<V, incident, exitant, F> linear_polarizer(const V& transmittance, const F&,
                                                                scalar_t<V> theta) {
  using T = scalar_t<V>;
  const T c = std::cos(2 * theta), s = std::sin(2 * theta);
  const V a = V(T(0.5)) * transmittance, none = V(0);
  return FullMueller<V, incident, exitant, F>::from_rows({{{a, c * a, s * a, none},
                                                           {c * a, c * c * a, s * c * a, none},
                                                           {s * a, s * c * a, s * s * a, none},
                                                           {none, none, none, none}}});
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
