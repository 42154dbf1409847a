// SPDX-License-Identifier: MIT
// A phase function that is the same at all angles. A depolarizer.
//
// What every phase kind has: value(), the phase function for unpolarised light by solid angle,
// whose integral over the sphere is 1 in every channel; sample(), which draws cos Θ by one uniform
// number in [0, 1); pdf(), its density by solid angle and the mean of value()'s channels; where it
// polarizes, elements() of the phase matrix, whose a1 is value(). Θ is the angle between the
// directions of propagation before and after: cos Θ = 1 is straight on.
#pragma once

#include "../core/vector.hpp"

namespace renderer {

struct IsotropicPhase {
  static constexpr bool polarizes = false;

  Rgb value(float) const { return Rgb(1 / (4 * pi)); }
  float pdf(float) const { return 1 / (4 * pi); }
  float sample(float u) const { return 1 - 2 * u; }
};

}  // namespace renderer
