// SPDX-License-Identifier: MIT
// Phase functions: that they are normalised, that draws follow the density that they claim, what
// they are by closed forms and by Mie's series, and what files of tables are refused for.
#include <doctest/doctest.h>

#include <malus/optics/mie.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "core/sampler.hpp"
#include "media/henyey_greenstein_phase.hpp"
#include "media/isotropic_phase.hpp"
#include "media/mie_phase.hpp"
#include "media/phase_function.hpp"
#include "media/rayleigh_phase.hpp"
#include "media/tabulated_phase.hpp"
#include "scene_files.hpp"

namespace {

using namespace renderer;
using Row = TabulatedPhase::Row;
using Elements = malus::ScatteringElements<double>;
using Complex = std::complex<double>;

constexpr double exact_pi = std::numbers::pi;

double d(float x) { return static_cast<double>(x); }

/// 2π ∫ f d cos Θ between two angles, in Θ, by Simpson's rule.
template <class F>
double integral(const F& f, double from = 0, double to = exact_pi, int steps = 20000) {
  double sum = 0;
  for (int i = 0; i <= steps; ++i) {
    const double theta = from + (to - from) * i / steps;
    const double rule = i == 0 || i == steps ? 1 : i % 2 == 1 ? 4 : 2;
    sum += rule * d(f(static_cast<float>(std::cos(theta)))) * std::sin(theta);
  }
  return 2 * exact_pi * sum * (to - from) / steps / 3;
}

/// χ² of drawn angles in 100 bins about as probable as each other, in standard deviations.
template <class Phase>
double deviations_of_draws(const Phase& phase, std::uint64_t seed) {
  constexpr int bins = 100, samples = 200000;
  Sampler sampler(seed, 0, 0);
  std::vector<float> edges{1};
  for (int i = 1; i < bins; ++i) edges.push_back(phase.sample(static_cast<float>(i) / bins));
  edges.push_back(-1);
  REQUIRE(std::is_sorted(edges.begin(), edges.end(), std::greater<>()));
  std::vector<double> counts(bins);
  for (int i = 0; i < samples; ++i) {
    const float c = phase.sample(sampler.next_1d());
    const auto at = std::upper_bound(edges.begin() + 1, edges.end() - 1, c, std::greater<>());
    ++counts[static_cast<std::size_t>(at - edges.begin() - 1)];
  }
  double chi2 = 0;
  for (std::size_t i = 0; i < bins; ++i) {
    const auto density = [&](float c) { return phase.pdf(c); };
    const double expected =
        samples * integral(density, std::acos(d(edges[i])), std::acos(d(edges[i + 1])), 2000);
    chi2 += (counts[i] - expected) * (counts[i] - expected) / expected;
  }
  // Wilson & Hilferty's normal approximation.
  constexpr double k = bins - 1, spread = 2 / (9 * k);
  return (std::cbrt(chi2 / k) - (1 - spread)) / std::sqrt(spread);
}

/// What holds of every kind.
template <class Phase>
void check_phase(const std::string& name, const Phase& phase, double tolerance = 1e-4) {
  CAPTURE(name);
  for (std::size_t k = 0; k < 3; ++k)
    CHECK(integral([&](float c) { return phase.value(c)[k]; }) ==
          doctest::Approx(1).epsilon(tolerance));
  for (int i = 0; i <= 1000; ++i) {
    const float c = static_cast<float>(std::cos(exact_pi * i / 1000));
    const Rgb v = phase.value(c);
    CHECK(d(phase.pdf(c)) == doctest::Approx((d(v[0]) + d(v[1]) + d(v[2])) / 3).epsilon(1e-5));
    if constexpr (Phase::polarizes) {
      const auto e = phase.elements(c);
      CHECK(e.a1 == v);
      for (const Rgb& x : {e.a2, e.a3, e.a4, e.b1, e.b2})
        for (std::size_t k = 0; k < 3; ++k) CHECK(std::abs(x[k]) <= v[k] * 1.00001f);
    }
  }
  for (const float u : {0.0f, 0x1p-24f, 0.5f, 1 - 0x1p-23f, 0x1.fffffep-1f}) {
    const float c = phase.sample(u);
    CHECK((c >= -1 && c <= 1));
    CHECK(phase.pdf(c) > 0);
  }
  // Beyond 4.5 deviations by chance in 7e-6 of all seeds, of some 20 kinds.
  CHECK(std::abs(deviations_of_draws(phase, 7)) < 4.5);
}

/// A table whose channels differ, at uneven angles, with a forward peak and a stretch of nothing.
struct Table {
  std::vector<double> angles;
  std::vector<Row> rows;
};
Table peaked_table() {
  Table t;
  for (double degrees :
       {0.0, 0.05, 0.2, 0.5, 1.0, 3.0, 20.0, 21.0, 90.0, 110.0, 120.0, 179.0, 180.0}) {
    const double theta = degrees * exact_pi / 180;
    Row row;
    for (std::size_t k = 0; k < 3; ++k) {
      const double width = 0.01 * static_cast<double>(k + 1);
      const double a1 =
          degrees == 110 || degrees == 120 ? 0 : 1 / (theta * theta + width * width) + degrees;
      row[k] = {a1, 0.9 * a1, 0.5 * a1, -0.2 * a1, -0.3 * a1, 0.1 * a1};
    }
    t.angles.push_back(theta);
    t.rows.push_back(row);
  }
  return t;
}

}  // namespace

