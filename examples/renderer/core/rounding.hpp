// SPDX-License-Identifier: MIT
// What of impossible light is no more than rounding.
#pragma once

#include <cmath>
#include <limits>

namespace renderer {

/// By how much the polarised part of an intensity may exceed it: a part of 10⁻⁴, and of subnormal
/// numbers, which have few digits or one, some of the least there is.
inline double rounding_of_polarization(double intensity) {
  return 1e-4 * std::fabs(intensity) +
         4 * static_cast<double>(std::numeric_limits<float>::denorm_min());
}

}  // namespace renderer
