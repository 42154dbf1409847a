// SPDX-License-Identifier: MIT
// An optical rotator (optically active medium): turns the plane of polarisation. Not to be confused
// with a rotation of the frame: turning the light by α is what turning the frame by −α looks like.
#pragma once

#include <cmath>

#include <malus/mueller.hpp>

namespace malus {

/// Turns the plane of polarisation by `angle` radians, finite, counter-clockwise in the receiver's
/// view; to 2 ulp.
template <SpectralValue V, FrameType F>
FullMueller<V, incident, exitant, F> rotator(const V& transmittance, const V& angle,
                                             const F& frame) {
  const V c = transmittance * map_channels([](auto x) { return std::cos(2 * x); }, angle);
  const V s = transmittance * map_channels([](auto x) { return std::sin(2 * x); }, angle);
  const V none = V(0);
  return FullMueller<V, incident, exitant, F>::from_rows({{{transmittance, none, none, none},
                                                           {none, c, -s, none},
                                                           {none, s, c, none},
                                                           {none, none, none, transmittance}}},
                                                         frame, frame);
}

}  // namespace malus