TEST_CASE(
    "phase: all kinds are normalised, drawn by their densities, and polarise by their value") {
  check_phase("isotropic", IsotropicPhase{});
  for (const float g : {-0.9f, -0.3f, 0.0f, 1e-6f, 1e-3f, 0.5f, 0.95f, 0.99f})
    check_phase("hg " + std::to_string(g), HenyeyGreensteinPhase(g), d(g) > 0.9 ? 1e-3 : 1e-4);
  for (const float rho : {0.0f, 1e-4f, 0.1f, 0.5f, 6.0f / 7})
    check_phase("rayleigh " + std::to_string(rho), RayleighPhase(rho));
  const Table t = peaked_table();
  check_phase("table", TabulatedPhase(t.angles, t.rows), 1e-3);
  check_phase("small spheres", make_mie_phase({0.02, 1, 1.33, 1}));
  check_phase("fog", make_mie_phase({3, 1.2, 1.33, 1}), 1e-3);
  check_phase("one size", make_mie_phase({8, 1, Complex(1.5, 0.01), 1.33}), 1e-3);
}

TEST_CASE("phase: hg has its mean cosine, forward for g > 0, and its closed form") {
  for (const float g : {-0.999f, -0.5f, 0.0f, 1e-5f, 0.3f, 0.85f, 0.999f}) {
    CAPTURE(g);
    const HenyeyGreensteinPhase phase(g);
    double mean = 0, worst = 0;
    constexpr int steps = 200000;
    for (int i = 0; i < steps; ++i) {
      const float u = (static_cast<float>(i) + 0.5f) / steps;
      const double c = d(phase.sample(u));
      mean += c / steps;
      // The share of what is further forward than this draw, by the integral of the closed form.
      const double a = d(g), root = std::sqrt(1 + a * a - 2 * a * c);
      const double share =
          std::abs(a) < 1e-3 ? (1 - c) / 2 : (1 - a * a) / (2 * a) * (1 / (1 - a) - 1 / root);
      worst = std::max(worst, std::abs(share - d(u)));
    }
    CHECK(mean == doctest::Approx(d(g)).epsilon(1e-5));
    if (std::abs(g) < 0.9f) CHECK(worst < 1e-5);
    CHECK(d(phase.value(0.25f)[1]) == doctest::Approx((1 - d(g * g)) / (4 * exact_pi) /
                                                      std::pow(1 + d(g * g) - 0.5 * d(g), 1.5)));
  }
}

TEST_CASE("phase: rayleigh has its closed forms") {
  // Chandrasekhar 1950, Radiative Transfer, section 16: 3/4 (1 + cos²) of dipoles; at right angles
  // light is polarised across the plane, wholly by isotropic particles.
  const RayleighPhase dipoles;
  CHECK(d(dipoles.value(0)[0]) == doctest::Approx(3 / (16 * exact_pi)));
  CHECK(d(dipoles.value(-1)[0]) == doctest::Approx(6 / (16 * exact_pi)));
  CHECK(dipoles.elements(0).b1 == -dipoles.value(0));
  // The cumulative distribution inverted at cosines of which it is known: 1/2 − (3c + c³)/8.
  for (const float c : {-0.9f, -0.2f, 1e-4f, 0.5f, 0.99f})
    CHECK(d(dipoles.sample(0.5f - (3 * c + c * c * c) / 8)) == doctest::Approx(d(c)).epsilon(1e-4));
  // (1 − ρ)/(1 + ρ) of unpolarised light is polarised at right angles.
  const auto air = RayleighPhase(0.0279f).elements(0);
  CHECK(d(-air.b1[2] / air.a1[2]) == doctest::Approx((1 - 0.0279) / (1 + 0.0279)));
}

