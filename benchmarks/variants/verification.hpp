// SPDX-License-Identifier: MIT
// That variants which should make the same picture do, sample by sample.
#pragma once

#include "variant.hpp"

namespace variants {

/// How two pictures of one sample a pixel differ: of each pixel and channel, the largest difference
/// of the four Stokes components, over S0 or a hundredth of the picture's mean of it.
struct Difference {
  double median = 0, largest = 0;
  double share = 0;      ///< of values that differ by more than `bound`
  bool is_equal = true;  ///< in every bit
};
inline constexpr double bound = 1e-3;

Difference compare(const renderer::Scene& scene, Variant a, Variant b);

/// The share of values that may differ by more than the bound: none where all variants trace the
/// same paths to the bit. Where directions are drawn by polarisation, rounding decides now and then
/// which way a path goes on.
double allowed_share(const renderer::Scene& scene);

}  // namespace variants
