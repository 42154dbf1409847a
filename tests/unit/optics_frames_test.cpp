// SPDX-License-Identifier: MIT
// Frames of incidence: x = s is common to both sides and perpendicular to the plane of incidence.
#include <doctest/doctest.h>

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <malus/equality.hpp>
#include <malus/optics/fresnel.hpp>
#include <malus/propagate.hpp>

#include "unit/optics_support.hpp"

namespace {

using namespace optics_test;

template <class T>
glm::vec<3, T> any_direction(Random& random) {
  const auto d = random.direction();
  return {static_cast<T>(d[0]), static_cast<T>(d[1]), static_cast<T>(d[2])};
}

/// Light that meets the normal n at a small or large angle, and what is reflected of it.
template <class T>
struct Meeting {
  glm::vec<3, T> n, in, out;
  T cos_i;
};
template <class T>
Meeting<T> meeting(Random& random, T sin_i) {
  Meeting<T> m;
  m.n = any_direction<T>(random);
  const auto tangent = malus::Frame<T>::about(m.n).turned(static_cast<T>(6 * random.unit())).x();
  m.cos_i = std::sqrt((1 - sin_i) * (1 + sin_i));
  m.in = glm::normalize(sin_i * tangent - m.cos_i * m.n);
  m.out = glm::normalize(m.in - 2 * glm::dot(m.in, m.n) * m.n);
  return m;
}

}  // namespace

TEST_CASE("frames of incidence are right-handed about both directions, with a common s axis") {
  Random random(50);
  for (int i = 0; i < 200; ++i) {
    const auto m = meeting<double>(random, random.between(0.001, 1));
    const auto f = malus::frames_of_incidence<double>(m.n, m.in, m.out);
    CHECK(glm::length(f.enter.direction() - m.in) <= 1e-9);
    CHECK(glm::length(f.exit.direction() - m.out) <= 1e-9);
    CHECK(f.enter.x() == f.exit.x());
    CHECK(std::abs(glm::dot(f.enter.x(), m.n)) <= 1e-9);
    CHECK(glm::length(f.enter.x()) == doctest::Approx(1));
    CHECK(glm::length(f.enter.y()) == doctest::Approx(1));
  }
}

TEST_CASE("frames about a common axis take an axis of any length") {
  Random random(51);
  const auto m = meeting<double>(random, 0.6);
  const auto s = glm::cross(m.n, m.in);
  const auto unit = malus::frames_of_incidence<double>(m.n, m.in, m.out);
  const auto longer = malus::frames_with_common_axis<double>(m.in, m.out, 1e3 * s);
  const auto a = malus::conductor_reflection(m.cos_i, 0.2, 3.0, unit.enter, unit.exit);
  const auto b = malus::conductor_reflection(m.cos_i, 0.2, 3.0, longer.enter, longer.exit);
  CHECK(malus::is_close(a, b, 1e-12));
}

TEST_CASE("at normal incidence every s axis gives one and the same mirror") {
  Random random(52);
  for (int i = 0; i < 50; ++i) {
    const auto n = any_direction<double>(random);
    const auto f = malus::frames_of_incidence<double>(n, -n, n);
    CHECK(glm::length(f.enter.direction() + n) <= 1e-12);
    CHECK(glm::length(f.exit.direction() - n) <= 1e-12);
    const auto s = malus::Frame<double>::about(n).turned(6 * random.unit()).x();
    const auto g = malus::frames_with_common_axis<double>(-n, n, s);
    const auto a = malus::conductor_reflection(1.0, 0.2, 3.0, f.enter, f.exit);
    const auto b = malus::conductor_reflection(1.0, 0.2, 3.0, g.enter, g.exit);
    CHECK(malus::is_close(a, b, 1e-12));
  }
}

TEST_CASE("next to normal incidence frames keep to their directions and mirrors to their light") {
  const auto check = []<class T>(T, double direction_error, double matrix_error) {
    Random random(53);
    for (int exponent = 0; exponent < 20; ++exponent)
      for (int i = 0; i < 50; ++i) {
        const T sin_i = static_cast<T>(0.5 * std::pow(10, -0.5 * exponent));
        CAPTURE(sin_i);
        const auto m = meeting<T>(random, sin_i);
        const auto f = malus::frames_of_incidence<T>(m.n, m.in, m.out);
        CHECK(glm::length(f.enter.direction() - m.in) <= direction_error);
        CHECK(glm::length(f.exit.direction() - m.out) <= direction_error);
        // Against the same mirror by the frames of an exact double computation.
        const glm::dvec3 n(m.n), in(m.in), out(m.out);
        const auto s = malus::Frame<double>::toward(in, glm::cross(n, in)).x();
        const auto exact = malus::frames_with_common_axis<double>(in, out, s);
        const T eta = T(0.2), k = T(3);
        const auto mirror = malus::conductor_reflection(m.cos_i, eta, k, f.enter, f.exit);
        const auto sensor = malus::Frame<T>::about(m.out), source = malus::Frame<T>::about(m.in);
        const auto a = mirror.expressed_in(source, sensor);
        const auto b =
            malus::conductor_reflection(static_cast<double>(m.cos_i), 0.2, 3.0, exact.enter,
                                        exact.exit)
                .expressed_in(malus::Frame<double>::about(in), malus::Frame<double>::about(out));
        CHECK(difference(a, b) <= matrix_error);
      }
  };
  check(float{}, 2e-3, 1e-5);
  check(double{}, 1e-6, 1e-6);
}