TEST_CASE("phase: a table's elements keep their ratios and are linear in the cosine between rows") {
  const Table t = peaked_table();
  const TabulatedPhase phase(t.angles, t.rows);
  for (std::size_t i = 0; i + 1 < t.angles.size(); ++i) {
    CAPTURE(i);
    const auto at = [&](double part) {
      return static_cast<float>(std::cos(t.angles[i]) * (1 - part) +
                                std::cos(t.angles[i + 1]) * part);
    };
    const Rgb a = phase.value(at(0)), b = phase.value(at(1));
    // Rounding of the cosine is a part of narrow cells.
    const double width = std::cos(t.angles[i]) - std::cos(t.angles[i + 1]);
    for (const double part : {0.25, 0.5, 0.75}) {
      const auto e = phase.elements(at(part));
      for (std::size_t k = 0; k < 3; ++k) {
        const double expected = d(a[k]) * (1 - part) + d(b[k]) * part;
        CHECK(std::abs(d(e.a1[k]) - expected) < (1e-5 + 2e-7 / width) * (d(a[k]) + d(b[k])));
        if (expected < 1e-4) continue;
        CHECK(d(e.a2[k] / e.a1[k]) == doctest::Approx(0.9).epsilon(1e-3));
        CHECK(d(e.a4[k] / e.a1[k]) == doctest::Approx(-0.2).epsilon(1e-3));
        CHECK(d(e.b1[k] / e.a1[k]) == doctest::Approx(-0.3).epsilon(1e-3));
        CHECK(d(e.b2[k] / e.a1[k]) == doctest::Approx(0.1).epsilon(1e-3));
      }
    }
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const double ratio = t.rows[2][k].a1 / t.rows[8][k].a1;
    CHECK(d(phase.value(static_cast<float>(std::cos(t.angles[2])))[k] / phase.value(0)[k]) ==
          doctest::Approx(ratio).epsilon(0.02));
  }
  // Two rows are enough, and angles that single precision can't tell apart do no harm.
  const Row ones{Elements{1, 1, 1, 1, 0, 0}, {1, 1, 1, 1, 0, 0}, {1, 1, 1, 1, 0, 0}};
  const TabulatedPhase even(std::vector<double>{0, exact_pi}, std::vector<Row>{ones, ones});
  CHECK(d(even.value(0.3f)[0]) == doctest::Approx(1 / (4 * exact_pi)));
  const TabulatedPhase close(std::vector<double>{0, 1e-9, 1e-6, exact_pi - 1e-9, exact_pi},
                             std::vector<Row>(5, ones));
  check_phase("close angles", close);
}

TEST_CASE("phase: mie has each channel's sphere, its asymmetry and its cross-sections") {
  for (const auto& [radius, index, around] :
       {std::tuple(0.3, Complex(1.5, 0.1), 1.0), std::tuple(8.0, Complex(1.33, 0), 1.0),
        std::tuple(4.0, Complex(1, 0), 1.33)}) {
    CAPTURE(radius);
    const TabulatedPhase phase = make_mie_phase({radius, 1, index, around});
    for (std::size_t k = 0; k < 3; ++k) {
      const malus::MieSphere sphere(2 * exact_pi * radius * around / rgb_wavelengths[k],
                                    index / around);
      double error = 0, all = 0;
      for (int i = 0; i <= 3600; ++i) {
        const float c = static_cast<float>(std::cos(exact_pi * i / 3600));
        const auto mine = phase.elements(c);
        const auto exact = sphere.elements(d(c));
        const double pairs[][2] = {{d(mine.a1[k]), exact.a1}, {d(mine.a2[k]), exact.a2},
                                   {d(mine.a3[k]), exact.a3}, {d(mine.a4[k]), exact.a4},
                                   {d(mine.b1[k]), exact.b1}, {d(mine.b2[k]), exact.b2}};
        for (const auto& [a, b] : pairs) error += std::abs(a * 4 * exact_pi - b) / exact.a1;
        all += 6;
      }
      CHECK(error / all < 0.02);
      CHECK(integral([&](float c) { return c * phase.value(c)[k]; }) ==
            doctest::Approx(sphere.asymmetry()).epsilon(2e-3));
    }
  }
  const auto rayleigh = mie_cross_sections({0.01, 1, 1.33, 1});
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(rayleigh.scattering[k] == doctest::Approx(rayleigh.extinction[k]));
    CHECK(rayleigh.scattering[k] ==
          doctest::Approx(std::pow(rgb_wavelengths[1] / rgb_wavelengths[k], 4)).epsilon(0.02));
  }
  const auto soot = mie_cross_sections({0.05, 1.5, Complex(1.75, 0.44), 1});
  CHECK(soot.extinction[1] == 1);
  for (std::size_t k = 0; k < 3; ++k) CHECK(soot.scattering[k] < 0.6 * soot.extinction[k]);
}

