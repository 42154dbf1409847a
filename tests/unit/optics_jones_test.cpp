// SPDX-License-Identifier: MIT
// Every optic against an independent Jones calculus (unit/jones.hpp).
#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include <malus/optics/depolarizer.hpp>
#include <malus/optics/diattenuator.hpp>
#include <malus/optics/fresnel.hpp>
#include <malus/optics/polarizer.hpp>
#include <malus/optics/retarder.hpp>
#include <malus/optics/rotator.hpp>
#include <malus/product.hpp>
#include <malus/propagate.hpp>

#include "unit/jones.hpp"
#include "unit/optics_support.hpp"

namespace {

using namespace optics_test;
using Lab = malus::StaticFrame<struct LabTag>;
using Light = malus::Stokes<double, malus::incident, Lab>;
using Matrix = malus::Mueller<double, malus::incident, malus::exitant>;

constexpr double tolerance = 1e-12;
constexpr int trials = 200;

/// Where the receiver sees the field of exp(-iwt) turn: positive counter-clockwise.
double sense_of_rotation(const jones::Field& e) {
  double sum = 0;
  for (int i = 0; i < 16; ++i) {
    const auto at = [&](double wt) {
      const auto phase = std::polar(1.0, -wt);
      return std::array<double, 2>{(e.x * phase).real(), (e.y * phase).real()};
    };
    const auto now = at(i * pi / 8), later = at((i + 1) * pi / 8);
    sum += now[0] * later[1] - now[1] * later[0];
  }
  return sum;
}

template <class M>
double deviation_in(const malus::Frame<double>& frame, const M& m, const jones::Rows& rows) {
  return deviation(m.expressed_in(frame, frame), rows);
}

}  // namespace

TEST_CASE("right circular light, S3 > 0, turns clockwise for the receiver") {
  Random random(10);
  for (int i = 0; i < trials; ++i) {
    const jones::Field e{std::polar(random.unit(), random.between(0, 2 * pi)),
                         std::polar(random.unit(), random.between(0, 2 * pi))};
    const double s3 = jones::stokes(e)[3];
    if (std::abs(s3) > 1e-3) CHECK((sense_of_rotation(e) < 0) == (s3 > 0));
  }
}

TEST_CASE("the Mueller matrix of a Jones matrix acts on Stokes vectors as that acts on fields") {
  Random random(11);
  for (int i = 0; i < trials; ++i) {
    const auto number = [&] {
      return jones::Complex{random.between(-1, 1), random.between(-1, 1)};
    };
    const jones::Matrix j{number(), number(), number(), number()};
    const jones::Field e{number(), number()};
    const auto m = jones::mueller(j);
    const auto s = jones::stokes(e), expected = jones::stokes(j * e);
    for (std::size_t r = 0; r < 4; ++r) {
      const double sum = m[r][0] * s[0] + m[r][1] * s[1] + m[r][2] * s[2] + m[r][3] * s[3];
      CHECK(std::abs(sum - expected[r]) <= 1e-13);
    }
  }
}

TEST_CASE("turning the frame is R(phi) of the field's components") {
  Random random(12);
  for (int i = 0; i < trials; ++i) {
    const double phi = random.between(-4, 4);
    const auto m = jones::mueller(jones::turned_frame(phi));
    const auto frame = random.frame();
    const malus::Stokes<double> light(1, 0.3, -0.5, 0.7, frame);
    const auto turned = light.expressed_in(frame.turned(phi));
    std::array<double, 4> expected;
    for (std::size_t r = 0; r < 4; ++r)
      expected[r] = m[r][0] + 0.3 * m[r][1] - 0.5 * m[r][2] + 0.7 * m[r][3];
    CHECK(deviation_of_four(turned, expected) <= tolerance);
  }
}

TEST_CASE("linear polarizer at any angle, in run-time and in static frames") {
  Random random(13);
  for (int i = 0; i < trials; ++i) {
    const double theta = random.between(-4, 4), t = random.unit();
    const auto expected = jones::mueller(jones::polarizer(theta), t);
    const auto frame = random.frame();
    CHECK(deviation_in(frame, malus::linear_polarizer(t, frame, theta), expected) <= tolerance);
    CHECK(deviation(malus::linear_polarizer(t, Lab{}, theta), expected) <= tolerance);
  }
  CHECK(deviation(malus::linear_polarizer(1.0, Lab{}), jones::mueller(jones::polarizer(0))) <=
        tolerance);
}

