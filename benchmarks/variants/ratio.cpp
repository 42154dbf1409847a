// SPDX-License-Identifier: MIT
#include "ratio.hpp"

#include <algorithm>
#include <cmath>

namespace variants {

namespace {

/// The most ratios that may be left out at either end: the largest k with P(fewer than k of n coins
/// show heads) ≤ 0.025, less one.
std::size_t left_out(std::size_t n) {
  double chance = std::exp2(-static_cast<double>(n)), sum = chance;  // of k heads, and of up to k
  std::size_t k = 0;
  while (sum <= 0.025) {
    chance *= static_cast<double>(n - k) / static_cast<double>(k + 1);
    sum += chance;
    ++k;
  }
  return k > 0 ? k - 1 : 0;
}

}  // namespace

Ratio ratio_of(const std::vector<double>& above, const std::vector<double>& below) {
  const std::size_t n = std::min(above.size(), below.size());
  if (n == 0) return {};
  std::vector<double> ratios(n);
  for (std::size_t i = 0; i < n; ++i) ratios[i] = above[i] / below[i];
  std::sort(ratios.begin(), ratios.end());
  const std::size_t out = left_out(n);
  // Ratios are symmetric as logarithms.
  return {std::sqrt(ratios[(n - 1) / 2] * ratios[n / 2]), ratios[out], ratios[n - 1 - out]};
}

}  // namespace variants
