// SPDX-License-Identifier: MIT
// Optics against printed numbers: a wrong sign passes every test of self-consistency.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <complex>

#include <malus/analysis/polarization_state.hpp>
#include <malus/analyzer.hpp>
#include <malus/optics/diattenuator.hpp>
#include <malus/optics/fresnel.hpp>
#include <malus/optics/polarizer.hpp>
#include <malus/optics/retarder.hpp>
#include <malus/propagate.hpp>

#include "reference/fresnel_mirrors.hpp"
#include "reference/fresnel_special_cases.hpp"
#include "reference/stokes_mueller_algebra.hpp"
#include "unit/optics_support.hpp"

namespace {

using namespace optics_test;
using Lab = malus::StaticFrame<struct LabTag>;
using Light = malus::Stokes<double, malus::incident, Lab>;
using Complex = std::complex<double>;

constexpr double tolerance = 1e-10;

/// The same matrix with S3 counted the other way round.
std::array<std::array<double, 4>, 4> with_s3_negated(const double (&m)[4][4]) {
  std::array<std::array<double, 4>, 4> result;
  for (std::size_t r = 0; r < 4; ++r)
    for (std::size_t c = 0; c < 4; ++c) result[r][c] = ((r == 3) != (c == 3) ? -1 : 1) * m[r][c];
  return result;
}

void check_terms(const malus::FresnelTerms<double>& f, Complex rs, Complex rp, double within) {
  const Complex product = std::conj(rs) * rp;
  CHECK(std::abs(f.s - std::norm(rs)) <= within);
  CHECK(std::abs(f.p - std::norm(rp)) <= within);
  CHECK(std::abs(f.re - product.real()) <= within);
  CHECK(std::abs(f.im - product.imag()) <= within);
}

}  // namespace

TEST_CASE("published mirrors and glass: amplitudes and Mueller matrices at all angles") {
  for (const auto& mirror : reference::fresnel_mirrors)
    for (const auto& row : mirror.rows) {
      CAPTURE(mirror.material);
      CAPTURE(row.theta_degrees);
      const double cos_i = std::cos(radians(row.theta_degrees));
      const auto terms = malus::fresnel_conductor(cos_i, mirror.n, mirror.k);
      check_terms(terms, {row.rs_re, row.rs_im}, {row.rp_re, row.rp_im}, tolerance);
      CHECK(std::abs(terms.mean() - row.m00) <= tolerance);

      const double printed[4][4] = {{row.m00, row.m01, 0, 0},
                                    {row.m01, row.m00, 0, 0},
                                    {0, 0, row.m22, row.m23},
                                    {0, 0, -row.m23, row.m22}};
      const auto m = malus::conductor_reflection(cos_i, mirror.n, mirror.k, Lab{}, Lab{});
      CHECK(deviation(m, with_s3_negated(printed)) <= tolerance);
      if (mirror.k == 0) {
        const auto glass = malus::dielectric_reflection<double>(cos_i, mirror.n, Lab{}, Lab{});
        CHECK(deviation(glass, printed) <= tolerance);
      }
    }
}

TEST_CASE("published mirrors, one a channel: channels are not mixed") {
  const auto &gold = reference::fresnel_mirrors[0], &aluminium = reference::fresnel_mirrors[1];
  for (std::size_t i = 0; i < 10; ++i) {
    const double cos_i = std::cos(radians(gold.rows[i].theta_degrees));
    const auto m = malus::conductor_reflection(cos_i, Double3(gold.n, aluminium.n, gold.n),
                                               Double3(gold.k, aluminium.k, gold.k), Lab{}, Lab{});
    for (std::size_t c = 0; c < 3; ++c) {
      const auto& row = (c == 1 ? aluminium : gold).rows[i];
      CHECK(std::abs(m(0, 0)[c] - row.m00) <= tolerance);
      CHECK(std::abs(m(0, 1)[c] - row.m01) <= tolerance);
      CHECK(std::abs(m(2, 2)[c] - row.m22) <= tolerance);
      CHECK(std::abs(m(2, 3)[c] + row.m23) <= tolerance);
    }
  }
}

TEST_CASE("published amplitudes of glass from outside, from inside and at Brewster's angle") {
  for (const auto& row : reference::dielectric_amplitudes) {
    CAPTURE(row.source);
    const double cos_i = std::cos(radians(row.theta_degrees)), eta = row.n2 / row.n1;
    check_terms(malus::fresnel_dielectric(cos_i, eta), row.rs, row.rp, tolerance);
    CHECK(std::abs(malus::refracted_cosine(cos_i, eta) -
                   std::cos(radians(row.refracted_degrees))) <= tolerance);
  }
}

TEST_CASE("published matrices of glass at Brewster's angle and at normal incidence") {
  const double brewster = std::cos(std::atan(1.5));
  const auto reflected = malus::dielectric_reflection<double>(brewster, 1.5, Lab{}, Lab{});
  const double r = reference::brewster_reflection;
  const double expected[4][4] = {{r, r, 0, 0}, {r, r, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}};
  CHECK(deviation(reflected, expected) <= tolerance);

  const double inside = std::cos(radians(reference::brewster_transmission_degrees));
  const auto leaving = malus::dielectric_transmission<double>(inside, 1 / 1.5, Lab{}, Lab{});
  CHECK(deviation(leaving, reference::brewster_transmission) <= 2e-7);

  const auto back = malus::dielectric_reflection<double>(1.0, 1.5, Lab{}, Lab{});
  const auto on = malus::dielectric_transmission<double>(1.0, 1.5, Lab{}, Lab{});
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) {
      const bool diagonal = row == column;
      CHECK(std::abs(back(row, column) - (diagonal ? reference::normal_reflection[row] : 0)) <=
            tolerance);
      CHECK(std::abs(on(row, column) - (diagonal ? reference::normal_transmission[row] : 0)) <=
            tolerance);
    }
}

