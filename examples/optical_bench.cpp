// SPDX-License-Identifier: MIT
// An optical bench: the elements stand on one axis, so that one static frame serves them all, and a
// wrong order, a missing propagation or another frame would not compile. Prints Malus's law, and
// the paper's equation 1 and its inverse.
#include <cmath>
#include <cstdio>
#include <malus/malus.hpp>
#include <numbers>

using namespace malus;

struct Bench;  // x along the table, y up, light towards the observer
using OnBench = StaticFrame<Bench>;
using Light = Stokes<double, exitant, OnBench>;

constexpr double degrees = std::numbers::pi / 180;

/// Unpolarised light, a polarizer at 0°, an analyser turned by each angle: I = ½ cos² θ.
void malus_law(const OnBench& bench) {
  std::puts("Malus's law\n  angle   transmitted   cos^2/2");
  const auto polarizer = linear_polarizer(1.0, bench);
  for (double angle = 0; angle <= 90; angle += 15) {
    const auto analyzer = linear_polarizer(1.0, bench, angle * degrees);
    const auto seen = analyzer * propagate(polarizer * propagate(Light(1, 0, 0, 0)));
    const double c = std::cos(angle * degrees);
    std::printf("  %5.0f   %11.6f   %7.6f\n", angle, seen.intensity(), c * c / 2);
  }
}

/// Four readings behind filters determine the light: equation 1 forwards, then backwards.
void equation_1(const OnBench& bench) {
  const Light light = from_ellipse(1.0, 0.8, 34 * degrees, 20 * degrees, bench);
  const auto reading = four_filters<double>(bench) * propagate(light);
  const auto found = from_four_filters(reading, bench);
  std::printf("\nEquation 1: readings %.4f %.4f %.4f %.4f\n", reading[0], reading[1], reading[2],
              reading[3]);
  std::printf("  light sent   %.4f %.4f %.4f %.4f\n", light[0], light[1], light[2], light[3]);
  std::printf("  light found  %.4f %.4f %.4f %.4f, DoP %.4f\n", found[0], found[1], found[2],
              found[3], degree_of_polarization(found));
}

int main() {
  const OnBench bench;
  malus_law(bench);
  equation_1(bench);
}