TEST_CASE("linear retarder of any phase and fast axis, a phase a channel") {
  Random random(14);
  for (int i = 0; i < trials; ++i) {
    const double theta = random.between(-4, 4);
    const Double3 phase = random.between3(-7, 7), t = random.between3(0, 1);
    const auto frame = random.frame();
    const auto m = malus::linear_retarder(t, phase, frame, theta).expressed_in(frame, frame);
    const auto along_x = malus::linear_retarder(t, phase, Lab{});
    for (std::size_t c = 0; c < 3; ++c) {
      CHECK(deviation(m, jones::mueller(jones::retarder(theta, phase[c]), t[c]), c) <= tolerance);
      CHECK(deviation(along_x, jones::mueller(jones::retarder(0, phase[c]), t[c]), c) <= tolerance);
    }
  }
}

TEST_CASE("elliptical retarder: the opposite of the fast polarisation comes later by the phase") {
  Random random(15);
  for (int i = 0; i < trials; ++i) {
    const auto fast = random.direction();
    const Double3 phase = random.between3(-7, 7), t = random.between3(0, 1);
    const auto m = malus::elliptical_retarder(t, fast, phase, Lab{});
    for (std::size_t c = 0; c < 3; ++c) {
      const auto j = jones::projector(fast) +
                     std::polar(1.0, phase[c]) * jones::projector(jones::opposite(fast));
      CHECK(deviation(m, jones::mueller(j, t[c]), c) <= tolerance);
    }
  }
}

TEST_CASE("a retarder with right circular as its fast light turns the plane by -phase/2") {
  for (const double phase : {-2.0, 0.3, 1.0, 3.0}) {
    const auto retarder = malus::elliptical_retarder(1.0, {0, 0, 1}, phase, Lab{});
    CHECK(difference(retarder, malus::rotator(1.0, -phase / 2, Lab{})) <= tolerance);
  }
}

TEST_CASE("rotator by any angle, an angle a channel") {
  Random random(16);
  for (int i = 0; i < trials; ++i) {
    const Double3 angle = random.between3(-4, 4), t = random.between3(0, 1);
    const auto m = malus::rotator(t, angle, Lab{});
    for (std::size_t c = 0; c < 3; ++c)
      CHECK(deviation(m, jones::mueller(jones::rotator(angle[c]), t[c]), c) <= tolerance);
  }
}

TEST_CASE("linear diattenuator at any axis, transmittances a channel") {
  Random random(17);
  for (int i = 0; i < trials; ++i) {
    const double theta = random.between(-4, 4);
    const Double3 x = random.between3(0, 1), y = random.between3(0, 1);
    const auto frame = random.frame();
    const auto m = malus::linear_diattenuator(x, y, frame, theta).expressed_in(frame, frame);
    const auto along_x = malus::linear_diattenuator(x, y, Lab{});
    for (std::size_t c = 0; c < 3; ++c) {
      const auto j = [&](double axis) {
        return jones::Complex(std::sqrt(x[c])) * jones::polarizer(axis) +
               jones::Complex(std::sqrt(y[c])) * jones::polarizer(axis + pi / 2);
      };
      CHECK(deviation(m, jones::mueller(j(theta)), c) <= tolerance);
      CHECK(deviation(along_x, jones::mueller(j(0)), c) <= tolerance);
    }
  }
}

TEST_CASE("elliptical diattenuator of any diattenuation, from none to a polarizer") {
  Random random(18);
  for (int i = 0; i < trials; ++i) {
    const auto n = random.direction();
    const double d = i == 0 ? 0.0 : i == 1 ? 1.0 : random.unit();
    const Double3 t = random.between3(0, 1);
    const auto m = malus::elliptical_diattenuator(t, {d * n[0], d * n[1], d * n[2]}, Lab{});
    const auto j = jones::Complex(std::sqrt(1 + d)) * jones::projector(n) +
                   jones::Complex(std::sqrt(1 - d)) * jones::projector(jones::opposite(n));
    // Next to D = 1, √(1 − |D|²) takes the rounding of |D|² to its root.
    const double within = d > 0.999 ? 1e-7 : tolerance;
    for (std::size_t c = 0; c < 3; ++c) CHECK(deviation(m, jones::mueller(j, t[c]), c) <= within);
  }
}

TEST_CASE("circular polarizers are the projections on right and left circular fields") {
  const jones::Complex i(0, 1);
  // (x, y) = (1, -i)/√2 turns clockwise, (1, i)/√2 counter-clockwise.
  CHECK(sense_of_rotation({1, -i}) < 0);
  const jones::Matrix right{0.5, 0.5 * i, -0.5 * i, 0.5}, left{0.5, -0.5 * i, 0.5 * i, 0.5};
  const auto passed = right * jones::Field{1, -i}, blocked = right * jones::Field{1, i};
  CHECK(std::abs(passed.x - 1.0) + std::abs(passed.y + i) + std::abs(blocked.x) <= tolerance);
  const auto r = malus::circular_polarizer(0.7, malus::Handedness::right, Lab{});
  const auto l = malus::circular_polarizer(0.7, malus::Handedness::left, Lab{});
  CHECK(deviation(r, jones::mueller(right, 0.7)) <= tolerance);
  CHECK(deviation(l, jones::mueller(left, 0.7)) <= tolerance);
}

