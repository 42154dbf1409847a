// SPDX-License-Identifier: MIT
// Error over time: points at growing times, each from independent pictures, and the line through
// their logarithms.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "errors.hpp"

namespace convergence {

struct Point {
  std::uint64_t samples = 0;
  std::vector<double> seconds;  ///< of each repeat's pictures, their mean
  std::vector<Errors> repeats;  ///< the same

  void add_repeat(const std::vector<Picture>& pictures, const Reference& reference);
  /// The root of the mean over repeats of the squared error (relative, or in the picture's units);
  /// 0 where that is below zero. Without one repeat, if one is named.
  double error(std::size_t quantity, bool relative = true,
               std::optional<std::size_t> without = {}) const;
  /// One standard error of error(), from the spread of the repeats.
  double spread(std::size_t quantity, bool relative = true) const;
  double dop_bias() const;
  /// Whether the error is well above the reference's: twice its standard error, and the squared one
  /// three times what the reference may have put it off by.
  bool resolved(std::size_t quantity, const Reference& reference) const;
};

/// log error = intercept + slope · log time.
struct Line {
  double intercept = 0, slope = 0;
  double slope_error = 0;  ///< by leaving out one repeat after the other
};

/// Measured; at_most, where the first point is better already; or extrapolated, along the line
/// through the last three points.
enum class Found { measured, at_most, extrapolated };

struct TimeTo {
  double seconds = 0;
  Found how = Found::measured;
  double error = 0;  ///< one standard error, as a part of the time
};

struct Curve {
  std::string scene, algorithm, variant, sampler;  ///< the latter two as they were asked for
  std::string mode, drawn_by;                      ///< and what they are in this scene
  std::vector<Point> points;

  /// The median of all pictures': what interrupts one of them is no cost of the algorithm, and
  /// samples cost the same however many there are.
  double seconds_a_sample() const;
  double seconds(const Point& p) const {
    return static_cast<double>(p.samples) * seconds_a_sample();
  }
  /// The line through the points that are resolved; none if there are less than three.
  std::optional<Line> line(std::size_t quantity, const Reference& reference) const;
  /// When an error is reached: between measured points along the straight line through both; no
  /// more than `reach` times as late as was measured.
  std::optional<TimeTo> time_to(double error, std::size_t quantity,
                                const Reference& reference) const;
};

inline constexpr double reach = 30;

/// How many times smaller a squared error is than another's, with its 95 % confidence interval.
struct Gain {
  std::uint64_t samples = 0;
  double value = 1, low = 1, high = 1;
};

/// Of one curve over a base of the same sample counts, at the most samples where both are resolved.
/// At equal time, the base's squared error is taken to fall by 1/time on the short way from its own
/// time to the other's. The interval is Student's, by leaving out one repeat after the other.
std::optional<Gain> gain_over(const Curve& base, const Curve& curve, std::size_t quantity,
                              bool at_equal_time, const Reference& reference);

}  // namespace convergence
