// SPDX-License-Identifier: MIT
// What media with an axis do to light: against Jones calculus and facts known by hand.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <limits>
#include <utility>

#include <malus/analysis/physicality.hpp>
#include <malus/analysis/polarization_state.hpp>
#include <malus/optics/extinction.hpp>
#include <malus/propagate.hpp>

#include "unit/jones.hpp"
#include "unit/optics_support.hpp"

// Every member, as renderers use it.
template struct malus::UniaxialExtinction<malus::Rgb>;

namespace {

using namespace optics_test;
using malus::exitant;
using malus::incident;
using malus::MuellerForm;
using Lab = malus::StaticFrame<struct LabTag>;
using Axes = malus::Frame<double>;
using Medium = malus::UniaxialExtinction<double>;
using Light = malus::Stokes<double, exitant>;
using Vec3 = glm::dvec3;

template <class A, class B>
concept Concatenates = requires(const A& a, const B& b) { concatenate(a, b); };

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int trials = 200;

template <class M>
jones::Rows components(const M& m) {
  jones::Rows rows;
  for (std::size_t i = 0; i < 16; ++i)
    rows[i / 4][i % 4] = static_cast<double>(m(static_cast<int>(i / 4), static_cast<int>(i % 4)));
  return rows;
}

/// M to the power of 2^times.
template <class M>
M doubled(M m, int times) {
  for (; times > 0; --times) m = m * m;
  return m;
}

Vec3 vector(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

Medium random_medium(Random& random) {
  Medium m{.axis = vector(random.direction()),
           .linear_dichroism = random.between(-1, 1),
           .circular_dichroism = random.between(-1, 1),
           .linear_birefringence = random.between(-4, 4),
           .optical_rotation = random.between(-4, 4)};
  m.extinction = m.least_absorption() + random.unit();
  return m;
}

/// The least and the most that is left of any polarisation.
template <class M>
std::pair<double, double> extreme_transmittances(const M& m) {
  const double d = std::hypot(m(0, 1), m(0, 2), m(0, 3));
  return {m(0, 0) - d, m(0, 0) + d};
}

}  // namespace

TEST_CASE("stretches concatenate in the light's order, through media of any axes") {
  using Transmittance = malus::Mueller<double, exitant, incident>;
  using Static = malus::Mueller<double, exitant, incident, Lab>;
  using Block = malus::BlockMueller<double, exitant, incident>;
  using Plain = malus::PlainMueller<double, exitant, incident>;
  using Clear = decltype(concatenate(std::declval<Plain>(), std::declval<Plain>()));
  static_assert(std::same_as<Clear, Plain>);
  static_assert(
      std::same_as<decltype(concatenate(std::declval<Block>(), std::declval<Plain>())), Block>);
  static_assert(Concatenates<Transmittance, Plain> && !Concatenates<Transmittance, Static>);
  static_assert(!Concatenates<Transmittance, malus::Mueller<double>>, "a scattering is no stretch");

  Random random(74);
  for (int i = 0; i < trials; ++i) {
    const Vec3 direction = vector(random.direction());
    const Medium here = random_medium(random), there = random_medium(random);
    const double a = random.between(0, 2), b = random.between(0, 2);
    const auto first = here.transmittance(direction, a), second = there.transmittance(direction, b);
    CHECK(difference(concatenate(first, here.transmittance(direction, b)),
                     here.transmittance(direction, a + b)) <= 1e-14);

    const auto d = random.direction();
    const Light light(1, 0.9 * d[0], 0.9 * d[1], 0.9 * d[2],
                      Axes::about(direction).turned(random.between(0, 6)));
    const auto between = propagate(light, first);
    const auto after =
        propagate(Light(between[0], between[1], between[2], between[3], between.frame()), second);
    const auto at_once = propagate(light, concatenate(first, second)).expressed_in(after.frame());
    CHECK(deviation_of_four(at_once, std::array{after[0], after[1], after[2], after[3]}) <= 1e-14);
  }
}

TEST_CASE("a medium is what Jones calculus makes of its two waves, its hand and its axis") {
  Random random(75);
  for (int i = 0; i < trials; ++i) {
    const Medium m = random_medium(random);
    const Vec3 direction = vector(random.direction());
    const double length = random.between(0, 2), cosine = glm::dot(direction, m.axis);
    const double sin2 = 1 - cosine * cosine;
    // Along the axis as it is seen, across it; right and left; and a turn of the field clockwise.
    const jones::Complex along(-0.5 * (m.extinction + m.linear_dichroism * sin2),
                               m.linear_birefringence * sin2);
    const jones::Matrix rate =
        along * jones::polarizer(0) +
        jones::Complex(-0.5 * m.extinction) * jones::polarizer(pi / 2) +
        jones::Complex(-0.25 * m.circular_dichroism) * jones::projector({0, 0, 1}) +
        jones::Complex(0.25 * m.circular_dichroism) * jones::projector({0, 0, -1}) +
        jones::Matrix{0, m.optical_rotation, -m.optical_rotation, 0};
    constexpr int power = 12;
    const jones::Matrix n = jones::Complex(std::ldexp(length, -power)) * rate, n2 = n * n;
    const jones::Matrix slice = jones::sigma(0) + n + jones::Complex(0.5) * n2 +
                                jones::Complex(1.0 / 6) * (n2 * n) +
                                jones::Complex(1.0 / 24) * (n2 * n2);
    const Vec3 x = glm::normalize(m.axis - cosine * direction);
    const Axes frame(x, glm::cross(direction, x));
    CHECK(deviation(m.transmittance(direction, length).expressed_in(frame, frame),
                    jones::mueller(doubled(slice, power))) <= 1e-11);
    CHECK(m.mean_extinction(direction) ==
          doctest::Approx(m.extinction + 0.5 * m.linear_dichroism * sin2));
  }
}

TEST_CASE("each effect has its sign: light goes to +z, the receiver sees x to the right and y up") {
  const Vec3 z(0, 0, 1);
  const Axes frame(Vec3(1, 0, 0), Vec3(0, 1, 0));
  const auto after = [&](const Medium& m, const Light& light) {
    return propagate(light, m.transmittance(z, 1)).expressed_in(frame);
  };
  const auto unpolarized = Light::unpolarized(1);
  const Vec3 up(0, 1, 0);
  // Molecules of dye that stand upright absorb upright fields: what is left is horizontal.
  const Medium dye{.axis = up, .extinction = 0.1, .linear_dichroism = 30};
  CHECK(after(dye, unpolarized)[1] == doctest::Approx(0.5 * std::exp(-0.1)));
  CHECK(after(dye, unpolarized)[0] == doctest::Approx(0.5 * std::exp(-0.1)));
  // Fields along the upright axis lag by a quarter of a wave behind horizontal ones: the fast axis
  // is at 0°, which makes left circular light of light at +45° (docs/conventions.md).
  const Medium quarter{.axis = up, .linear_birefringence = pi / 2};
  CHECK(after(quarter, Light(1, 0, 1, 0, frame))[3] == doctest::Approx(-1));
  // Right circular light is absorbed: left is left.
  const Medium handed{.extinction = 20, .circular_dichroism = 40};
  CHECK(after(handed, unpolarized)[0] == doctest::Approx(0.5));
  CHECK(after(handed, unpolarized)[3] == doctest::Approx(-0.5));
  // Sugar turns the plane clockwise: from x down to the right.
  const Medium sugar{.optical_rotation = pi / 4};
  CHECK(after(sugar, Light(1, 1, 0, 0, frame))[2] == doctest::Approx(-1));
}

TEST_CASE("Biot's law: the normal solution of sugar turns the plane by 34.6 degrees") {
  // ICUMSA: 26 g of sucrose in 100 ml, in a tube of 200 mm, sodium light: 34.626° to the right;
  // [α] is 66.59 at this concentration.
  const double specific = radians(66.59), grams_per_ml = 0.26, decimetres = 2;
  const Medium solution{.optical_rotation = specific * grams_per_ml};
  Random random(76);
  for (int i = 0; i < trials; ++i) {
    const Vec3 direction = vector(random.direction());
    const Axes frame = Axes::about(direction).turned(random.between(0, 6));
    const auto light =
        propagate(Light(1, 1, 0, 0, frame), solution.transmittance(direction, decimetres));
    const double angle = malus::angle_of_linear_polarization(light.expressed_in(frame));
    CHECK(180 - angle * 180 / pi == doctest::Approx(34.626).epsilon(1e-4));
  }
}

TEST_CASE("light that goes back the same way: reciprocity, and no rotation is left") {
  Random random(77);
  for (int i = 0; i < trials; ++i) {
    const Medium m = random_medium(random);
    const Vec3 w = vector(random.direction());
    const auto there = m.transmittance(w, 0.7);
    const Axes mirrored(there.enter().x(), -there.enter().y());
    const auto back = m.transmittance(-w, 0.7).expressed_in(mirrored, mirrored);
    // Jᵀ in the same axes of the field, seen with y reversed.
    const double sign[4] = {1, 1, -1, 1};
    for (int j = 0; j < 16; ++j)
      CHECK(std::abs(back(j / 4, j % 4) - sign[j / 4] * sign[j % 4] * there(j % 4, j / 4)) <=
            1e-14);

    // A mirror keeps linear fields as they are in space.
    const Medium active{.axis = m.axis, .extinction = 0.3, .optical_rotation = m.optical_rotation};
    const double angle = random.between(0, 6);
    const Axes frame = Axes::about(w), seen_back(frame.x(), -frame.y());
    const auto mirror =
        malus::Mueller<double>::block({1, 0, 0, 1}, {-1, 0, 0, -1}, frame, seen_back);
    const auto outward = propagate(Light(1, std::cos(2 * angle), std::sin(2 * angle), 0, frame),
                                   active.transmittance(w, 0.7));
    const auto returned =
        propagate(mirror * outward, active.transmittance(-w, 0.7)).expressed_in(seen_back);
    const double t = std::exp(-0.3 * 1.4);
    CHECK(deviation_of_four(returned, std::array{t, t * std::cos(2 * angle),
                                                 -t * std::sin(2 * angle), 0.0}) <= 1e-14);
  }
}

TEST_CASE("matter does not amplify, and each further stretch takes more") {
  Random random(78);
  for (int i = 0; i < trials; ++i) {
    const Medium m = random_medium(random);
    const Vec3 direction = vector(random.direction());
    const double length = random.between(0, 5), further = length + random.between(0, 3);
    const auto t = m.transmittance(direction, length);
    const auto [least, most] = extreme_transmittances(t);
    CHECK(malus::is_physical(t, 1e-12));
    CHECK(least >= -1e-15);
    CHECK(most <= 1 + 1e-15);
    CHECK(extreme_transmittances(m.transmittance(direction, further)).second <= most + 1e-15);
    CHECK(std::abs(t.m00() - m.unpolarized_transmittance(direction, length)) <= 1e-15);
    const auto rates = m.rates(direction);
    CHECK(rates.slowest >= -1e-15);
    CHECK(most >= std::exp(-rates.slowest * length) * (1 - 1e-12));
    CHECK(least <= std::exp(-rates.fastest * length) * (1 + 1e-12));
  }
}

TEST_CASE("the least absorption is what keeps every polarisation in every direction from gaining") {
  Random random(80);
  for (int i = 0; i < trials; ++i) {
    Medium m = random_medium(random);
    if (i % 4 == 0) m.circular_dichroism = 0;
    m.extinction = m.least_absorption();
    double slowest = infinity;
    for (int step = 0; step <= 100; ++step) {
      const double theta = step * pi / 100;
      const Vec3 x = Axes::about(m.axis).x();
      const auto k = m.differential(m.axis * std::cos(theta) + x * std::sin(theta));
      const auto& d = k.diattenuation;
      slowest = std::min(slowest, k.extinction - std::hypot(d[0], d[1], d[2]));
    }
    CHECK(std::abs(slowest) <= 1e-14);
    CHECK(m.is_passive(m.extinction));
    CHECK_FALSE(m.is_passive(m.extinction - 1e-6));
  }
}

TEST_CASE_TEMPLATE("near the axis nothing jumps", T, float, double) {
  using Vector = glm::vec<3, T>;
  Random random(81);
  for (int i = 0; i < trials; ++i) {
    const Vector axis = glm::normalize(Vector(vector(random.direction())));
    const Vector across = malus::Frame<T>::about(axis).turned(T(random.between(0, 6))).x();
    const malus::UniaxialExtinction<T> m{.axis = axis,
                                         .extinction = T(1),
                                         .linear_dichroism = T(1),
                                         .circular_dichroism = T(0.5),
                                         .linear_birefringence = T(2),
                                         .optical_rotation = T(3)};
    const auto seen = [&](const Vector& direction) {
      const auto frame = malus::Frame<T>::toward(direction, Vector(across.y, across.z, across.x));
      return m.transmittance(direction, T(1)).expressed_in(frame, frame);
    };
    for (const T sign : {T(1), T(-1)})
      for (const double theta : {0.0, 1e-9, 1e-7, 3e-7, 1e-6, 3e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
        const auto angle = static_cast<T>(theta);
        const auto near = seen(glm::normalize(axis * sign + across * angle));
        CHECK(all_finite(near));
        CHECK(difference(near, seen(axis * sign)) <=
              2 * theta * theta + 10 * double(std::numeric_limits<T>::epsilon()));
      }
  }
}

TEST_CASE("a medium is as cheap as its rays allow, each channel by itself") {
  using malus::Rgb;
  const Vec3 up(0, 1, 0), aslant = glm::normalize(Vec3(1, 1, 0));
  const malus::UniaxialExtinction<Double3> absorber{.extinction = {1, 2, 3}},
      foil{.axis = up, .extinction = {1, 2, 3}, .linear_dichroism = {0, 0, 4}},
      sugar{.extinction = {1, 2, 3}, .optical_rotation = {0.1, 0, 0.3}};
  CHECK_FALSE(absorber.polarizes());
  CHECK(absorber.transmittance(aslant, 2).form() == MuellerForm::plain);
  CHECK(foil.polarizes());
  CHECK(foil.transmittance(aslant, 2).form() == MuellerForm::block);
  CHECK(foil.transmittance(up, 2).form() == MuellerForm::plain);
  CHECK(sugar.polarizes());
  CHECK(sugar.transmittance(up, 2).form() == MuellerForm::full);
  for (std::size_t c = 0; c < 3; ++c) {
    const Medium alone{
        .axis = up, .extinction = foil.extinction[c], .linear_dichroism = foil.linear_dichroism[c]};
    CHECK(deviation(foil.transmittance(aslant, 2), components(alone.transmittance(aslant, 2)), c) <=
          1e-15);
    const Medium liquid{.extinction = sugar.extinction[c],
                        .optical_rotation = sugar.optical_rotation[c]};
    CHECK(deviation(sugar.transmittance(up, 2), components(liquid.transmittance(up, 2)), c) <=
          1e-15);
  }
  static_assert(std::same_as<decltype(malus::UniaxialExtinction<Rgb>{}.transmittance({}, 0)),
                             malus::Mueller<Rgb, exitant, incident>>);
}
