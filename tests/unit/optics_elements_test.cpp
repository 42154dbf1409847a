// SPDX-License-Identifier: MIT
// What polarizers, retarders, rotators, diattenuators and depolarizers do to light.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>

#include <malus/analysis/physicality.hpp>
#include <malus/analysis/polarization_state.hpp>
#include <malus/optics/depolarizer.hpp>
#include <malus/optics/diattenuator.hpp>
#include <malus/optics/polarizer.hpp>
#include <malus/optics/retarder.hpp>
#include <malus/optics/rotator.hpp>
#include <malus/propagate.hpp>

#include "unit/optics_support.hpp"

namespace {

using namespace optics_test;
using malus::Handedness;
using Lab = malus::StaticFrame<struct LabTag>;
using Light = malus::Stokes<double, malus::incident, Lab>;
using Four = std::array<double, 4>;

constexpr double tolerance = 1e-13;
constexpr int trials = 200;

template <class M>
Four applied(const M& m, const Four& s) {
  const auto out = m * Light(s[0], s[1], s[2], s[3]);
  return {out[0], out[1], out[2], out[3]};
}

/// M^T M of the lower right 3×3: the identity for what only turns the Poincaré sphere.
template <class M>
double distance_from_orthogonal(const M& m) {
  double worst = 0;
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c) {
      double sum = 0;
      for (int k = 0; k < 4; ++k) sum += m(k, r) * m(k, c);
      worst = worse(worst, sum - (r == c ? 1 : 0));
    }
  return worst;
}

