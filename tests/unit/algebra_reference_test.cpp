// SPDX-License-Identifier: MIT
// The algebra against published numbers: products in one frame, and what turning a frame does.
#include <doctest/doctest.h>

#include <numbers>

#include <malus/malus.hpp>

#include "reference/mueller_products.hpp"
#include "reference/stokes_mueller_algebra.hpp"

namespace {

using malus::exitant;
using malus::incident;

struct Table;
using Lab = malus::StaticFrame<Table>;
using Light = malus::Stokes<double, incident, Lab>;
using Element = malus::Mueller<double, incident, incident, Lab>;

constexpr double printed = 1e-7;

Light light(const double (&s)[4]) { return {s[0], s[1], s[2], s[3]}; }
malus::Analyzer<double, incident, Lab> row(const double (&w)[4]) {
  return {w[0], w[1], w[2], w[3]};
}
Element element(const double (&m)[4][4]) {
  Element::rows_type rows;
  for (std::size_t r = 0; r < 4; ++r)
    for (std::size_t c = 0; c < 4; ++c) rows[r][c] = m[r][c];
  return Element::from_rows(rows);
}

template <class Q>
void check_components(const Q& got, const double (&expected)[4]) {
  for (std::size_t i = 0; i < 4; ++i) {
    CAPTURE(i);
    CHECK(got[i] == doctest::Approx(expected[i]).epsilon(printed));
  }
}

}  // namespace

TEST_CASE("products of printed matrices and vectors are the printed ones") {
  const auto m1 = element(reference::product_m1), m2 = element(reference::product_m2);
  const auto s1 = light(reference::product_s1), s2 = light(reference::product_s2);

  check_components(m1 * s1, reference::m1_times_s1);
  check_components(row(reference::product_s1) * m1, reference::s1_transposed_times_m1);
  CHECK(row(reference::product_s1) * s2 == doctest::Approx(reference::s1_dot_s2).epsilon(1e-12));
  CHECK(inner_product(s1, s2) == doctest::Approx(reference::s1_dot_s2).epsilon(1e-12));

  const auto product = m1 * m2;
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c) {
      CAPTURE(r);
      CAPTURE(c);
      CHECK(product(r, c) == doctest::Approx(reference::m1_times_m2[r][c]).epsilon(printed));
    }
}

TEST_CASE("the adjoint turns a row's product with a matrix into the matrix's with light") {
  const auto m1 = element(reference::product_m1);
  check_components(adjoint(m1) * light(reference::product_s1), reference::s1_transposed_times_m1);
}

TEST_CASE("an analyser row reads p and s light as printed") {
  const auto analyzer = row(reference::analyzer_row);
  CHECK(analyzer * light({1, -1, 0, 0}) == doctest::Approx(reference::analyzer_on_p));
  CHECK(analyzer * light({1, 1, 0, 0}) == doctest::Approx(reference::analyzer_on_s));
}

TEST_CASE(
    "turning the frame by 45 degrees takes horizontal light to -45 degrees, as Mitsuba's rotator") {
  const malus::Frame<double> horizontal(glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0));
  const malus::Stokes<double> s(1, 1, 0, 0, horizontal);
  const auto turned = s.expressed_in(horizontal.turned(std::numbers::pi / 4));
  check_components(turned, reference::frame_turned_45_degrees);

  double s1 = 1, s2 = 0;
  rotate(malus::Rotation<double>::by(std::numbers::pi / 4), s1, s2);
  CHECK(s1 == doctest::Approx(reference::frame_turned_45_degrees[1]));
  CHECK(s2 == doctest::Approx(reference::frame_turned_45_degrees[2]));
}

TEST_CASE("a polarizer turned in its plane is Goldstein's rotated polarizer") {
  // D. Goldstein, Polarized Light: 1/2 [[1, c, s, 0], [c, c^2, sc, 0], [s, sc, s^2, 0], 0] with c =
  // cos 2a, s = sin 2a.
  const double a = 33 * std::numbers::pi / 180, c = std::cos(2 * a), s = std::sin(2 * a);
  const double expected[4][4] = {{1, c, s, 0}, {c, c * c, s * c, 0}, {s, s * c, s * s, 0}, {}};
  const malus::Frame<double> bench(glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0));
  const auto axis = bench.turned(a);
  const auto polarizer =
      malus::Mueller<double>::block({0.5, 0.5, 0.5, 0.5}, {0, 0, 0, 0}, axis, axis);
  const auto rotated = polarizer.expressed_in(bench, bench);
  for (int r = 0; r < 4; ++r)
    for (int col = 0; col < 4; ++col) {
      CAPTURE(r);
      CAPTURE(col);
      CHECK(rotated(r, col) == doctest::Approx(expected[r][col] / 2));
    }
}
