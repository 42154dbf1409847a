// SPDX-License-Identifier: MIT
// Every BSDF by itself: what it draws is what it says it draws, and its matrix carries the weight
// that unpolarised light has.
#include <doctest/doctest.h>

#include <complex>
#include <vector>

#include "bsdfs/bsdf.hpp"
#include "core/warp.hpp"

using namespace renderer;

namespace {

using Polarized = malus::Polarized<Rgb>;
using Unpolarized = malus::Unpolarized<Rgb>;

/// Of any kind.
template <class B>
Bsdf make(const B& b) {
  return Bsdf(Bsdf::Kind(b));
}

std::vector<Bsdf> all() {
  LinearPolarizer polarizer;
  polarizer.theta = 0.3f;
  LinearPolarizer grey = polarizer;
  grey.polarizing = false;
  LinearRetarder retarder;
  retarder.theta = 0.4f;
  retarder.delta = 1.1f;
  CircularPolarizer left;
  left.hand = malus::Handedness::left;
  return {make(Diffuse{Rgb(0.3f, 0.5f, 0.9f)}),
          make(Conductor{Rgb(0.2f, 0.9f, 1.4f), Rgb(3.9f, 2.4f, 1.6f), Rgb(0.9f, 0.8f, 1.0f)}),
          make(Conductor{}),
          make(Dielectric{1.5f, Rgb(0.9f), Rgb(0.8f)}),
          make(Dielectric{1 / 1.33f, Rgb(1.0f), Rgb(1.0f)}),
          make(polarizer),
          make(grey),
          make(retarder),
          make(CircularPolarizer{}),
          make(left),
          make(NullSurface{})};
}

/// A surface turned at random, and a direction anywhere around it.
struct Event {
  Hit hit;
  Vec3 exitant;
  explicit Event(Sampler& s) {
    hit.normal = hit.geometric_normal = square_to_sphere(s.next_2d());
    const Basis basis(hit.normal);
    const float a = 2 * pi * s.next_1d();
    hit.tangent = std::cos(a) * basis.s + std::sin(a) * basis.t;
    exitant = square_to_sphere(s.next_2d());
  }
};

bool close(const Rgb& a, const Rgb& b, float relative) {
  for (std::size_t i = 0; i < 3; ++i)
    if (!(std::abs(a[i] - b[i]) <= relative * (1e-3f + std::abs(a[i])))) return false;
  return true;
}

}  // namespace

TEST_CASE("bsdf: the first component of every weight is the weight of unpolarised light") {
  Sampler sampler(1, 2, 3);
  for (const Bsdf& bsdf : all()) {
    CAPTURE(bsdf.kind().index());
    int drawn = 0;
    for (int i = 0; i < 2000; ++i) {
      const Event e(sampler);
      BsdfSample s;
      if (!bsdf.sample(e.hit, e.exitant, sampler, s)) continue;
      ++drawn;
      const Rgb u = bsdf.weight<Unpolarized>(e.hit, e.exitant, s);
      const auto m = bsdf.weight<Polarized>(e.hit, e.exitant, s);
      if (!close(u, m.m00(), 1e-4f) || !close(u, s.weight, 1e-6f) ||
          !(std::abs(glm::length(s.incident) - 1) < 1e-5f))
        FAIL_CHECK("m00 ", m.m00()[0], ", weight ", s.weight[0]);
    }
    CHECK(drawn > 900);
  }
}

TEST_CASE("bsdf: a sheet does to a shadow ray's light what it does to a path's") {
  Sampler sampler(4, 5, 6);
  for (const Bsdf& bsdf : all()) {
    if (!bsdf.is_sheet()) continue;
    CAPTURE(bsdf.kind().index());
    const Event e(sampler);
    BsdfSample s;
    REQUIRE(bsdf.sample(e.hit, e.exitant, sampler, s));
    CHECK(s.incident == -e.exitant);
    const auto a = bsdf.weight<Polarized>(e.hit, e.exitant, s);
    const auto b = bsdf.transmit<Polarized>(e.hit, e.exitant);
    for (int r = 0; r < 4; ++r)
      for (int c = 0; c < 4; ++c) CHECK(a(r, c)[0] == b(r, c)[0]);
  }
}

