// SPDX-License-Identifier: MIT
// Facets: their distributions by the integrals that define them, their drawing by what it is drawn
// from, their Mueller matrices by published ones and by reciprocity.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <vector>

#include <malus/analysis/physicality.hpp>
#include <malus/change_frame.hpp>
#include <malus/optics/microfacet.hpp>

#include "reference/microfacet_mueller.hpp"
#include "unit/optics_support.hpp"

namespace {

using namespace optics_test;
using malus::MicrofacetShape;
using Facets = malus::MicrofacetDistribution<double>;
using Vec = glm::dvec3;
using Full = malus::FullMueller<double, malus::incident, malus::exitant>;

const Facets surfaces[] = {{MicrofacetShape::beckmann, 0.5, 0.5},
                           {MicrofacetShape::ggx, 0.5, 0.5},
                           {MicrofacetShape::beckmann, 0.3, 0.8},
                           {MicrofacetShape::ggx, 0.8, 0.25}};

Vec direction(double theta_degrees, double phi_degrees) {
  const double t = radians(theta_degrees), p = radians(phi_degrees);
  return {std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t)};
}

/// ∫ f(m) dm over the upper hemisphere: by tan θ = α t/(1 − t), under which facets' densities are
/// smooth.
template <class F>
double over_hemisphere(double alpha, const F& f) {
  constexpr int steps = 600, turns = 240;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double t = (i + 0.5) / steps, tangent = alpha * t / (1 - t);
    const double z = 1 / std::sqrt(1 + tangent * tangent), r = tangent * z;
    const double measure = r * z * z * alpha / ((1 - t) * (1 - t)) / steps * 2 * pi / turns;
    for (int j = 0; j < turns; ++j) {
      const double phi = 2 * pi * (j + 0.5) / turns;
      sum += f(Vec(r * std::cos(phi), r * std::sin(phi), z)) * measure;
    }
  }
  return sum;
}

/// A matrix in the frames that the same directions have when light goes the other way: x stays, y
/// turns around.
malus::Frame<double> reversed(const malus::Frame<double>& f) { return {f.x(), -f.y()}; }

}  // namespace

TEST_CASE("facets cover the surface once") {
  for (const Facets& f : surfaces)
    CHECK(over_hemisphere(0.5, [&](const Vec& m) { return f.density(m) * m.z; }) ==
          doctest::Approx(1).epsilon(2e-4));
}

TEST_CASE("facets seen from a direction cover what the surface does: masking is Smith's") {
  for (const Facets& f : surfaces)
    for (const double theta : {0.0, 20.0, 60.0, 85.0}) {
      CAPTURE(theta);
      const Vec v = direction(theta, 30);
      CHECK(over_hemisphere(0.5, [&](const Vec& m) { return f.visible_density(v, m); }) ==
            doctest::Approx(1).epsilon(1e-3));
    }
}

TEST_CASE("density is homogeneous, and zero below the horizon") {
  Random random(50);
  for (const Facets& f : surfaces) {
    const Vec m = direction(random.between(0, 80), random.between(0, 360));
    CHECK(f.density(m * 0.037) == doctest::Approx(f.density(m)));
    CHECK(f.density({m.x, m.y, -m.z}) == 0);
    CHECK(f.density({1, 0, 0}) == 0);
  }
}

