// SPDX-License-Identifier: MIT
// Decompositions of Mueller matrices against printed ones, and by the facts that define them.
#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include <malus/analysis/decomposition.hpp>
#include <malus/equality.hpp>
#include <malus/optics/depolarizer.hpp>
#include <malus/optics/diattenuator.hpp>
#include <malus/optics/fresnel.hpp>
#include <malus/optics/polarizer.hpp>
#include <malus/optics/retarder.hpp>
#include <malus/propagate.hpp>

#include "reference/decompositions.hpp"
#include "unit/jones.hpp"
#include "unit/optics_support.hpp"

namespace {

using namespace optics_test;
using Lab = malus::StaticFrame<struct LabTag>;
using Full = malus::FullMueller<double, malus::incident, malus::exitant, Lab>;
using Rows = std::array<std::array<double, 4>, 4>;

constexpr double printed = 1e-6;
constexpr double tolerance = 1e-11;

Full from_printed(const double (&m)[4][4]) {
  Rows rows;
  for (std::size_t r = 0; r < 4; ++r)
    for (std::size_t c = 0; c < 4; ++c) rows[r][c] = m[r][c];
  return Full::from_rows(rows);
}

template <class D>
auto chain(const D& d) {
  return d.depolarizer * malus::propagate(d.retarder * malus::propagate(d.diattenuator));
}

/// Which a depolarizer, a retarder and a diattenuator have to be.
template <class D>
void check_factors(const D& d, double within) {
  double worst = 0;
  for (int i = 1; i < 4; ++i) {
    worst = worse(worst, d.depolarizer(0, i));
    worst = worse(worst, d.retarder(0, i));
    worst = worse(worst, d.retarder(i, 0));
    for (int j = 0; j < 4; ++j) {
      if (j > 0) worst = worse(worst, d.depolarizer(i, j) - d.depolarizer(j, i));
      worst = worse(worst, d.diattenuator(i, j) - d.diattenuator(j, i));
    }
  }
  const auto r = [&](int i, int j) { return d.retarder(i, j); };
  double determinant = 0;
  for (int i = 0; i < 3; ++i) {
    const int j = 1 + (i + 1) % 3, k = 1 + (i + 2) % 3;
    determinant += r(1, i + 1) * (r(2, j) * r(3, k) - r(2, k) * r(3, j));
    for (int l = 0; l < 3; ++l) {
      double sum = 0;
      for (int row = 1; row < 4; ++row) sum += r(row, i + 1) * r(row, l + 1);
      worst = worse(worst, sum - (i == l ? 1 : 0));
    }
  }
  worst = worse(worst, determinant - 1);
  worst = worse(worst, malus::coherency_eigenvalues(d.diattenuator)[1]);
  CHECK(worst <= within);
}

/// A sum of a few pure matrices: physical, and as good as any.
Full random_physical(Random& random, int terms) {
  Rows rows{};
  for (int term = 0; term < terms; ++term) {
    const auto number = [&] {
      return jones::Complex{random.between(-1, 1), random.between(-1, 1)};
    };
    const auto pure = jones::mueller({number(), number(), number(), number()}, random.unit() + 0.1);
    for (std::size_t i = 0; i < 16; ++i) rows[i / 4][i % 4] += pure[i / 4][i % 4];
  }
  return Full::from_rows(rows);
}

}  // namespace

TEST_CASE("published polar decompositions: factors and numbers") {
  for (const auto& row : reference::polar_decompositions) {
    CAPTURE(row.source);
    const Full m = from_printed(row.m);
    const auto d = malus::polar_decomposition(m);
    CHECK(deviation(d.depolarizer, row.depolarizer) <= printed);
    CHECK(deviation(d.retarder, row.retarder) <= printed);
    CHECK(deviation(d.diattenuator, row.diattenuator) <= printed);
    CHECK(std::abs(malus::diattenuation(m) - row.diattenuation) <= printed);
    CHECK(std::abs(malus::retardance(d.retarder) - row.retardance) <= 1e-5);
    CHECK(std::abs(malus::depolarization_power(d.depolarizer) - row.depolarization_power) <=
          printed);
    if (row.polarizance > 0) CHECK(std::abs(malus::polarizance(m) - row.polarizance) <= printed);
    if (row.depolarization_index > 0)
      CHECK(std::abs(malus::depolarization_index(m) - row.depolarization_index) <= printed);
  }
}

TEST_CASE("published sum of four pure matrices") {
  const Full m = from_printed(reference::cloude.m);
  const auto parts = malus::cloude_decomposition(m);
  for (std::size_t k = 0; k < 4; ++k) {
    CAPTURE(k);
    CHECK(deviation(parts[k], reference::cloude.parts[k]) <= printed);
  }
}

