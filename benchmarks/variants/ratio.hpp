// SPDX-License-Identifier: MIT
// The ratio of two series of durations that belong together in pairs, on a machine that others use
// too: what disturbs a turn makes it several times as long as the spread of the others, so that a
// mean is as good as its worst turn.
#pragma once

#include <cstddef>
#include <vector>

namespace variants {

struct Ratio {
  double value = 1, low = 1, high = 1;
};

/// There is no interval of 95 % of fewer pairs.
inline constexpr std::size_t least_pairs = 6;

/// The median of above/below, and its 95 % confidence interval, which two of the pairs' ratios
/// bound: how many of them are below the median of all that could be measured is a matter of
/// tossing coins, whatever their distribution (David & Nagaraja 2003, "Order Statistics",
/// section 7.1). Of fewer than least_pairs, the range of all.
Ratio ratio_of(const std::vector<double>& above, const std::vector<double>& below);

}  // namespace variants
