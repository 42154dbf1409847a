// SPDX-License-Identifier: MIT
// One pixel's Stokes vector for one colour channel: light that arrives at the sensor, in the frame
// x = right, y = up of the picture. All pixels share that frame, so it is a type, takes no storage
// and is never rotated to.
#pragma once

#include <malus/analysis/physicality.hpp>
#include <malus/analysis/polarization_state.hpp>
#include <malus/side.hpp>
#include <malus/stokes.hpp>
#include <malus/sum.hpp>

#include "finite.hpp"

namespace renderer {

struct PictureAxes;
using PictureFrame = malus::StaticFrame<PictureAxes>;
using StokesPixel = malus::Stokes<float, malus::incident, PictureFrame>;

inline bool is_finite(const StokesPixel& s) {
  return is_finite(s[0]) && is_finite(s[1]) && is_finite(s[2]) && is_finite(s[3]);
}

/// Whether any light can have this Stokes vector, but for rounding.
inline bool is_physical(const StokesPixel& s) { return malus::is_physical(s, 1e-4F); }

}  // namespace renderer
