// SPDX-License-Identifier: MIT
// Degrees, angles and ellipses of known lights.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>

#include <malus/analysis/polarization_state.hpp>

#include "unit/optics_support.hpp"

namespace {

using namespace optics_test;
using Lab = malus::StaticFrame<struct LabTag>;
using Light = malus::Stokes<double, malus::exitant, Lab>;
constexpr Lab lab{};

template <class T>
T angle_of(T s1, T s2) {
  return malus::angle_of_linear_polarization(malus::Stokes<T, malus::exitant, Lab>(1, s1, s2, 0));
}

}  // namespace

TEST_CASE("degrees of polarisation of known lights") {
  const struct {
    Light light;
    double whole, linear, circular;
  } known[] = {
      {{1, 0, 0, 0, lab}, 0, 0, 0},           {{2, 2, 0, 0, lab}, 1, 1, 0},
      {{2, 0, -2, 0, lab}, 1, 1, 0},          {{1, 0, 0, 1, lab}, 1, 0, 1},
      {{1, 0, 0, -1, lab}, 1, 0, -1},         {{10, 3, 0, 4, lab}, 0.5, 0.3, 0.4},
      {{10, 3, 4, -12, lab}, 1.3, 0.5, -1.2},
  };
  for (const auto& k : known) {
    CHECK(malus::degree_of_polarization(k.light) == doctest::Approx(k.whole));
    CHECK(malus::degree_of_linear_polarization(k.light) == doctest::Approx(k.linear));
    CHECK(malus::degree_of_circular_polarization(k.light) == doctest::Approx(k.circular));
  }
}

TEST_CASE("degrees and angles are of each channel on its own") {
  const malus::Stokes<Double3, malus::exitant, Lab> light(Double3(1, 2, 4), Double3(1, 0, 0),
                                                          Double3(0, 1, 0), Double3(0, 0, -1));
  const auto degree = malus::degree_of_polarization(light);
  CHECK(degree == Double3(1, 0.5, 0.25));
  CHECK(malus::degree_of_linear_polarization(light) == Double3(1, 0.5, 0));
  CHECK(malus::degree_of_circular_polarization(light) == Double3(0, 0, -0.25));
  const auto angle = malus::angle_of_linear_polarization(light);
  CHECK(angle[0] == 0);
  CHECK(angle[1] == doctest::Approx(pi / 4));
  CHECK(angle[2] == 0);
  CHECK(malus::ellipticity(light)[2] == doctest::Approx(-pi / 4));
}

TEST_CASE("no light has no polarisation, and light without a frame has none either") {
  const Light none(0, 0, 0, 0);
  CHECK(malus::degree_of_polarization(none) == 0);
  CHECK(malus::degree_of_linear_polarization(none) == 0);
  CHECK(malus::degree_of_circular_polarization(none) == 0);
  CHECK(malus::angle_of_linear_polarization(none) == 0);
  CHECK(malus::ellipticity(none) == 0);
  const malus::Stokes<double> zero;
  CHECK(malus::degree_of_polarization(zero) == 0);
  const auto plain = malus::Stokes<double>::unpolarized(3);
  CHECK(malus::degree_of_polarization(plain) == 0);
  CHECK(malus::angle_of_linear_polarization(plain) == 0);
}

TEST_CASE("the angle of polarisation counts counter-clockwise from x") {
  for (int degrees = 0; degrees < 180; ++degrees) {
    const double angle = radians(degrees);
    CHECK(angle_of(std::cos(2 * angle), std::sin(2 * angle)) ==
          doctest::Approx(angle).epsilon(1e-12));
  }
  CHECK(angle_of(0.0, 1.0) == doctest::Approx(pi / 4));
  CHECK(angle_of(0.0, -1.0) == doctest::Approx(3 * pi / 4));
}

TEST_CASE("the angle of polarisation is in [0, π) whichever the sign of a zero or of a rounding") {
  const auto check = []<class T>(T) {
    for (const T s1 : {T(1), T(-1), T(0), T(-0.0)})
      for (const T s2 : {T(0), T(-0.0), std::numeric_limits<T>::denorm_min(),
                         -std::numeric_limits<T>::denorm_min(), -std::numeric_limits<T>::epsilon(),
                         -std::numeric_limits<T>::epsilon() / 16}) {
        const T angle = angle_of(s1, s2);
        CHECK(angle >= 0);
        CHECK(angle < std::numbers::pi_v<T>);
      }
  };
  check(float{});
  check(double{});
}

TEST_CASE("an ellipse's orientation, ellipticity and degree come back from its Stokes vector") {
  Random random(60);
  for (int i = 0; i < 300; ++i) {
    const double psi = random.between(0, pi), chi = random.between(-0.78, 0.78);
    const double degree = random.between(0.05, 1), intensity = random.between(0.1, 5);
    const auto light = malus::from_ellipse(intensity, degree, psi, chi, lab);
    CHECK(light[0] == doctest::Approx(intensity));
    CHECK(malus::degree_of_polarization(light) == doctest::Approx(degree));
    CHECK(malus::ellipticity(light) == doctest::Approx(chi));
    CHECK(malus::angle_of_linear_polarization(light) == doctest::Approx(psi));
  }
  const auto right = malus::from_ellipse(1.0, 1, 0.3, pi / 4, lab);
  CHECK(malus::degree_of_circular_polarization(right) == doctest::Approx(1));
}

TEST_CASE("the degree of polarisation does not depend on the frame, the angle turns against it") {
  Random random(61);
  for (int i = 0; i < 100; ++i) {
    const auto frame = random.frame();
    const double psi = random.between(1, 1.5), turn = random.between(0, 0.9);
    const auto light = malus::from_ellipse(1.0, 0.7, psi, 0.2, frame);
    const auto turned = light.expressed_in(frame.turned(turn));
    CHECK(malus::degree_of_polarization(turned) == doctest::Approx(0.7));
    CHECK(malus::ellipticity(turned) == doctest::Approx(0.2));
    CHECK(malus::angle_of_linear_polarization(turned) == doctest::Approx(psi - turn));
  }
}
