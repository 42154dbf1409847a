// SPDX-License-Identifier: MIT
// Diattenuators: transmittance that depends on polarisation (a polarizer that leaks, dichroic
// glass).
#pragma once

#include <array>
#include <cmath>

#include <malus/detail/length.hpp>
#include <malus/optics/turned.hpp>
#include <malus/product.hpp>

namespace malus {

/// Transmits the intensity `along_x` of light polarised along x and `along_y` of light along y,
/// neither negative; to 2 ulp, whatever their sizes. Mirror-symmetric.
template <SpectralValue V, FrameType F>
BlockMueller<V, incident, exitant, F> linear_diattenuator(const V& along_x, const V& along_y,
                                                          const F& frame) {
  const V half = V(scalar_t<V>(0.5));
  const V sum = half * (along_x + along_y), difference = half * (along_x - along_y);
  const V mean =
      map_channels([](auto x, auto y) { return detail::geometric_mean(x, y); }, along_x, along_y);
  const V none = V(0);
  return BlockMueller<V, incident, exitant, F>::block({sum, difference, difference, sum},
                                                      {mean, none, none, mean}, frame, frame);
}

/// The same with x at θ radians, counter-clockwise in the receiver's view.
template <SpectralValue V, FrameType F>
auto linear_diattenuator(const V& along_x, const V& along_y, const F& frame, scalar_t<V> theta) {
  return turned(linear_diattenuator(along_x, along_y, frame), theta);
}

/// The general diattenuator (Lu & Chipman 1996): mean transmittance T and diattenuation vector D =
/// (D1, D2, D3), |D| ≤ 1. Transmits T(1 + |D|) of light polarised as D and T(1 − |D|) of the
/// opposite. To 2 ulp over √(1 − |D|²); where |D| is above 1 that root is taken for 0.
template <SpectralValue V, FrameType F>
FullMueller<V, incident, exitant, F> elliptical_diattenuator(
    const V& transmittance, const std::array<scalar_t<V>, 3>& diattenuation, const F& frame) {
  using T = scalar_t<V>;
  const auto [a, b, c] = diattenuation;
  const T length2 = a * a + b * b + c * c;
  const T root = std::sqrt(length2 < 1 ? 1 - length2 : T(0));
  // (1 − √(1 − D²))/D² without cancellation.
  const T k = 1 / (1 + root);
  const auto v = [](T x) { return V(x); };
  return FullMueller<V, incident, exitant, F>::from_rows(
             {{{v(1), v(a), v(b), v(c)},
               {v(a), v(root + k * a * a), v(k * a * b), v(k * a * c)},
               {v(b), v(k * a * b), v(root + k * b * b), v(k * b * c)},
               {v(c), v(k * a * c), v(k * b * c), v(root + k * c * c)}}},
             frame, frame) *
         transmittance;
}

}  // namespace malus
