// SPDX-License-Identifier: MIT
// The arithmetic of benchmarks/convergence: errors without the noise of what pictures are compared
// with, slopes and times. The benchmarks aren't built with the tests, so that the sources stand
// here. Random numbers are fixed; tolerances are five standard errors or more.
#include "../../benchmarks/convergence/curve.cpp"
#include "../../benchmarks/convergence/errors.cpp"

#include "../../benchmarks/convergence/budget.hpp"

#include <doctest/doctest.h>

#include <array>
#include <random>

using namespace convergence;

namespace {

constexpr int width = 64;
/// Of S0 to S3 everywhere, in all channels.
constexpr double truth[4] = {1, 0.3, -0.2, 0.1};

/// The truth with normal noise and an offset of S0.
Picture picture(unsigned seed, double noise, double offset = 0) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal;
  Picture p{width, width, {}, 1, 1};
  for (std::size_t i = 0; i < planes; ++i)
    for (int k = 0; k < width * width; ++k)
      p.data.push_back(
          static_cast<float>(truth[i / 3] + (i < 3 ? offset : 0) + noise * normal(generator)));
  return p;
}

Half half(unsigned seed, double noise, double offset = 0) {
  Half h;
  for (unsigned k = 0; k < 8; ++k) h.batches.push_back(picture(seed + k, noise, offset));
  return h;
}

/// Errors c·tᵖ in all quantities after t samples and seconds, of three repeats that differ a
/// little.
Curve curve(double c, double power) {
  Curve result{"scene", "path", "optimized", "auto", "optimized", "sobol", {}};
  for (const double t : {1.0, 2.0, 4.0, 8.0}) {
    Point p;
    p.samples = static_cast<std::uint64_t>(t);
    for (const double part : {0.98, 1.0, 1.02}) {
      Errors e;
      const double error = c * std::pow(t, power) * part;
      e.relative_square.fill(error * error);
      p.repeats.push_back(e);
      p.seconds.push_back(t);
    }
    result.points.push_back(p);
  }
  return result;
}

/// The same with errors and times of each repeat times a factor.
Curve scaled(Curve c, const std::array<double, 3>& error, double time) {
  for (Point& p : c.points)
    for (std::size_t r = 0; r < p.repeats.size(); ++r) {
      for (double& square : p.repeats[r].relative_square) square *= error[r] * error[r];
      p.seconds[r] *= time;
    }
  return c;
}

/// Equal but for a part.
bool near(double value, double expected, double part) {
  return std::abs(value - expected) < part * std::abs(expected);
}

}  // namespace

TEST_CASE("convergence: a picture's error has none of the reference's noise in it") {
  const Reference reference(half(100, 0.5), half(200, 0.2));
  // The two means' noise, squared, is 0.03 and 0.005.
  for (const double noise : {0.1, 0.3}) {
    const double square = noise * noise;
    const Errors e = reference.errors(picture(1, noise));
    for (std::size_t s = 0; s < 4; ++s)
      CHECK(std::abs(e.square[s] - square) < 0.05 * square + 8e-4);
    CHECK(std::abs(e.square[polarization] - 3 * square) < 0.12 * square + 2e-3);
    // S0 is 1, and a tenth of it the floor.
    CHECK(near(e.relative_square[1], e.square[1] / 1.01, 0.1));
  }
  const Errors exact = reference.errors(picture(1, 0));
  for (std::size_t q = 0; q < degree; ++q)
    CHECK(std::abs(exact.relative_square[q]) < 5 * exact.uncertainty[q]);
}

TEST_CASE("convergence: what the halves do not agree on is found") {
  const Reference reference(half(100, 0.5), half(200, 0.2));
  CHECK(near(reference.errors(picture(1, 0.1, 0.2)).square[0], 0.05, 0.1));
  CHECK(std::abs(reference.distance()[0]) < 5 * reference.distance_error()[0]);
  CHECK(std::abs(reference.distance()[polarization]) <
        5 * reference.distance_error()[polarization]);
  const Reference disagreeing(half(100, 0.5), half(200, 0.2, 0.1));
  CHECK(disagreeing.distance()[0] > 5 * disagreeing.distance_error()[0]);
  CHECK(near(disagreeing.distance()[0], 0.01, 0.3));
}

TEST_CASE("convergence: the reference's standard error is that of its weighted mean") {
  const Reference reference(half(100, 0.5), half(200, 0.2));
  // Weights by variance: 0.25/8 and 0.04/8, relative to S0² + 0.1².
  const double expected = std::sqrt(1 / (8 / 0.25 + 8 / 0.04) / 1.01);
  CHECK(near(reference.a().weight, 0.04 / 0.29, 0.05));
  CHECK(near(reference.standard_error()[0], expected, 0.05));
  CHECK(near(reference.standard_error()[polarization], std::sqrt(3) * expected, 0.05));
}

TEST_CASE("convergence: noise polarises the picture that is measured, but not the reference") {
  const Reference reference(half(100, 0.5), half(200, 0.2));
  CHECK(near(reference.mean_degree(), std::sqrt(0.14), 0.01));
  const Errors exact = reference.errors(picture(1, 0)), noisy = reference.errors(picture(1, 0.5));
  CHECK(std::abs(exact.dop_bias) < 0.003);
  CHECK(std::abs(exact.square[degree]) < 2e-4);
  CHECK(noisy.dop_bias > 0.1);
  CHECK(noisy.square[degree] > noisy.dop_bias * noisy.dop_bias);
}