TEST_CASE("the factors of a polar decomposition are what they are called, and multiply to M") {
  Random random(110);
  for (int i = 0; i < 500; ++i) {
    CAPTURE(i);
    const Full m = random_physical(random, 1 + i % 4);
    const auto d = malus::polar_decomposition(m);
    check_factors(d, 1e-9);
    CHECK(difference(chain(d), m) <= tolerance);
    CHECK(d.diattenuator(0, 0) == doctest::Approx(m(0, 0)));
  }
}

TEST_CASE("a pure matrix has a depolarizer that does nothing") {
  Random random(111);
  for (int i = 0; i < 100; ++i) {
    const auto n = random.direction(), fast = random.direction();
    const double degree = random.between(0, 0.95), phase = random.between(0.01, 3.1);
    const auto first =
        malus::elliptical_diattenuator(0.5, {degree * n[0], degree * n[1], degree * n[2]}, Lab{});
    const auto second = malus::elliptical_retarder(1.0, fast, phase, Lab{});
    const Full m = second * malus::propagate(first);
    const auto d = malus::polar_decomposition(m);
    CHECK(difference(d.diattenuator, first) <= tolerance);
    CHECK(difference(d.retarder, second) <= tolerance);
    CHECK(malus::diattenuation(m) == doctest::Approx(degree));
    CHECK(malus::polarizance(m) == doctest::Approx(degree));
    CHECK(malus::retardance(d.retarder) == doctest::Approx(phase));
    CHECK(malus::depolarization_index(m) == doctest::Approx(1));
    CHECK(std::abs(malus::depolarization_power(d.depolarizer)) <= 1e-10);
  }
}

TEST_CASE("retardance is accurate next to none and next to a half wave") {
  for (const double phase : {0.0, 1e-9, 1e-4, pi / 2, pi - 1e-9, pi}) {
    const auto retarder = malus::elliptical_retarder(1.0, {0.6, 0, 0.8}, phase, Lab{});
    CHECK(std::abs(malus::retardance(retarder) - phase) <= 1e-14);
  }
}

