// SPDX-License-Identifier: MIT
// Whether a number is neither infinite nor NaN, by its bits: std::isfinite is always true under
// -ffast-math, which renderers are compiled with.
#pragma once

#include <bit>
#include <cstdint>

namespace renderer {

inline bool is_finite(float value) {
  constexpr std::uint32_t exponent = 0x7f800000U;
  return (std::bit_cast<std::uint32_t>(value) & exponent) != exponent;
}

inline bool is_finite(double value) {
  constexpr std::uint64_t exponent = 0x7ff0000000000000U;
  return (std::bit_cast<std::uint64_t>(value) & exponent) != exponent;
}

}  // namespace renderer