TEST_CASE("drawn facets follow the density of visible ones") {
  // Bins of 20 × 16 in the squeezed slopes' plane, where a wrong Jacobian or a wrong cumulative
  // distribution shows; χ² of all surfaces and directions at once.
  Random random(51);
  for (const Facets& f : surfaces)
    for (const double theta : {0.0, 45.0, 80.0, 89.5}) {
      CAPTURE(static_cast<int>(f.shape()));
      CAPTURE(theta);
      const Vec v = direction(theta, 250);
      constexpr int rows = 20, columns = 16, samples = 100000;
      const auto bin = [&](const Vec& m) {
        const double x = m.x / m.z / f.alpha_x(), y = m.y / m.z / f.alpha_y();
        const double radius = std::sqrt(x * x + y * y), t = radius / (1 + radius);
        const double turn = std::atan2(y, x) / (2 * pi) + 0.5;
        return static_cast<std::size_t>(std::min(rows - 1, static_cast<int>(t * rows)) * columns +
                                        std::min(columns - 1, static_cast<int>(turn * columns)));
      };
      std::vector<double> expected(rows * columns), counts(rows * columns);
      // dm = z³ d(slopes), slopes = α r (cos φ, sin φ), r = t/(1 − t).
      constexpr int fine = 16;
      for (int i = 0; i < rows * fine; ++i)
        for (int j = 0; j < columns * fine; ++j) {
          const double t = (i + 0.5) / (rows * fine), r = t / (1 - t);
          const double phi = 2 * pi * ((j + 0.5) / (columns * fine) - 0.5);
          const Vec m = glm::normalize(
              Vec(f.alpha_x() * r * std::cos(phi), f.alpha_y() * r * std::sin(phi), 1));
          const double measure = m.z * m.z * m.z * f.alpha_x() * f.alpha_y() * r /
                                 ((1 - t) * (1 - t)) / (rows * fine) * 2 * pi / (columns * fine);
          expected[bin(m)] += f.visible_density(v, m) * measure * samples;
        }
      for (int i = 0; i < samples; ++i) {
        const double u = random.unit();
        ++counts[bin(f.sample_visible(v, u, random.unit()))];
      }
      double chi2 = 0, rest = 0, rest_expected = 0;
      int degrees = -1;
      for (std::size_t i = 0; i < counts.size(); ++i) {
        if (expected[i] < 10) {
          rest += counts[i], rest_expected += expected[i];
          continue;
        }
        chi2 += (counts[i] - expected[i]) * (counts[i] - expected[i]) / expected[i];
        ++degrees;
      }
      CHECK(std::abs(rest - rest_expected) < 6 * std::sqrt(rest_expected + 10));
      // Beyond 4.5 standard deviations with a probability of about 1e-5 each.
      CHECK((chi2 - degrees) / std::sqrt(2.0 * degrees) < 4.5);
    }
}

TEST_CASE("single precision agrees with double, to alpha = 0.001 and at grazing directions") {
  Random random(52);
  for (const auto shape : {MicrofacetShape::beckmann, MicrofacetShape::ggx})
    for (const double alpha : {0.001, 0.03, 1.0}) {
      const Facets exact(shape, alpha, alpha);
      const malus::MicrofacetDistribution<float> f(shape, static_cast<float>(alpha),
                                                   static_cast<float>(alpha));
      for (const double theta : {0.0, 0.01, 50.0, 89.0, 89.999}) {
        CAPTURE(alpha);
        CAPTURE(theta);
        const Vec v = direction(theta, 40);
        const glm::vec3 w = glm::normalize(glm::vec3(v));
        CHECK(f.projected_area(w) == doctest::Approx(exact.projected_area(Vec(w))).epsilon(1e-5));
        for (int i = 0; i < 200; ++i) {
          const double a = random.unit(), b = random.unit();
          const auto m = f.sample_visible(w, static_cast<float>(a), static_cast<float>(b));
          REQUIRE(std::abs(glm::length(m) - 1) < 1e-5f);
          REQUIRE(m.z > 0);
          CHECK(f.density(m) == doctest::Approx(exact.density(Vec(m))).epsilon(1e-4));
          const glm::vec3 o = 2 * glm::dot(w, m) * m - w;
          if (!(o.z > 0)) continue;
          const auto lobe = f.reflection(w, o);
          CHECK(malus::is_finite(lobe.value));
          CHECK(lobe.value >= 0);
        }
      }
      // All corners of the unit square.
      for (const float a : {0.0f, 0x1.fffffep-1f})
        for (const float b : {0.0f, 0x1.fffffep-1f})
          for (const double theta : {0.0, 60.0, 89.9999})
            CHECK(malus::is_finite(f.sample_visible(glm::vec3(direction(theta, 10)), a, b).z));
    }
}

TEST_CASE(
    "a rough conductor's matrices are those published, in and out of the plane of incidence") {
  const Facets f(MicrofacetShape::beckmann, reference::facets_alpha, reference::facets_alpha);
  for (const auto& row : reference::conductor_facets) {
    CAPTURE(row.ti_degrees);
    CAPTURE(row.ts_degrees);
    CAPTURE(row.phi_degrees);
    const Vec wi = direction(row.ti_degrees, 180), wo = direction(row.ts_degrees, row.phi_degrees);
    const auto m = malus::conductor_facets(f, wi, wo, reference::facets_n, reference::facets_k);
    const auto frame = [](const Vec& k) {
      return malus::Frame<double>::from_direction_and_x(
          k, glm::normalize(glm::cross(Vec(0, 0, 1), k)));
    };
    const auto turned =
        m.expressed_in(frame(-wi), frame(wo)) * (1 / (f.masking(wi) * f.masking(wo)));
    std::array<std::array<double, 4>, 4> expected;
    for (std::size_t r = 0; r < 4; ++r)
      for (std::size_t c = 0; c < 4; ++c)
        expected[r][c] = row.m[r][c] * ((r == 3) == (c == 3) ? 1 : -1);
    CHECK(deviation(turned, expected) < 1e-9);
  }
}