TEST_CASE("phase: particles that can't be had are refused by name and value") {
  const auto error = [](const MieParticles& p) {
    return scene_test::error_of([&] { make_mie_phase(p, rgb_wavelengths, {"scene.xml", 7}); });
  };
  CHECK_MESSAGE_HAS(error({-1, 1, 1.33, 1}), "scene.xml:7: ", "radius", "-1", "more than 0");
  CHECK_MESSAGE_HAS(error({1e4, 1, 1.33, 1}), "size parameter", "0.001 to 5000");
  CHECK_MESSAGE_HAS(error({100, 2, 1.33, 1}), "largest", "up to 5000");
  CHECK_MESSAGE_HAS(error({1, 0.5, 1.33, 1}), "geometric deviation", "0.5", "1 to 3");
  CHECK_MESSAGE_HAS(error({1, 1, Complex(1.33, -0.1), 1}), "absorption", "-0.1", "0 to 20");
  CHECK_MESSAGE_HAS(error({1, 1, 1.33, 1.33}), "1.33", "another index");
  CHECK_MESSAGE_HAS(error({1, 1, 1.33, 0}), "surrounding index", "0", "more than 0");
  CHECK_MESSAGE_HAS(error({std::nan(""), 1, 1.33, 1}), "radius", "nan");
}

TEST_CASE("phase: files of tables are read, and what is wrong with one is said by line and value") {
  const scene_test::Folder folder;
  const std::string good =
      "# water\r\n0, 2 2 2 2 0 0\n\n 90 1 0.5 0 0.25 -0.5 0.125 # right angle\n180 1 1 -1 -1 0 0";
  const auto read = [&](const std::string& text) {
    return read_tabulated_phase(folder.write("a.txt", text));
  };
  const TabulatedPhase phase = read(good);
  const auto e = phase.elements(0);
  const Rgb ratios[] = {e.a2 / e.a1, e.a3 / e.a1, e.a4 / e.a1, e.b1 / e.a1, e.b2 / e.a1};
  const float expected[] = {0.5f, 0, 0.25f, -0.5f, 0.125f};
  for (int i = 0; i < 5; ++i) CHECK(d(ratios[i][1]) == doctest::Approx(d(expected[i])));
  // Linear from 2 to 1, then 1: a mean of 5/4.
  CHECK(d(phase.value(1)[2]) == doctest::Approx(2 / 1.25 / (4 * exact_pi)));

  const auto error = [&](const std::string& text) {
    return scene_test::error_of([&] { read(text); });
  };
  const std::string first = "0 1 1 1 1 0 0\n", last = "180 1 1 1 1 0 0\n";
  CHECK_MESSAGE_HAS(error(first + "90 1 1 1 1 0\n" + last), "a.txt:2: ", "6 numbers", "allowed: 7");
  CHECK_MESSAGE_HAS(error(first + "90 1 1 x 1 0 0\n" + last), "a.txt:2: ", "a3", "\"x\"");
  CHECK_MESSAGE_HAS(error(first + "90 nan 1 1 1 0 0\n" + last), "a1", "\"nan\"");
  CHECK_MESSAGE_HAS(error(first + "90 1 1 1e31 1 0 0\n" + last), "a3", "\"1e31\"", "1e30");
  CHECK_MESSAGE_HAS(error(first + "90 -1 0 0 0 0 0\n" + last), "a1 is -1", "0 and more");
  CHECK_MESSAGE_HAS(error(first + "90 1 1 1 1 -1.01 0\n" + last), "b1 is -1.01", "up to a1, 1");
  CHECK_MESSAGE_HAS(error(first + "0 1 1 1 1 0 0\n" + last), "a.txt:2: ", "angle 0 after 0");
  CHECK_MESSAGE_HAS(error(first + "181 1 1 1 1 0 0\n"), "angle 181", "up to 180");
  CHECK_MESSAGE_HAS(error("5 1 1 1 1 0 0\n" + last), "first angle is 5", "allowed: 0");
  CHECK_MESSAGE_HAS(error(first + "90 1 1 1 1 0 0\n"), "last angle is 90", "allowed: 180");
  CHECK_MESSAGE_HAS(error(first), "last angle is 0", "allowed: 180");
  CHECK_MESSAGE_HAS(error("# nothing\n"), "a.txt: ", "no line of numbers");
  CHECK_MESSAGE_HAS(error("0 0 0 0 0 0 0\n180 0 0 0 0 0 0\n"), "nowhere more than 0");
  CHECK_MESSAGE_HAS(scene_test::error_of([&] {
                      read_tabulated_phase("none.txt", {"scene.xml", 3});
                    }),
                    "scene.xml:3: ", "none.txt", "no such file");
}

