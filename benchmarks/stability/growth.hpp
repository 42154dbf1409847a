// SPDX-License-Identifier: MIT
// The law by which errors grow with the length of chains: error ∝ nᵖ, p = ½ of a random walk and 1
// of a drift.
#pragma once

#include <cstdint>
#include <vector>

namespace stability {

struct Growth {
  double exponent = 0, low = 0, high = 0;  ///< with an interval of 95 %
};

/// The straight line through the means over chains of the errors' logarithms (polarisers that are
/// nearly crossed make a few chains' errors thousands of times the others', which would decide a
/// mean square), each point weighted by its number of chains; errors[chain][checkpoint], of chains
/// that differ in length. The interval is that of 500 bootstrap samples of the chains, since a
/// chain's checkpoints depend on each other. Only checkpoints from `from` on count.
Growth fit_growth(const std::vector<std::uint64_t>& checkpoints,
                  const std::vector<std::vector<double>>& errors, std::uint64_t from);

}  // namespace stability
