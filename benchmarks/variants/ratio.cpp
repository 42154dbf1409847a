// SPDX-License-Identifier: MIT
#include "ratio.hpp"

#include <algorithm>
#include <cmath>

namespace variants {

namespace {

/// The most ratios that may be left out at either end: the largest k with P(k or fewer of n coins
/// show heads) ≤ 0.025; 0 where there is none.
std::size_t left_out(std::size_t n) {
  // By the normal distribution where it is right to less than one coin.
  if (n > 200) {
    const auto coins = static_cast<double>(n);
    return static_cast<std::size_t>((coins - 1 - 1.959964 * std::sqrt(coins)) / 2);
  }
  double chance = std::exp2(-static_cast<double>(n)), sum = chance;  // of k heads, of k or fewer
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