TEST_CASE("singular matrices: polarizers and depolarizers are decomposed as what they are") {
  const Rows identity{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
  // A polarizer is a diattenuator and nothing else.
  const auto polarizer = malus::linear_polarizer(0.8, Lab{}, 0.4);
  const auto p = malus::polar_decomposition(polarizer);
  CHECK(difference(p.diattenuator, polarizer) <= tolerance);
  CHECK(deviation(p.retarder, identity) <= tolerance);
  CHECK(deviation(p.depolarizer, identity) <= tolerance);

  // Through a polarizer and a retarder, half depolarised.
  const auto retarder = malus::elliptical_retarder(1.0, {0, 1, 0}, 3.0, Lab{});
  const auto half = malus::partial_depolarizer<double, Lab>(1, 0.5);
  const Full mixed = half * malus::propagate(retarder * malus::propagate(polarizer));
  const auto d = malus::polar_decomposition(mixed);
  check_factors(d, 1e-12);
  CHECK(difference(chain(d), mixed) <= tolerance);
  CHECK(malus::depolarization_power(d.depolarizer) == doctest::Approx(0.5));

  // From a polarizer to the opposite polarisation.
  const auto half_wave = malus::elliptical_retarder(1.0, {0, 0, 1}, pi, Lab{});
  const Full turned = half_wave * malus::propagate(malus::linear_polarizer(1.0, Lab{}, 0.4));
  const auto t = malus::polar_decomposition(turned);
  check_factors(t, 1e-12);
  CHECK(difference(chain(t), turned) <= tolerance);
  CHECK(malus::retardance(t.retarder) == doctest::Approx(pi));

  // An ideal depolarizer, and ones that leave one or two components.
  for (const auto& kept : std::array<std::array<double, 3>, 4>{
           {{0, 0, 0}, {0.5, 0, 0}, {0, -0.5, 0}, {0.3, 0, 0.6}}}) {
    const auto m = Full::from_rows({{{0.9, 0, 0, 0},
                                     {0, 0.9 * kept[0], 0, 0},
                                     {0, 0, 0.9 * kept[1], 0},
                                     {0, 0, 0, 0.9 * kept[2]}}});
    const auto one = malus::polar_decomposition(m);
    check_factors(one, 1e-12);
    CHECK(difference(chain(one), m) <= tolerance);
  }
  // One component is left and turned, S1 into S2: a retardance of a quarter turn, no more.
  const auto left = Full::from_rows({{{0.9, 0, 0, 0}, {}, {0, 0.45, 0, 0}, {}}});
  const auto l = malus::polar_decomposition(left);
  check_factors(l, 1e-12);
  CHECK(difference(chain(l), left) <= tolerance);
  CHECK(malus::retardance(l.retarder) == doctest::Approx(pi / 2));

  const auto nothing = malus::polar_decomposition(Full());
  CHECK(difference(chain(nothing), Full()) == 0);
}

TEST_CASE("a perfect mirror at normal incidence is half a wave, and depolarises nothing") {
  const auto mirror = malus::dielectric_reflection<double>(1.0, 1.5, Lab{}, Lab{});
  const auto d = malus::polar_decomposition(mirror);
  CHECK(malus::retardance(d.retarder) == doctest::Approx(pi));
  CHECK(malus::diattenuation(mirror) == doctest::Approx(0));
  CHECK(malus::depolarization_power(d.depolarizer) == doctest::Approx(0));
}

TEST_CASE("a mirror's factors are in its own frames, and multiply to it in space") {
  Random random(112);
  const auto enter = random.frame(), exit = random.frame();
  const Double3 eta(0.2, 0.5, 1.4), k(3, 2, 7);
  const auto mirror = malus::conductor_reflection(0.4, eta, k, enter, exit);
  const auto d = malus::polar_decomposition(mirror);
  CHECK(malus::is_close(chain(d), malus::Mueller<Double3>(mirror), 1e-12));
  CHECK(d.diattenuator.exit().x() == enter.x());
  CHECK(d.retarder.enter().x() == enter.x());
  CHECK(d.retarder.exit().x() == exit.x());
  CHECK(d.depolarizer.enter().x() == exit.x());
  const auto terms = malus::fresnel_conductor(0.4, 0.5, 2.0);
  const auto expected = std::abs(std::atan2(terms.im, terms.re));
  CHECK(malus::retardance(d.retarder)[1] == doctest::Approx(expected));
  CHECK(malus::diattenuation(mirror)[1] ==
        doctest::Approx((terms.s - terms.p) / (terms.s + terms.p)));
}

TEST_CASE("four pure matrices sum to M, with the coherency eigenvalues as their m00") {
  Random random(113);
  for (int i = 0; i < 200; ++i) {
    const Full m = random_physical(random, 1 + i % 5);
    const auto parts = malus::cloude_decomposition(m);
    CHECK(difference(parts[0] + parts[1] + parts[2] + parts[3], m) <= tolerance);
    const auto e = malus::coherency_eigenvalues(m);
    for (std::size_t k = 0; k < 4; ++k) {
      CHECK(std::abs(parts[k](0, 0) - e[k]) <= tolerance);
      CHECK(std::abs(malus::coherency_eigenvalues(parts[k])[1]) <= tolerance);
    }
  }
}

TEST_CASE("pure matrices of equal weight: an ideal depolarizer is four of a quarter each") {
  const auto m = Full::from_rows({{{1, 0, 0, 0}, {}, {}, {}}});
  const auto parts = malus::cloude_decomposition(m);
  for (const auto& part : parts) {
    CHECK(part(0, 0) == doctest::Approx(0.25));
    CHECK(malus::depolarization_index(part) == doctest::Approx(1));
  }
  CHECK(difference(parts[0] + parts[1] + parts[2] + parts[3], m) <= tolerance);
}

TEST_CASE("numbers of frameless forms: what keeps no light polarised and what keeps all") {
  const auto ideal = malus::depolarizer(Double3(0.5, 0.2, 0));
  CHECK(malus::diattenuation(ideal) == Double3(0.0));
  CHECK(malus::polarizance(ideal) == Double3(0.0));
  CHECK(malus::depolarization_index(ideal) == Double3(0.0));
  CHECK(malus::depolarization_index(malus::attenuator(0.3)) == doctest::Approx(1));
  CHECK(malus::depolarization_index(malus::partial_depolarizer(0.8, 0.4)) == doctest::Approx(0.5));
}

TEST_CASE("decompositions in float are those in double") {
  Random random(114);
  using Single = malus::FullMueller<float, malus::incident, malus::exitant, Lab>;
  for (int i = 0; i < 50; ++i) {
    // A depolarizer with clearly different axes after a retarder: the factors are well conditioned.
    const auto n = random.direction();
    const Full chained =
        Full::from_rows({{{1, 0, 0, 0}, {0.1, 0.9, 0, 0}, {0, 0, 0.6, 0}, {0, 0, 0, 0.3}}}) *
        malus::propagate(malus::elliptical_retarder(1.0, n, 2.0, Lab{}));
    const auto exact = malus::polar_decomposition(chained);
    const auto single = malus::polar_decomposition(Single::from_mat4(chained.to_mat4()));
    CHECK(difference(single.depolarizer, exact.depolarizer) <= 2e-6);
    CHECK(difference(single.retarder, exact.retarder) <= 1e-5);
    CHECK(difference(single.diattenuator, exact.diattenuator) <= 2e-6);
  }
}
