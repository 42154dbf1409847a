// SPDX-License-Identifier: MIT
// The arithmetic of benchmarks/convergence: errors without the noise of what pictures are compared
// with, slopes and times. The benchmarks aren't built with the tests, so that the sources stand
// here. Random numbers are fixed; tolerances are five standard errors or more.
#include "../../benchmarks/convergence/curve.cpp"
#include "../../benchmarks/convergence/errors.cpp"

#include <doctest/doctest.h>

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

/// Errors c·tᵖ in all quantities, of three repeats that differ a little.
Curve curve(double c, double power) {
  Curve result{"scene", "path", "optimized", "optimized", {}};
  for (const double t : {1.0, 2.0, 4.0, 8.0}) {
    Point p;
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