TEST_CASE("bsdf: diffuse directions follow the density they claim") {
  const Bsdf bsdf = make(Diffuse{});
  Sampler sampler(7, 8, 9);
  const Event e = [&] {
    for (;;) {
      const Event candidate(sampler);
      if (glm::dot(candidate.hit.normal, candidate.exitant) > 0.1f) return candidate;
    }
  }();
  const Basis basis(e.hit.normal);
  constexpr int rows = 10, columns = 16, samples = 200000;
  std::vector<double> counts(rows * columns, 0.0);
  for (int i = 0; i < samples; ++i) {
    BsdfSample s;
    if (!bsdf.sample(e.hit, e.exitant, sampler, s)) continue;
    CHECK_MESSAGE(std::abs(s.pdf - bsdf.pdf(e.hit, s.incident, e.exitant)) < 1e-4f * (1 + s.pdf),
                  s.pdf);
    const float z = glm::dot(s.incident, e.hit.normal);
    const float phi = std::atan2(glm::dot(s.incident, basis.t), glm::dot(s.incident, basis.s));
    const int row = std::min(rows - 1, static_cast<int>((z + 1) / 2 * rows));
    const int column = std::min(columns - 1, static_cast<int>((phi / (2 * pi) + 0.5f) * columns));
    ++counts[static_cast<std::size_t>(row * columns + column)];
  }
  double chi2 = 0, integral = 0;
  int bins = 0;
  constexpr int fine = 32;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      double expected = 0;
      for (int i = 0; i < fine; ++i)
        for (int j = 0; j < fine; ++j) {
          const float z =
              -1 + 2 * (static_cast<float>(row) + (static_cast<float>(i) + 0.5f) / fine) / rows;
          const float phi =
              2 * pi *
              ((static_cast<float>(column) + (static_cast<float>(j) + 0.5f) / fine) / columns -
               0.5f);
          const float r = std::sqrt(1 - z * z);
          const Vec3 d =
              r * std::cos(phi) * basis.s + r * std::sin(phi) * basis.t + z * e.hit.normal;
          expected += static_cast<double>(bsdf.pdf(e.hit, d, e.exitant));
        }
      expected *= 4 * static_cast<double>(pi) / (rows * columns * fine * fine);
      integral += expected;
      const double n = counts[static_cast<std::size_t>(row * columns + column)],
                   m = expected * samples;
      if (m < 1e-9) {
        CHECK(n == 0);
        continue;
      }
      chi2 += (n - m) * (n - m) / m;
      ++bins;
    }
  CHECK(integral == doctest::Approx(1).epsilon(1e-4));
  REQUIRE(bins == 80);
  // 79 degrees of freedom: 131 is exceeded with probability 2e-4.
  CHECK(chi2 < 131);
}

TEST_CASE(
    "bsdf: a dielectric's matrices are Fresnel's, divided by the chance they are drawn with") {
  Sampler sampler(10, 11, 12);
  const Bsdf bsdf = make(Dielectric{1.5f, Rgb(1.0f), Rgb(1.0f)});
  int reflections = 0, refractions = 0;
  for (int i = 0; i < 4000; ++i) {
    const Event e(sampler);
    BsdfSample s;
    if (!bsdf.sample(e.hit, e.exitant, sampler, s)) continue;
    using Complex = std::complex<double>;
    const double cos_signed = static_cast<double>(glm::dot(e.hit.normal, e.exitant));
    const double c = std::abs(cos_signed), eta = cos_signed > 0 ? 1.5 : 1 / 1.5;
    const Complex q = std::sqrt(Complex(eta * eta - 1 + c * c));
    const Complex rs = (c - q) / (c + q), rp = (eta * eta * c - q) / (eta * eta * c + q);
    const auto m = bsdf.weight<Polarized>(e.hit, e.exitant, s);
    const bool reflected = static_cast<double>(glm::dot(e.hit.normal, s.incident)) * cos_signed > 0;
    (reflected ? reflections : refractions)++;
    double is, ip;
    Complex product;
    if (reflected) {
      is = std::norm(rs), ip = std::norm(rp), product = std::conj(rs) * rp;
    } else {
      // Powers transmitted; radiance out of the denser medium is 1/eta^2 of that within.
      const double ts = 2 * c / std::abs(c + q), tp = 2 * eta * c / std::abs(eta * eta * c + q);
      const double factor = q.real() / c / (eta * eta);
      is = ts * ts * factor, ip = tp * tp * factor, product = ts * tp * factor;
    }
    const double pdf = static_cast<double>(s.pdf);
    const auto at = [&](int r, int k) { return static_cast<double>(m(r, k)[0]) * pdf; };
    const double tolerance = c < 0.05 ? 5e-3 : 2e-4;
    if (std::abs(at(0, 0) - (is + ip) / 2) > tolerance ||
        std::abs(at(0, 1) - (is - ip) / 2) > tolerance ||
        std::abs(at(2, 2) - product.real()) > tolerance ||
        std::abs(at(3, 2) + product.imag()) > tolerance ||
        std::abs(at(2, 3) - product.imag()) > tolerance || at(0, 2) != 0 || at(3, 1) != 0)
      FAIL_CHECK("at the cosine ", cos_signed, reflected ? ", reflected" : ", refracted");
  }
  CHECK(reflections > 500);
  CHECK(refractions > 1000);
}

TEST_CASE("bsdf: what is not a front reflects nothing, and a twosided material flips to be one") {
  Sampler sampler(1, 1, 1);
  const Bsdf front = make(Diffuse{Rgb(0.25f)}), back = make(Conductor{});
  Hit hit;
  hit.normal = hit.geometric_normal = Vec3(0, 0, 1);
  const Vec3 below = glm::normalize(Vec3(0.3f, 0.2f, -1));
  BsdfSample s;
  CHECK_FALSE(front.sample(hit, below, sampler, s));
  CHECK(front.pdf(hit, below, below) == 0);
  CHECK(front.m00(hit, below, below)[0] == 0);

  const Material both{&front, &back};
  Hit seen = hit;
  CHECK(&both.facing(seen, -below) == &front);
  CHECK(seen.normal == hit.normal);
  CHECK(&both.facing(seen, below) == &back);
  CHECK(seen.normal == -hit.normal);
  CHECK(back.sample(seen, below, sampler, s));
  CHECK(glm::dot(s.incident, seen.normal) > 0);
}
