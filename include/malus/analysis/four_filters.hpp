// SPDX-License-Identifier: MIT
// Measuring light with four filters, and back (paper, equation 1): readings behind linear
// polarizers at 0°, 45° and 90° and behind a quarter-wave retarder with a polarizer at 45°.
#pragma once

#include <malus/product.hpp>

namespace malus {

/// The four rows e0ᵀP(0°)Q(0°), e0ᵀP(45°)Q(0°), e0ᵀP(90°)Q(0°), e0ᵀP(45°)Q(90°) as one importance.
template <SpectralValue V, SideTag Side = incident, FrameType F>
constexpr Importance<V, Side, F, ImportanceForm::full> four_filters(const F& frame) {
  const V h(scalar_t<V>(0.5)), z(scalar_t<V>(0));
  return Importance<V, Side, F, ImportanceForm::full>::from_rows(
      {{{h, h, z, z}, {h, z, h, z}, {h, -h, z, z}, {h, z, z, h}}}, frame);
}

/// The light that gives these readings behind the four filters: the inverse of equation 1.
template <SideTag Side = incident, SpectralValue V, FrameType F>
constexpr Stokes<V, Side, F> from_four_filters(const Measurement<V>& reading, const F& frame) {
  const V s0 = reading[0] + reading[2];
  return {s0, reading[0] - reading[2], reading[1] + reading[1] - s0, reading[3] + reading[3] - s0,
          frame};
}

}  // namespace malus
