// SPDX-License-Identifier: MIT
// One pixel's Stokes vector for one colour channel: light that arrives at the sensor, in the frame
// x = right, y = up of the picture. All pixels share that frame, so it is a type, takes no storage
// and is never rotated to.
#pragma once

#include <cmath>
#include <cstddef>
#include <malus/analysis/polarization_state.hpp>
#include <malus/side.hpp>
#include <malus/stokes.hpp>
#include <malus/sum.hpp>

#include "../core/rounding.hpp"
#include "finite.hpp"

namespace renderer {

struct PictureAxes;
using PictureFrame = malus::StaticFrame<PictureAxes>;
using StokesPixel = malus::Stokes<float, malus::incident, PictureFrame>;

inline bool is_finite(const StokesPixel& s) {
  return is_finite(s[0]) && is_finite(s[1]) && is_finite(s[2]) && is_finite(s[3]);
}

/// By how much of the polarised part more than there is light; negative where the vector can be one
/// of light. In double precision, since squares of small floats vanish.
inline double excess_of_polarization(const StokesPixel& s) {
  const auto part = [&](std::size_t i) { return static_cast<double>(s[i]); };
  return std::hypot(part(1), part(2), part(3)) - part(0);
}

/// What of an excess is rounding.
inline double rounding(const StokesPixel& s) {
  return rounding_of_polarization(static_cast<double>(s[0]));
}

/// Whether any light can have this Stokes vector, but for rounding.
inline bool is_physical(const StokesPixel& s) { return excess_of_polarization(s) <= rounding(s); }

}  // namespace renderer