TEST_CASE("convergence: slopes, times to an error, and what is too close to the reference") {
  const Reference reference(half(100, 0.05), half(200, 0.05));
  const Curve c = curve(0.4, -0.5);
  const auto line = c.line(0, reference);
  REQUIRE(line);
  CHECK(near(line->slope, -0.5, 1e-6));
  CHECK(line->slope_error < 1e-6);
  const auto within = c.time_to(0.2, 0, reference), beyond = c.time_to(0.1, 0, reference),
             before = c.time_to(1, 0, reference);
  REQUIRE((within && beyond && before));
  CHECK(within->how == Found::measured);
  CHECK(near(within->seconds, 4, 0.01));
  CHECK(beyond->how == Found::extrapolated);
  CHECK(near(beyond->seconds, 16, 0.01));
  CHECK(before->how == Found::at_most);
  CHECK_FALSE(c.time_to(0.001, 0, reference));
  CHECK_FALSE(curve(0.4, 0).time_to(0.1, 0, reference));
  // The reference's standard error is 0.05/4 by 1/√1.01.
  CHECK(curve(0.026, 0).points[0].resolved(0, reference));
  CHECK_FALSE(curve(0.024, 0).points[0].resolved(0, reference));
  CHECK_FALSE(curve(0.02, -0.5).line(0, reference));
}

TEST_CASE("convergence: what interrupts single pictures moves no time") {
  const Reference reference(half(100, 0.05), half(200, 0.05));
  Curve c = curve(0.4, -0.5);
  c.points[1].seconds = {20, 2, 2};
  c.points[3].seconds = {8, 8, 80};
  CHECK(near(c.seconds_a_sample(), 1, 1e-12));
  CHECK(near(c.seconds(c.points[3]), 8, 1e-12));
  CHECK(near(c.time_to(0.2, 0, reference)->seconds, 4, 0.01));
  CHECK(near(c.line(0, reference)->slope, -0.5, 1e-6));
}

TEST_CASE(
    "convergence: a gain is the ratio of squared errors, at equal time less what time it costs") {
  const Reference reference(half(100, 0.05), half(200, 0.05));
  const Curve base = curve(0.4, -0.5), better = scaled(base, {0.5, 0.5, 0.5}, 1.25);
  const auto at_equal_samples = gain_over(base, better, 0, false, reference),
             at_equal_time = gain_over(base, better, 0, true, reference);
  REQUIRE((at_equal_samples && at_equal_time));
  CHECK(near(at_equal_samples->value, 4, 1e-9));
  CHECK(near(at_equal_time->value, 4 / 1.25, 1e-9));
  // All repeats gain alike: nothing is uncertain.
  CHECK(near(at_equal_samples->low, 4, 1e-9));
  CHECK(near(at_equal_samples->high, 4, 1e-9));
}

TEST_CASE("convergence: a gain's interval is Student's of what repeats differ by") {
  const Reference reference(half(100, 0.05), half(200, 0.05));
  const Curve base = curve(0.4, -0.5), other = scaled(base, {0.9, 1, 1.1}, 1);
  const auto gain = gain_over(base, other, 0, false, reference);
  REQUIRE(gain);
  // Without one repeat after the other, of squares 0.98², 1, 1.02² and these times 0.9², 1, 1.1².
  std::array<double, 3> logs{};
  const double b[] = {0.9604, 1, 1.0404}, c[] = {0.9604 * 0.81, 1, 1.0404 * 1.21};
  double mean = 0, square = 0;
  for (std::size_t r = 0; r < 3; ++r) {
    logs[r] = std::log((b[(r + 1) % 3] + b[(r + 2) % 3]) / (c[(r + 1) % 3] + c[(r + 2) % 3]));
    mean += logs[r] / 3;
  }
  for (const double l : logs) square += (l - mean) * (l - mean);
  const double half_width = 4.303 * std::sqrt(square * 2 / 3);
  CHECK(near(std::log(gain->high / gain->value), half_width, 1e-6));
  CHECK(near(std::log(gain->value / gain->low), half_width, 1e-6));
}

TEST_CASE("convergence: a gain is told only where both errors are above the reference's") {
  const Reference reference(half(100, 0.05), half(200, 0.05));
  const Curve base = curve(0.1, -0.5), exact = curve(1e-4, 0);
  CHECK_FALSE(gain_over(base, exact, 0, false, reference));
  // At the fourth point 0.035 is above the reference's 0.0124 twice, half of it is not.
  const auto gain = gain_over(base, scaled(base, {0.6, 0.6, 0.6}, 1), 0, false, reference);
  REQUIRE(gain);
  CHECK(near(gain->value, 1 / 0.36, 1e-9));
}

TEST_CASE("convergence: a budget of time is spent once") {
  // The longest rendering once a repeat, half of it twice, a quarter four times, an eighth four
  // times.
  CHECK(near(row_cost(4, 5, 2), (1 + 1 + 1 + 0.5) * 5 * 2 + 1, 1e-12));
  const Budget budget{1000, 4};
  CHECK(near(2 * 4 * budget.reference_seconds(), 250, 1e-12));
  // What references will take is not the first rows'.
  CHECK(
      near(budget.row_seconds(2 * budget.reference_seconds(), 12, 36, 3), 750.0 / (12 * 36), 1e-9));
  // Rows that take what they are given leave nothing, whatever references have taken.
  double passed = 0;
  std::size_t rows = 12;
  for (std::size_t scene = 0; scene < 4; ++scene) {
    passed += scene == 2 ? 5 : 2 * budget.reference_seconds();  // one is in the cache
    for (int i = 0; i < 3; ++i, --rows)
      passed += 36 * budget.row_seconds(passed, rows, 36, 3 - scene);
  }
  CHECK(near(passed, 1000, 1e-9));
  CHECK(budget.row_seconds(2000, 3, 36, 0) > 0);
}