TEST_CASE("light that goes back takes the transposed matrix, and n² times as much of it") {
  // Reciprocity of fields says J of the reversed light is Jᵀ, in the same axes. Axes x and y of
  // light that goes the other way are x and −y: S2 turns its sign by that, S3 doesn't, since a
  // wave's handedness is the same from both ends. So M' = Q Mᵀ Q, Q = diag(1, 1, −1, 1); in the
  // same, then left-handed axes it would be diag(1, 1, 1, −1).
  Random random(53);
  constexpr double q[4] = {1, 1, -1, 1};
  int refractions = 0;
  for (int i = 0; i < 4000; ++i) {
    const Facets& f = surfaces[random.below(4)];
    const double eta = random.between(1.2, 2.0);
    const bool conducting = random.unit() < 0.3;
    Vec a = direction(random.between(0, 85), random.between(0, 360));
    Vec b = direction(random.between(0, 85), random.between(0, 360));
    if (!conducting && random.unit() < 0.7) b.z = -b.z;
    if (!conducting && random.unit() < 0.5) std::swap(a, b);
    const auto matrix = [&](const Vec& wi, const Vec& wo) -> Full {
      const auto in = malus::Frame<double>::toward(-wi, Vec(0.3, 0.5, 0.8));
      const auto out = malus::Frame<double>::toward(wo, Vec(-0.2, 0.9, 0.1));
      return conducting ? malus::conductor_facets(f, wi, wo, 0.4, 2.5).expressed_in(in, out)
                        : malus::dielectric_facets<double>(f, wi, wo, eta).expressed_in(in, out);
    };
    const Full there = matrix(a, b);
    if (!(there.m00() > 1e-6)) continue;
    const Full back = matrix(b, a).expressed_in(reversed(there.exit()), reversed(there.enter()));
    if (a.z * b.z < 0) ++refractions;
    const double n2 = a.z * b.z > 0 ? 1 : a.z > 0 ? 1 / (eta * eta) : eta * eta;
    double worst = 0;
    for (int r = 0; r < 4; ++r)
      for (int c = 0; c < 4; ++c) worst = worse(worst, back(r, c) - n2 * q[r] * q[c] * there(c, r));
    CHECK(worst <= 1e-9 * (1 + there.m00() * n2));
    CHECK(malus::is_physical(there, 1e-9 * (1 + there.m00())));
  }
  CHECK(refractions > 300);
}

TEST_CASE("facets give back no more light than they get, nor lose any but at second facets") {
  // Power that leaves to all sides, ∫ f cos dω, of light that comes from one: by drawn facets, each
  // of which sends R and T = 1 − R on its ways, less what other facets stop.
  Random random(54);
  for (const Facets& f : surfaces)
    for (const double eta : {1.5, 1 / 1.5})
      for (const double theta : {0.0, 60.0, 85.0}) {
        const Vec from = direction(theta, 77);
        double power = 0;
        constexpr int samples = 4000;
        for (int i = 0; i < samples; ++i) {
          const double u = random.unit();
          const Vec m = f.sample_visible(from, u, random.unit());
          const double c = glm::dot(from, m), t = malus::refracted_cosine(c, eta);
          const Vec reflected = 2 * c * m - from;
          const Vec refracted = (c / eta - t) * m - from / eta;
          double all = 0;
          if (reflected.z > 0) {
            const auto lobe = f.reflection(from, reflected);
            all += malus::fresnel_dielectric(c, eta).mean() * lobe.value * reflected.z / lobe.pdf_o;
          }
          if (t > 0 && refracted.z < 0) {
            // From `from`'s side, eta before the interface over that behind it.
            const auto lobe = f.refraction(from, refracted, 1 / eta);
            all +=
                malus::fresnel_transmission(c, eta).mean() * lobe.value * -refracted.z / lobe.pdf_o;
          }
          CHECK(all <= 1 + 1e-9);
          power += all / samples;
        }
        CHECK(power > (theta < 70 ? 0.5 : 0.3));
      }
}
