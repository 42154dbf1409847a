// SPDX-License-Identifier: MIT
// Which Stokes vectors and Mueller matrices can exist.
#include <doctest/doctest.h>

#include <array>
#include <limits>

#include <malus/analysis/physicality.hpp>
#include <malus/optics/depolarizer.hpp>
#include <malus/optics/polarizer.hpp>
#include <malus/optics/retarder.hpp>
#include <malus/sum.hpp>

#include "unit/jones.hpp"
#include "unit/optics_support.hpp"

namespace {

using namespace optics_test;
using Lab = malus::StaticFrame<struct LabTag>;
using Light = malus::Stokes<double, malus::exitant, Lab>;
using Four = std::array<double, 4>;
using Full = malus::FullMueller<double, malus::incident, malus::exitant, Lab>;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

void check_eigenvalues(const Four& actual, const Four& expected) {
  CAPTURE(actual[0]);
  CAPTURE(actual[1]);
  CAPTURE(actual[2]);
  CAPTURE(actual[3]);
  CHECK(deviation_of_four(actual, expected) <= 1e-14);
}

}  // namespace

TEST_CASE("light exists where S0 is not below the polarised part") {
  CHECK(malus::is_physical(Light(1, 0, 0, 0), 0));
  CHECK(malus::is_physical(Light(1, 0.6, 0, -0.8), 1e-15));
  CHECK(malus::is_physical(Light(0, 0, 0, 0), 0));
  CHECK(malus::is_physical(malus::Stokes<double>(), 0));
  CHECK_FALSE(malus::is_physical(Light(1, 0.7, 0, -0.8), 1e-3));
  CHECK_FALSE(malus::is_physical(Light(-1, 0, 0, 0), 1e-3));
  CHECK_FALSE(malus::is_physical(Light(0, 0, 1e-30, 0), 1e-3));
  CHECK_FALSE(malus::is_physical(Light(not_a_number, 0, 0, 0), 1e-3));
  CHECK_FALSE(malus::is_physical(Light(1, 0, 0, not_a_number), 1e-3));
}

TEST_CASE("a tolerance widens what light is accepted by as much") {
  CHECK(malus::is_physical(Light(1, 1.009, 0, 0), 0.01));
  CHECK_FALSE(malus::is_physical(Light(1, 1.011, 0, 0), 0.01));
}

TEST_CASE("one unphysical channel is enough") {
  using Colored = malus::Stokes<Double3, malus::exitant, Lab>;
  const Double3 zero(0);
  CHECK(malus::is_physical(Colored(Double3(1, 2, 3), Double3(1, 2, 3), zero, zero), 1e-15));
  CHECK_FALSE(malus::is_physical(Colored(Double3(1, 2, 3), Double3(1, 2, 3.1), zero, zero), 1e-3));
  const auto bad = malus::partial_depolarizer<Double3, Lab>(Double3(1, 1, 1), Double3(1, 1, 1.1));
  CHECK_FALSE(malus::is_physical(bad, 1e-3));
}

TEST_CASE("coherency eigenvalues of known matrices") {
  check_eigenvalues(malus::coherency_eigenvalues(malus::depolarizer(1.0)),
                    {0.25, 0.25, 0.25, 0.25});
  check_eigenvalues(malus::coherency_eigenvalues(malus::attenuator(1.0)), {1, 0, 0, 0});
  check_eigenvalues(malus::coherency_eigenvalues(malus::linear_polarizer(1.0, Lab{})),
                    {0.5, 0, 0, 0});
  check_eigenvalues(malus::coherency_eigenvalues(malus::linear_retarder(1.0, 0.7, Lab{})),
                    {1, 0, 0, 0});
  // diag(a, b, b, b): (a + 3b)/4 and three times (a - b)/4.
  check_eigenvalues(malus::coherency_eigenvalues(malus::partial_depolarizer(1.0, 0.6)),
                    {0.7, 0.1, 0.1, 0.1});
  check_eigenvalues(malus::coherency_eigenvalues(malus::Mueller<double>()), {});
}

TEST_CASE("a matrix that does not depolarise has one eigenvalue, m00") {
  Random random(80);
  for (int i = 0; i < 200; ++i) {
    const auto number = [&] {
      return jones::Complex{random.between(-1, 1), random.between(-1, 1)};
    };
    const auto rows = jones::mueller({number(), number(), number(), number()});
    const auto m = Full::from_rows(rows);
    check_eigenvalues(malus::coherency_eigenvalues(m), {rows[0][0], 0, 0, 0});
    CHECK(malus::is_physical(m, 1e-13));
  }
}

TEST_CASE("eigenvalues sum to m00, and sums of physical matrices are physical") {
  Random random(81);
  for (int i = 0; i < 100; ++i) {
    malus::Mueller<double> sum;
    const auto frame = random.frame();
    for (int term = 0; term < 3; ++term) {
      sum += malus::linear_polarizer(random.unit(), frame, random.between(0, 3));
      sum += malus::elliptical_retarder(random.unit(), random.direction(), random.between(0, 6),
                                        frame);
    }
    const auto e = malus::coherency_eigenvalues(sum);
    CHECK(e[0] + e[1] + e[2] + e[3] == doctest::Approx(sum.m00()));
    CHECK(malus::is_physical(sum, 1e-13));
    CHECK(e[1] > 1e-6);
  }
}

TEST_CASE("matrices that cannot exist are told, though they keep some light physical") {
  // Mirrors the Poincaré sphere: maps every light to light, but is no sum of Jones matrices.
  const auto mirror = Full::from_rows({{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, -1}}});
  CHECK_FALSE(malus::is_physical(mirror, 1e-3));
  check_eigenvalues(malus::coherency_eigenvalues(mirror), {0.5, 0.5, 0.5, -0.5});
  const auto inversion = malus::partial_depolarizer<double, Lab>(1, -1);
  CHECK_FALSE(malus::is_physical(inversion, 1e-3));
  // Amplifies polarisation, has a negative transmittance, is no number.
  CHECK_FALSE(malus::is_physical(malus::partial_depolarizer<double, Lab>(1, 1.01), 1e-3));
  CHECK_FALSE(malus::is_physical(malus::depolarizer<double, Lab>(-0.1), 1e-3));
  const auto broken =
      Full::from_rows({{{1, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, not_a_number}, {0, 0, 0, 0}}});
  CHECK_FALSE(malus::is_physical(broken, 1e-3));
  const auto endless = Full::from_rows(
      {{{1, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 1 / std::numeric_limits<double>::denorm_min()}, {}}});
  CHECK_FALSE(malus::is_physical(endless, 1e-3));
}

TEST_CASE("a sign error of S3 in one place of a retarder makes it unphysical") {
  auto rows = jones::mueller(jones::retarder(0.3, 0.9));
  CHECK(malus::is_physical(Full::from_rows(rows), 1e-13));
  for (auto& row : rows) row[3] = -row[3];
  CHECK_FALSE(malus::is_physical(Full::from_rows(rows), 1e-3));
}