/// Both criteria: the coherency matrix, and that no physical light becomes unphysical.
template <class M>
bool is_physical_both_ways(const M& m, Random& random) {
  if (!malus::is_physical(m, 1e-12)) return false;
  for (int i = 0; i < 8; ++i) {
    const auto d = random.direction();
    const auto out = m * malus::Stokes<double, malus::incident>(1, d[0], d[1], d[2], m.enter());
    if (!malus::is_physical(out, 1e-9) && out[0] > 1e-12) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("Malus's law: cos² of the angle between polarisation and polarizer") {
  for (int degrees = 0; degrees <= 360; degrees += 5) {
    const double theta = radians(degrees);
    const auto polarizer = malus::linear_polarizer(1.0, Lab{}, theta);
    CHECK(applied(polarizer, {1, 1, 0, 0})[0] == doctest::Approx(std::pow(std::cos(theta), 2)));
    CHECK(applied(polarizer, {1, 0, 0, 0})[0] == doctest::Approx(0.5));
    CHECK(applied(polarizer, {1, 0, 0, 1})[0] == doctest::Approx(0.5));
  }
}

TEST_CASE("crossed polarizers block, and a third at 45 degrees between them passes an eighth") {
  Random random(30);
  const auto frame = random.frame();
  const auto light = malus::Stokes<double, malus::incident>::unpolarized(1);
  const auto first = malus::linear_polarizer(1.0, frame);
  const auto middle = malus::linear_polarizer(1.0, frame, pi / 4);
  const auto last = malus::linear_polarizer(1.0, frame, pi / 2);
  CHECK(std::abs((last * malus::propagate(first * light))[0]) <= tolerance);
  CHECK((last * malus::propagate(middle * malus::propagate(first * light)))[0] ==
        doctest::Approx(0.125));
  CHECK((last * malus::propagate(middle * malus::propagate(first)))(0, 0) ==
        doctest::Approx(0.125));
}

TEST_CASE("a polarizer polarises fully along its axis, and twice is once") {
  Random random(31);
  for (int i = 0; i < trials; ++i) {
    const double theta = random.between(0, pi);
    const auto polarizer = malus::linear_polarizer(1.0, Lab{}, theta);
    const auto out = polarizer * Light(1, 0, 0, 0);
    CHECK(malus::degree_of_linear_polarization(out) == doctest::Approx(1));
    CHECK(malus::angle_of_linear_polarization(out) == doctest::Approx(theta));
    CHECK(difference(polarizer * malus::propagate(polarizer), polarizer) <= tolerance);
  }
}

TEST_CASE("a circular polarizer passes its own hand, blocks the other and makes its own") {
  for (const auto hand : {Handedness::right, Handedness::left}) {
    const double sign = hand == Handedness::right ? 1 : -1;
    const auto polarizer = malus::circular_polarizer(1.0, hand, Lab{});
    const Light own(1, 0, 0, sign), other(1, 0, 0, -sign), none(1, 0, 0, 0);
    CHECK(deviation_of_four(polarizer * own, Four{1, 0, 0, sign}) <= tolerance);
    CHECK(deviation_of_four(polarizer * other, Four{}) <= tolerance);
    CHECK(deviation_of_four(polarizer * none, Four{0.5, 0, 0, sign / 2}) <= tolerance);
    CHECK(difference(polarizer * malus::propagate(polarizer), polarizer) <= tolerance);
  }
}

TEST_CASE("a quarter-wave retarder between polarizers makes a circular polarizer of light") {
  // Fast axis at 45 degrees from light along x: right or left by which side it is on.
  const auto plus = malus::elliptical_retarder(1.0, {0, 1, 0}, pi / 2, Lab{});
  const auto minus = malus::elliptical_retarder(1.0, {0, -1, 0}, pi / 2, Lab{});
  CHECK(deviation_of_four(plus * Light(1, 1, 0, 0), Four{1, 0, 0, 1}) <= tolerance);
  CHECK(deviation_of_four(minus * Light(1, 1, 0, 0), Four{1, 0, 0, -1}) <= tolerance);
}

TEST_CASE("retarders and rotators turn the Poincaré sphere and lose nothing") {
  Random random(32);
  for (int i = 0; i < trials; ++i) {
    const double phase = random.between(-7, 7);
    const auto fast = random.direction();
    const auto retarder = malus::elliptical_retarder(1.0, fast, phase, Lab{});
    CHECK(distance_from_orthogonal(retarder) <= tolerance);
    CHECK(distance_from_orthogonal(malus::linear_retarder(1.0, phase, Lab{})) <= tolerance);
    CHECK(distance_from_orthogonal(malus::rotator(1.0, phase, Lab{})) <= tolerance);
    // The eigenpolarisation stays, and there and back is nothing.
    const Four own{1, fast[0], fast[1], fast[2]};
    CHECK(deviation_of_four(applied(retarder, own), own) <= tolerance);
    const auto back = malus::elliptical_retarder(1.0, fast, -phase, Lab{});
    CHECK(deviation(back * malus::propagate(retarder),
                    std::array<Four, 4>{
                        {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}}) <= tolerance);
  }
}

TEST_CASE("a rotator turns the angle of polarisation counter-clockwise, a half wave mirrors it") {
  Random random(33);
  const auto frame = random.frame();
  for (const double angle : {0.1, 0.5, 1.0, 1.5}) {
    const malus::Stokes<double, malus::incident> light(1, std::cos(0.4), std::sin(0.4), 0, frame);
    const auto out = malus::rotator(1.0, angle, frame) * light;
    CHECK(malus::angle_of_linear_polarization(out) == doctest::Approx(0.2 + angle));
    const auto mirrored = malus::linear_retarder(1.0, pi, frame, 0.7 + angle) * light;
    CHECK(malus::angle_of_linear_polarization(mirrored.expressed_in(frame)) ==
          doctest::Approx(std::fmod(2 * (0.7 + angle) - 0.2, pi)));
    // Turning the light is not turning the frame: what the latter does is the opposite.
    const auto seen = light.expressed_in(frame.turned(-angle));
    CHECK(deviation_of_four(seen, Four{out[0], out[1], out[2], out[3]}) <= tolerance);
  }
}

TEST_CASE("diattenuators: transmittances of eigenpolarisations, limits of none and of polarizers") {
  Random random(34);
  for (int i = 0; i < trials; ++i) {
    const double x = random.unit(), y = random.unit();
    const auto m = malus::linear_diattenuator(x, y, Lab{});
    CHECK(deviation_of_four(applied(m, {1, 1, 0, 0}), Four{x, x, 0, 0}) <= tolerance);
    CHECK(deviation_of_four(applied(m, {1, -1, 0, 0}), Four{y, -y, 0, 0}) <= tolerance);
    const auto n = random.direction();
    const double d = random.unit(), t = random.unit();
    const auto general = malus::elliptical_diattenuator(t, {d * n[0], d * n[1], d * n[2]}, Lab{});
    const double most = t * (1 + d), least = t * (1 - d);
    CHECK(deviation_of_four(applied(general, {1, n[0], n[1], n[2]}),
                            Four{most, most * n[0], most * n[1], most * n[2]}) <= tolerance);
    CHECK(deviation_of_four(applied(general, {1, -n[0], -n[1], -n[2]}),
                            Four{least, -least * n[0], -least * n[1], -least * n[2]}) <= tolerance);
  }
  CHECK(difference(malus::linear_diattenuator(1.0, 0.0, Lab{}),
                   malus::linear_polarizer(1.0, Lab{})) <= tolerance);
  CHECK(difference(malus::elliptical_diattenuator(0.5, {0, 0, -1}, Lab{}),
                   malus::circular_polarizer(1.0, Handedness::left, Lab{})) <= tolerance);
  CHECK(difference(malus::elliptical_diattenuator(0.5, {0, 0, 0}, Lab{}),
                   malus::attenuator<double, Lab>(0.5)) <= tolerance);
}

TEST_CASE("depolarizers keep the intensity they should, and of the polarisation b/a") {
  const Light light(2, 0.5, -1, 1.5);
  const auto ideal = malus::depolarizer<double, Lab>(0.4) * light;
  CHECK(deviation_of_four(ideal, Four{0.8, 0, 0, 0}) <= tolerance);
  const auto partial = malus::partial_depolarizer<double, Lab>(0.8, 0.2) * light;
  CHECK(deviation_of_four(partial, Four{1.6, 0.1, -0.2, 0.3}) <= tolerance);
  const auto dim = malus::attenuator<double, Lab>(0.5) * light;
  CHECK(deviation_of_four(dim, Four{1, 0.25, -0.5, 0.75}) <= tolerance);
}

TEST_CASE("every element is physical, whatever its parameters") {
  Random random(35);
  for (int i = 0; i < trials; ++i) {
    const auto frame = random.frame();
    const double theta = random.between(-4, 4), t = random.unit(), d = random.unit();
    const auto n = random.direction();
    CHECK(is_physical_both_ways(malus::linear_polarizer(t, frame, theta), random));
    CHECK(is_physical_both_ways(malus::linear_retarder(t, 3 * theta, frame, theta), random));
    CHECK(is_physical_both_ways(malus::elliptical_retarder(t, n, theta, frame), random));
    CHECK(is_physical_both_ways(malus::rotator(t, theta, frame), random));
    CHECK(is_physical_both_ways(malus::linear_diattenuator(t, d, frame, theta), random));
    CHECK(is_physical_both_ways(
        malus::elliptical_diattenuator(t, {d * n[0], d * n[1], d * n[2]}, frame), random));
    CHECK(is_physical_both_ways(malus::circular_polarizer(t, Handedness::left, frame), random));
    CHECK(malus::is_physical(malus::depolarizer(t), 1e-12));
    CHECK(malus::is_physical(malus::partial_depolarizer(t, t * d), 1e-12));
    CHECK(malus::is_physical(malus::attenuator(t), 1e-12));
  }
}

TEST_CASE("elements in float are those in double to a few roundings") {
  Random random(36);
  using Vector = std::array<float, 3>;
  constexpr double few = 16 * std::numeric_limits<float>::epsilon();
  for (int i = 0; i < trials; ++i) {
    const auto theta = static_cast<float>(random.between(-4, 4));
    const auto t = static_cast<float>(random.unit()), d = static_cast<float>(random.unit());
    const auto n = random.direction();
    const Vector axis{static_cast<float>(n[0]), static_cast<float>(n[1]), static_cast<float>(n[2])};
    const std::array<double, 3> same{axis[0], axis[1], axis[2]};
    const double theta2 = theta, t2 = t, d2 = d;
    CHECK(difference(malus::linear_polarizer(t, Lab{}, theta),
                     malus::linear_polarizer(t2, Lab{}, theta2)) <= few);
    CHECK(difference(malus::linear_retarder(t, theta, Lab{}),
                     malus::linear_retarder(t2, theta2, Lab{})) <= few);
    CHECK(difference(malus::elliptical_retarder(t, axis, theta, Lab{}),
                     malus::elliptical_retarder(t2, same, theta2, Lab{})) <= few);
    CHECK(difference(malus::rotator(t, theta, Lab{}), malus::rotator(t2, theta2, Lab{})) <= few);
    CHECK(difference(malus::linear_diattenuator(t, d, Lab{}),
                     malus::linear_diattenuator(t2, d2, Lab{})) <= few);
  }
}
