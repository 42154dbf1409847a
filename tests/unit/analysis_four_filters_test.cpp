// SPDX-License-Identifier: MIT
// Equation 1 of the paper: four readings behind a retarder and a polarizer, and back.
#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include <malus/analysis/four_filters.hpp>
#include <malus/analyzer.hpp>
#include <malus/equality.hpp>
#include <malus/optics/polarizer.hpp>
#include <malus/optics/retarder.hpp>
#include <malus/propagate.hpp>

#include "unit/optics_support.hpp"

namespace {

using namespace optics_test;
using malus::incident;
using Lab = malus::StaticFrame<struct LabTag>;

/// θ of the polarizer and φ of the retarder of each reading, in degrees.
constexpr struct {
  double polarizer, retarder;
} filters[4] = {{0, 0}, {45, 0}, {90, 0}, {45, 90}};

}  // namespace

TEST_CASE("the four filters are e0ᵀ P(θ) Q(φ) of the optics themselves, in static frames") {
  const auto four = malus::four_filters<double>(Lab{});
  const auto intensity = malus::Analyzer<double, malus::exitant, Lab>::intensity(1);
  for (int r = 0; r < 4; ++r) {
    const auto polarizer = malus::linear_polarizer(1.0, Lab{}, radians(filters[r].polarizer));
    const auto retarder = malus::linear_retarder(1.0, radians(filters[r].retarder), Lab{});
    const auto row = intensity * (polarizer * malus::propagate(retarder));
    const std::array<double, 4> expected{four(r, 0), four(r, 1), four(r, 2), four(r, 3)};
    CHECK(deviation_of_four(row, expected) <= 1e-15);
  }
}

TEST_CASE("light read behind real filters at run time gives what the four rows read") {
  Random random(70);
  for (int i = 0; i < 100; ++i) {
    const auto frame = random.frame();
    const auto d = random.direction();
    const malus::Stokes<double, incident> light(1.3, d[0], d[1], d[2],
                                                frame.turned(random.between(0, 3)));
    const auto readings = malus::four_filters<double>(frame) * light;
    for (std::size_t r = 0; r < 4; ++r) {
      const auto retarder = malus::linear_retarder(1.0, radians(filters[r].retarder), frame);
      const auto polarizer = malus::linear_polarizer(1.0, frame, radians(filters[r].polarizer));
      const auto seen = polarizer * malus::propagate(retarder * light);
      CHECK(std::abs(readings[r] - seen[0]) <= 1e-14);
    }
  }
}

TEST_CASE("the rows are those printed in equation 1") {
  constexpr double expected[4][4] = {
      {0.5, 0.5, 0, 0}, {0.5, 0, 0.5, 0}, {0.5, -0.5, 0, 0}, {0.5, 0, 0, 0.5}};
  const auto four = malus::four_filters<Double3>(Lab{});
  for (std::size_t c = 0; c < 3; ++c) CHECK(deviation(four, expected, c) == 0);
}

TEST_CASE("the inverse of equation 1 gives the light of any four readings back") {
  Random random(71);
  for (int i = 0; i < 100; ++i) {
    const auto frame = random.frame();
    const Double3 s0 = random.between3(1, 2);
    const malus::Stokes<Double3, incident> light(s0, random.between3(-1, 1), random.between3(-1, 1),
                                                 random.between3(-1, 1), frame);
    const auto back =
        malus::from_four_filters<incident>(malus::four_filters<Double3>(frame) * light, frame);
    CHECK(malus::is_close(back, light, 1e-14));
    // By filters at another angle to the light: the same light, in their frame.
    const auto other = frame.turned(random.between(0, 3));
    const auto again =
        malus::from_four_filters<incident>(malus::four_filters<Double3>(other) * light, other);
    CHECK(malus::is_close(again, light, 1e-13));
  }
}