TEST_CASE("phase: what is polarised is scattered as its S0 says, whichever way a path is traced") {
  using R = malus::Polarized<Rgb>;
  const PhaseFunction phase(RayleighPhase(0.02f));
  const Vec3 known = normalized(Vec3(0.2f, -0.5f, 0.7f));
  for (const Tracing tracing : {Tracing::from_camera, Tracing::from_light}) {
    // The direction of propagation that is known: light's that arrives, or that leaves.
    const Vec3 way = tracing == Tracing::from_light ? -known : known;
    const auto frame = malus::Frame<float>::about(way);
    const malus::Stokes<Rgb> light(Rgb(1.0f), Rgb(0.5f), Rgb(-0.6f), Rgb(0.3f), frame);
    const malus::Analyzer<Rgb, malus::exitant> row(Rgb(1.0f), Rgb(0.5f), Rgb(-0.6f), Rgb(0.3f),
                                                   frame);
    Sampler sampler(7, 0, 0);
    constexpr int samples = 40000;
    std::array<double, 8> azimuths{}, expected{};
    for (int i = 0; i < samples; ++i) {
      BsdfSample sample;
      phase.sample(known, LinearPolarization(light), sampler, sample);
      const Flow flow(known, sample.direction, tracing);
      const auto f = phase.with_matrix<R>(flow.incident, flow.exitant, Rgb(1.0f),
                                          [](const auto& m) -> R::Scattering { return m; });
      const float s0 = tracing == Tracing::from_light ? (f * malus::propagate(light)).intensity()[0]
                                                      : (row * f)[0][0];
      // The density that is drawn by is S0 after scattering: its weight is 1, whatever is drawn.
      CHECK(s0 / (sample.pdf * sample.likelihood) == doctest::Approx(1.0f).epsilon(1e-4));
      const float turn =
          std::atan2(glm::dot(sample.direction, frame.y()), glm::dot(sample.direction, frame.x()));
      ++azimuths[static_cast<std::size_t>((turn / (2 * pi) + 1) * 8) % 8];
    }
    // Of an octant of azimuths φ, the mean over angles of 1 + (b1/a1)(q cos 2φ + u sin 2φ): the
    // mean of b1 over that of a1 is -D/2, D = (1 - ρ)/(1 + ρ/2).
    const double dipoles = (1 - 0.02) / 1.01;
    double chi2 = 0;
    for (std::size_t k = 0; k < 8; ++k) {
      const double a = exact_pi * static_cast<double>(k) / 4, b = a + exact_pi / 4;
      const double q = 0.5 * (std::sin(2 * b) - std::sin(2 * a)) / 2,
                   u = -0.6 * (std::cos(2 * a) - std::cos(2 * b)) / 2;
      expected[k] = samples * (b - a - dipoles / 2 * (q + u)) / (2 * exact_pi);
      chi2 += (azimuths[k] - expected[k]) * (azimuths[k] - expected[k]) / expected[k];
    }
    // Of 7 degrees of freedom, above 41.1 with a chance of 1e-6.
    CHECK(chi2 < 41.1);
  }
}
