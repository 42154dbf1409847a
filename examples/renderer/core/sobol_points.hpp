// SPDX-License-Identifier: MIT
// Points of Sobol's sequence (1967) in two dimensions, scrambled as by Owen (1995): of any 2^k
// points, from a multiple of 2^k on, one is in each of 2^k equal boxes of every shape. One sample
// takes many such pairs, each of a sequence of its own: scrambled by itself, and in an order of its
// own, so that pairs know nothing of each other (Burley 2020, "Practical Hash-based Owen
// Scrambling"). Neither tables nor states: a hash takes the place of random bits.
#pragma once

#include <array>
#include <cstdint>

#include "vector.hpp"

namespace renderer {

struct SobolPoints {
  static constexpr std::uint32_t count = 16;

  /// Pairs first … first + count − 1 of point `index`. Different scramblings are independent.
  void fill(std::uint64_t scramble, std::uint32_t index, std::uint32_t first);

  std::array<float, count> x, y;
};

}  // namespace renderer