TEST_CASE("reflection at dielectrics of either side by Maxwell's boundary conditions") {
  Random random(19);
  for (int i = 0; i < 2000; ++i) {
    const double cos_i = i == 0 ? 1.0 : i == 1 ? 0.0 : random.unit();
    const double eta = random.unit() < 0.5 ? random.between(0.3, 1) : random.between(1, 3);
    CAPTURE(cos_i);
    CAPTURE(eta);
    const auto m = malus::dielectric_reflection<double>(cos_i, eta, Lab{}, Lab{});
    CHECK(deviation(m, jones::reflection(cos_i, eta)) <= 1e-11);
  }
}

TEST_CASE("total internal reflection by Maxwell's boundary conditions") {
  Random random(20);
  for (int i = 0; i < trials; ++i) {
    const double eta = random.between(0.3, 0.95);
    const double cos_i = random.between(0, 0.999) * std::sqrt(1 - eta * eta);
    const auto m = malus::dielectric_reflection<double>(cos_i, eta, Lab{}, Lab{});
    CHECK(deviation(m, jones::reflection(cos_i, eta)) <= 1e-11);
    CHECK(m(2, 3) < 0);
  }
}

TEST_CASE("reflection at conductors by Maxwell's boundary conditions") {
  Random random(21);
  for (int i = 0; i < 2000; ++i) {
    const double cos_i = i == 0 ? 1.0 : i == 1 ? 0.0 : random.unit();
    const Double3 eta = random.between3(0.05, 4), k = random.between3(0, 8);
    const auto m = malus::conductor_reflection(cos_i, eta, k, Lab{}, Lab{});
    for (std::size_t c = 0; c < 3; ++c)
      CHECK(deviation(m, jones::reflection(cos_i, {eta[c], k[c]}), c) <= 1e-11);
  }
}

TEST_CASE("refraction from either side by Maxwell's boundary conditions") {
  Random random(22);
  int refracted = 0;
  for (int i = 0; i < 2000; ++i) {
    const double cos_i = i == 0 ? 1.0 : random.between(1e-9, 1);
    const double eta = random.unit() < 0.5 ? random.between(0.3, 1) : random.between(1, 3);
    CAPTURE(cos_i);
    CAPTURE(eta);
    const auto m = malus::dielectric_transmission<double>(cos_i, eta, Lab{}, Lab{});
    CHECK(deviation(m, jones::transmission(cos_i, eta)) <= 1e-11);
    refracted += m(0, 0) > 0;
  }
  CHECK(refracted > 1000);
}

TEST_CASE("interfaces next to none, eta = 1 ± 1e-7") {
  for (const double eta : {1 - 1e-7, 1 + 1e-7})
    for (const double cos_i : {1.0, 0.5, 0.1, 0.01, 0.001}) {
      CAPTURE(cos_i);
      const auto r = malus::dielectric_reflection<double>(cos_i, eta, Lab{}, Lab{});
      const auto t = malus::dielectric_transmission<double>(cos_i, eta, Lab{}, Lab{});
      CHECK(deviation(r, jones::reflection(cos_i, eta)) <= 1e-11);
      CHECK(deviation(t, jones::transmission(cos_i, eta)) <= 1e-10);
    }
}

TEST_CASE("chains: the product of matrices is that of fields, the last element on the left") {
  Random random(23);
  for (int i = 0; i < trials; ++i) {
    const auto frame = random.frame();
    Matrix chain = malus::attenuator(1.0);
    jones::Matrix field{1, 0, 0, 1};
    const malus::Stokes<double> start(1, 0.6, 0, 0.8, frame);
    malus::Stokes<double> light = start;
    for (int element = 0; element < 5; ++element) {
      const double theta = random.between(-4, 4), phase = random.between(0.2, 3);
      const auto n = random.direction();
      Matrix m;
      jones::Matrix j;
      switch (random.below(5)) {
        case 0:
          m = malus::linear_retarder(1.0, phase, frame, theta);
          j = jones::retarder(theta, phase);
          break;
        case 1:
          m = malus::linear_diattenuator(0.9, 0.3, frame, theta);
          j = jones::Complex(std::sqrt(0.9)) * jones::polarizer(theta) +
              jones::Complex(std::sqrt(0.3)) * jones::polarizer(theta + pi / 2);
          break;
        case 2:
          m = malus::rotator(1.0, theta, frame.turned(phase));
          j = jones::rotator(theta);
          break;
        case 3:
          m = malus::elliptical_retarder(1.0, n, phase, frame);
          j = jones::projector(n) + std::polar(1.0, phase) * jones::projector(jones::opposite(n));
          break;
        default:
          m = malus::circular_polarizer(1.0, malus::Handedness::right, frame);
          j = jones::projector({0, 0, 1});
      }
      chain = m * malus::propagate(chain);
      light = m * malus::propagate(light);
      field = j * field;
    }
    const auto expected = jones::mueller(field);
    CHECK(deviation_in(frame, chain, expected) <= 1e-12);
    std::array<double, 4> end;
    for (std::size_t r = 0; r < 4; ++r)
      end[r] = expected[r][0] + 0.6 * expected[r][1] + 0.8 * expected[r][3];
    CHECK(deviation_of_four(light.expressed_in(frame), end) <= 1e-12);
  }
}

