// SPDX-License-Identifier: MIT
// How the parts of a run share the time that is given for all.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace convergence {

/// How many pictures a point has in a repeat: short renderings vary most, and cost little.
constexpr std::size_t pictures_of(std::uint64_t samples, std::uint64_t most) {
  return static_cast<std::size_t>(std::min<std::uint64_t>(4, most / samples));
}

/// What a row takes, in lengths of its longest rendering: with finding out how long that is.
inline double row_cost(int points, int repeats, std::size_t variants) {
  double of_a_repeat = 0;
  for (int k = 0; k < points; ++k) {
    const double shorter = std::exp2(k);
    of_a_repeat += std::min(4.0, shorter) / shorter;
  }
  return of_a_repeat * repeats * static_cast<double>(variants) + 1;
}

/// A time for everything. A quarter is for references, the same for every scene, so that the next
/// run of the same length finds them in the cache; what they leave is for the rows.
struct Budget {
  double seconds = 0;
  std::size_t scenes = 1;

  /// Of each half of a reference.
  double reference_seconds() const { return seconds / 4 / 2 / static_cast<double>(scenes); }
  /// Of the longest rendering of the next row, when so much has passed and so many rows and
  /// references are still to come.
  double row_seconds(double passed, std::size_t rows, double cost, std::size_t references) const {
    const double reserved = 2 * reference_seconds() * static_cast<double>(references);
    const double left = (seconds - passed - reserved) / (static_cast<double>(rows) * cost);
    return std::max(0.01, left);
  }
};

}  // namespace convergence
