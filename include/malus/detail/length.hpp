// SPDX-License-Identifier: MIT
// Roots of sums of squares and of products that are in range where what is under the root is not.
// In the ordinary range they are the plain formula, to the last bit.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>

namespace malus::detail {

/// Neither so small that digits are lost nor infinite; false of 0 and NaN. (The largest number
/// itself is not compared with: -ffast-math would leave that out.)
template <std::floating_point T>
constexpr bool is_in_range(T x) {
  using Limits = std::numeric_limits<T>;
  return x > Limits::min() / Limits::epsilon() && x < Limits::max() / 4;
}

/// √(a² + b² + c²).
template <std::floating_point T>
T length_of(T a, T b, T c = 0) {
  const T square = a * a + b * b + c * c;
  if (is_in_range(square)) return std::sqrt(square);
  const T largest = std::max({std::abs(a), std::abs(b), std::abs(c)});
  if (!(largest > 0) || !(largest < std::numeric_limits<T>::max())) return std::sqrt(square);
  const T x = a / largest, y = b / largest, z = c / largest;
  return largest * std::sqrt(x * x + y * y + z * z);
}

/// √(ab) of numbers that are not negative. (√a √b would do, but -ffast-math makes √(ab) of it.)
template <std::floating_point T>
T geometric_mean(T a, T b) {
  const T product = a * b;
  if (is_in_range(product) || !(a > 0) || !(b > 0)) return std::sqrt(product);
  const int i = std::ilogb(a) / 2, j = std::ilogb(b) / 2;
  return std::ldexp(std::sqrt(std::ldexp(a, -2 * i) * std::ldexp(b, -2 * j)), i + j);
}

}  // namespace malus::detail