TEST_CASE("published phases of total internal reflection") {
  for (const auto& row : reference::total_reflection_phases) {
    CAPTURE(row.source);
    const auto f = malus::fresnel_dielectric(std::cos(radians(row.theta_degrees)), 1 / row.n);
    // With exp(-iwt), p is behind s: arg r_p - arg r_s is negative.
    const double phase = std::atan2(f.im, f.re) * 180 / pi;
    CHECK(std::abs(phase + row.phase_degrees) <= row.tolerance_degrees);
    CHECK(f.s == doctest::Approx(1).epsilon(1e-14));
    CHECK(f.p == doctest::Approx(1).epsilon(1e-14));
  }
}

TEST_CASE("published silicon mirror at 60 degrees") {
  constexpr auto &rs = reference::silicon_rs, &rp = reference::silicon_rp;
  // The index that has these amplitudes: r_s = (cos - q)/(cos + q), n² = q² + sin².
  const double cos_i = 0.5;
  const Complex s(rs[0], rs[1]), q = cos_i * (1.0 - s) / (1.0 + s);
  const Complex n = std::sqrt(q * q + 0.75);
  const auto terms = malus::fresnel_conductor(cos_i, n.real(), n.imag());
  check_terms(terms, s, {rp[0], rp[1]}, 1e-9);
  CHECK(std::abs(terms.s - reference::silicon_power[0]) <= 1e-9);
  CHECK(std::abs(terms.p - reference::silicon_power[1]) <= 1e-9);
  const auto m = malus::conductor_reflection(cos_i, n.real(), n.imag(), Lab{}, Lab{});
  CHECK(deviation(m, with_s3_negated(reference::silicon)) <= 1e-8);
}

TEST_CASE("published Stokes vectors of ellipses") {
  for (const auto& e : reference::ellipses) {
    const double orientation = radians(e.orientation_degrees), chi = radians(e.ellipticity_degrees);
    const auto light = malus::from_ellipse(e.intensity, e.degree, orientation, chi, Lab{});
    CHECK(deviation_of_four(light, e.stokes) <= tolerance);
    CHECK(malus::angle_of_linear_polarization(light) == doctest::Approx(orientation));
    CHECK(malus::ellipticity(light) == doctest::Approx(chi));
    CHECK(malus::degree_of_polarization(light) == doctest::Approx(e.degree));
  }
}

TEST_CASE("published retarders: quarter and half waves at 0, 45, 90 and -45 degrees") {
  Random random(1);
  for (const auto& row : reference::retarders) {
    const double phase = radians(row.phase_degrees), axis = radians(row.axis_degrees);
    CAPTURE(row.phase_degrees);
    CAPTURE(row.axis_degrees);
    const auto frame = random.frame();
    const auto turned = malus::linear_retarder(1.0, phase, frame, axis);
    CHECK(deviation(turned.expressed_in(frame, frame), row.m) <= tolerance);
    const auto general =
        malus::elliptical_retarder(1.0, {std::cos(2 * axis), std::sin(2 * axis), 0}, phase, Lab{});
    CHECK(deviation(general, row.m) <= tolerance);
    if (row.axis_degrees == 0)
      CHECK(deviation(malus::linear_retarder(1.0, phase, Lab{}), row.m) <= tolerance);
  }
}

TEST_CASE("published polarizer at 33 degrees, and Malus's law at 30") {
  const double c = std::cos(radians(66)), s = std::sin(radians(66));
  const double expected[4][4] = {{0.5, c / 2, s / 2, 0},
                                 {c / 2, c * c / 2, s * c / 2, 0},
                                 {s / 2, s * c / 2, s * s / 2, 0},
                                 {}};
  CHECK(deviation(malus::linear_polarizer(1.0, Lab{}, radians(33)), expected) <= tolerance);
  Random random(2);
  const auto frame = random.frame();
  const auto turned = malus::linear_polarizer(1.0, frame, radians(33));
  CHECK(deviation(turned.expressed_in(frame, frame), expected) <= tolerance);

  const auto passed = malus::linear_polarizer(1.0, Lab{}, radians(30)) * Light(1, 1, 0, 0);
  CHECK(std::abs(passed[0] - reference::malus_30_degrees) <= tolerance);
}

TEST_CASE("published rotation of the frame, and the analysing row") {
  Random random(3);
  const malus::Stokes<double> light(1, 1, 0, 0, random.frame());
  const auto seen = light.expressed_in(light.frame().turned(radians(45)));
  CHECK(deviation_of_four(seen, reference::frame_turned_45_degrees) <= tolerance);

  constexpr auto& w = reference::analyzer_row;
  const malus::Analyzer<double, malus::incident, Lab> analyzer(w[0], w[1], w[2], w[3]);
  CHECK(std::abs(analyzer * Light(1, -1, 0, 0) - reference::analyzer_on_p) <= tolerance);
  CHECK(std::abs(analyzer * Light(1, 1, 0, 0) - reference::analyzer_on_s) <= tolerance);
  // The same filter as an element: a polarizer that passes p and leaks a fifth of s.
  const auto row = malus::Analyzer<double, malus::exitant, Lab>::intensity(1) *
                   malus::linear_diattenuator(0.2, 1.0, Lab{});
  CHECK(deviation_of_four(row, w) <= tolerance);
}