TEST_CASE("two mirrors out of one plane: Fresnel blocks, frames and product order together") {
  Random random(24);
  for (int i = 0; i < trials; ++i) {
    const auto vec = [](const std::array<double, 3>& a) { return glm::dvec3(a[0], a[1], a[2]); };
    glm::dvec3 direction = vec(random.direction());
    const auto first = malus::Frame<double>::about(direction);
    malus::Frame<double> frame = first;
    Matrix chain = malus::attenuator(1.0);
    jones::Matrix field{1, 0, 0, 1};
    for (int mirror = 0; mirror < 2; ++mirror) {
      glm::dvec3 n = vec(random.direction());
      if (glm::dot(n, direction) > 0) n = -n;
      const double cos_i = -glm::dot(n, direction);
      const glm::dvec3 out = direction + 2 * cos_i * n;
      const double eta = random.between(0.2, 2), k = random.between(1, 6);
      const auto frames = malus::frames_of_incidence<double>(n, direction, out);
      const Matrix m = malus::conductor_reflection(cos_i, eta, k, frames.enter, frames.exit);
      chain = m * malus::propagate(chain);
      // The angle from the present x axis to s, counter-clockwise about the direction.
      const auto& s = frames.enter.x();
      const double phi = std::atan2(glm::dot(s, frame.y()), glm::dot(s, frame.x()));
      const auto a = jones::interface(cos_i, {eta, k});
      field = jones::Matrix{a.rs, 0, 0, a.rp} * jones::turned_frame(phi) * field;
      frame = frames.exit;
      direction = out;
    }
    CHECK(deviation(chain.expressed_in(first, frame), jones::mueller(field)) <= 1e-12);
  }
}

TEST_CASE("Fresnel's rhomb makes circular light of linear light at 45 degrees") {
  const double n = 1.51, cos_i = std::cos(radians(54.62310544118644));
  // By fields: p lags behind s by 45 degrees a bounce, and s + p becomes (1, -i), which turns
  // clockwise.
  const auto a = jones::interface(cos_i, 1 / n);
  const jones::Matrix bounce{a.rs, 0, 0, a.rp};
  const auto field = bounce * bounce * jones::Field{std::sqrt(0.5), std::sqrt(0.5)};
  const auto expected = jones::stokes(field);
  CHECK(sense_of_rotation(field) < 0);
  CHECK(expected[3] == doctest::Approx(1));

  const auto m = malus::dielectric_reflection<double>(cos_i, 1 / n, Lab{}, Lab{});
  const auto light = m * malus::propagate(m * Light(1, 0, 1, 0));
  CHECK(deviation_of_four(light, expected) <= 1e-9);
  CHECK(deviation_of_four(light, std::array<double, 4>{1, 0, 0, 1}) <= 1e-9);
  // Across the other diagonal, or backwards, the other hand.
  CHECK((m * malus::propagate(m * Light(1, 0, -1, 0)))[3] == doctest::Approx(-1));
}

TEST_CASE("Fresnel's rhomb in space, by frames of incidence at its two parallel faces") {
  const double n = 1.51, theta = radians(54.62310544118644);
  const glm::dvec3 normal(0, 0, -1), in(std::sin(theta), 0, std::cos(theta));
  const glm::dvec3 between(std::sin(theta), 0, -std::cos(theta));
  const auto first = malus::frames_of_incidence<double>(normal, in, between);
  const auto second = malus::frames_of_incidence<double>(-normal, between, in);
  const auto bounce = [&](const malus::FramePair<double>& f) {
    return malus::dielectric_reflection<double>(std::cos(theta), 1 / n, f.enter, f.exit);
  };
  const glm::dvec3 s(0, 1, 0);
  const auto frame = malus::Frame<double>::from_direction_and_x(in, s);
  const malus::Stokes<double> light(1, 0, 1, 0, frame);
  const auto out = bounce(second) * malus::propagate(bounce(first) * malus::propagate(light));
  CHECK(deviation_of_four(out.expressed_in(frame), std::array<double, 4>{1, 0, 0, 1}) <= 1e-9);
}
