// SPDX-License-Identifier: MIT
#include "growth.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace stability {

namespace {

/// By least squares; `chosen` are indices of chains, with repetitions.
double slope_of(const std::vector<std::uint64_t>& checkpoints,
                const std::vector<std::vector<double>>& errors,
                const std::vector<std::size_t>& chosen, std::uint64_t from) {
  double weight = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t i = 0; i < checkpoints.size(); ++i) {
    double sum = 0, count = 0;
    for (const std::size_t chain : chosen)
      if (i < errors[chain].size() && errors[chain][i] != 0)
        sum += std::log(std::abs(errors[chain][i])), ++count;
    if (checkpoints[i] < from || !(count > 0)) continue;
    const double x = std::log(static_cast<double>(checkpoints[i])), y = sum / count;
    weight += count, sx += count * x, sy += count * y, sxx += count * x * x, sxy += count * x * y;
  }
  const double spread = weight * sxx - sx * sx;
  return spread > 0 ? (weight * sxy - sx * sy) / spread : 0;
}

}  // namespace

Growth fit_growth(const std::vector<std::uint64_t>& checkpoints,
                  const std::vector<std::vector<double>>& errors, std::uint64_t from) {
  std::vector<std::size_t> chosen(errors.size());
  for (std::size_t i = 0; i < chosen.size(); ++i) chosen[i] = i;
  Growth growth;
  growth.exponent = slope_of(checkpoints, errors, chosen, from);
  constexpr std::size_t samples = 500;
  std::mt19937_64 generator(1);
  std::vector<double> slopes(samples);
  for (double& slope : slopes) {
    // Within each length, so that every sample reaches as far.
    for (std::size_t i = 0; i < chosen.size(); ++i) {
      std::size_t first = i, last = i + 1;
      while (first > 0 && errors[first - 1].size() == errors[i].size()) --first;
      while (last < errors.size() && errors[last].size() == errors[i].size()) ++last;
      chosen[i] = first + static_cast<std::size_t>(generator() % (last - first));
    }
    slope = slope_of(checkpoints, errors, chosen, from);
  }
  std::sort(slopes.begin(), slopes.end());
  growth.low = slopes[samples * 25 / 1000];
  growth.high = slopes[samples * 975 / 1000];
  return growth;
}

}  // namespace stability
