// SPDX-License-Identifier: MIT
// The physics of interfaces: energy, Brewster's angle, total reflection, reciprocity, limits,
// edges.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>

#include <malus/analysis/physicality.hpp>
#include <malus/analysis/polarization_state.hpp>
#include <malus/optics/fresnel.hpp>
#include <malus/optics/retarder.hpp>
#include <malus/propagate.hpp>

#include "unit/optics_support.hpp"

namespace {

using namespace optics_test;
using Lab = malus::StaticFrame<struct LabTag>;
using Terms = malus::FresnelTerms<double>;

constexpr double tolerance = 1e-12;
constexpr int trials = 500;

double any_eta(Random& random) {
  return random.unit() < 0.5 ? random.between(0.3, 1) : random.between(1, 3);
}

template <class A, class B>
double terms_difference(const A& a, const B& b) {
  double worst = 0;
  worst = worse(worst, static_cast<double>(a.s) - static_cast<double>(b.s));
  worst = worse(worst, static_cast<double>(a.p) - static_cast<double>(b.p));
  worst = worse(worst, static_cast<double>(a.re) - static_cast<double>(b.re));
  return worse(worst, static_cast<double>(a.im) - static_cast<double>(b.im));
}

template <class T>
bool all_finite(const malus::FresnelTerms<T>& f) {
  return malus::is_finite(f.s) && malus::is_finite(f.p) && malus::is_finite(f.re) &&
         malus::is_finite(f.im);
}

}  // namespace

TEST_CASE("energy: what is not reflected is transmitted, for s and for p, from both sides") {
  Random random(40);
  for (int i = 0; i < trials; ++i) {
    const double cos_i = random.unit(), eta = any_eta(random);
    const Terms r = malus::fresnel_dielectric(cos_i, eta);
    const Terms t = malus::fresnel_transmission(cos_i, eta);
    CAPTURE(cos_i);
    CAPTURE(eta);
    CHECK(std::abs(r.s + t.s - 1) <= tolerance);
    CHECK(std::abs(r.p + t.p - 1) <= tolerance);
    CHECK(r.mean() + t.mean() == doctest::Approx(1));
  }
}

TEST_CASE("an interface does not depolarise: |r_s* r_p|² = R_s R_p, and so for transmission") {
  Random random(41);
  for (int i = 0; i < trials; ++i) {
    const double cos_i = random.unit(), eta = any_eta(random), k = random.between(0, 8);
    for (const Terms& f :
         {malus::fresnel_dielectric(cos_i, eta), malus::fresnel_transmission(cos_i, eta),
          malus::fresnel_conductor(cos_i, eta, k)})
      CHECK(std::abs(f.re * f.re + f.im * f.im - f.s * f.p) <= tolerance);
    const auto frame = random.frame();
    const auto m = malus::conductor_reflection(cos_i, eta, k, frame, frame);
    CHECK(malus::coherency_eigenvalues(m)[1] <= tolerance);
  }
}

TEST_CASE("every Fresnel block is physical") {
  Random random(42);
  for (int i = 0; i < trials; ++i) {
    const double cos_i = random.unit(), eta = any_eta(random), k = random.between(0, 8);
    CHECK(malus::is_physical(malus::dielectric_reflection<double>(cos_i, eta, Lab{}, Lab{}),
                             tolerance));
    CHECK(malus::is_physical(malus::dielectric_transmission<double>(cos_i, eta, Lab{}, Lab{}),
                             tolerance));
    const auto m = malus::conductor_reflection(cos_i, eta, k, Lab{}, Lab{});
    CHECK(malus::is_physical(m, tolerance));
    const auto d = random.direction();
    const auto light = m * malus::Stokes<double, malus::incident, Lab>(1, d[0], d[1], d[2]);
    CHECK(malus::is_physical(light, 1e-9));
    CHECK(light[0] <= 1 + tolerance);
  }
}

TEST_CASE("at Brewster's angle no p light is reflected, and what is reflected is s light") {
  for (const double eta : {1.1, 1.33, 1.5, 2.4, 1 / 1.5, 0.4}) {
    CAPTURE(eta);
    const double cos_i = std::cos(std::atan(eta));
    const Terms f = malus::fresnel_dielectric(cos_i, eta);
    CHECK(f.p <= 1e-30);
    CHECK(f.s > 1e-3);
    CHECK(malus::fresnel_transmission(cos_i, eta).p == doctest::Approx(1));
    const auto m = malus::dielectric_reflection<double>(cos_i, eta, Lab{}, Lab{});
    const auto light = m * malus::Stokes<double, malus::incident, Lab>::unpolarized(1);
    CHECK(malus::degree_of_polarization(light) == doctest::Approx(1));
    CHECK(light[1] > 0);
    // r_s* r_p changes its sign there: from opposite p axes at normal incidence to the same.
    CHECK(malus::fresnel_dielectric(cos_i + 0.01, eta).re < 0);
    CHECK(malus::fresnel_dielectric(cos_i - 0.01, eta).re > 0);
  }
}

TEST_CASE("total internal reflection is a lossless retarder with s as its fast axis") {
  Random random(43);
  for (int i = 0; i < trials; ++i) {
    const double eta = random.between(0.3, 0.95);
    const double cos_i = random.between(0.001, 0.999) * std::sqrt(1 - eta * eta);
    const Terms f = malus::fresnel_dielectric(cos_i, eta);
    CHECK(std::abs(f.s - 1) <= tolerance);
    CHECK(std::abs(f.p - 1) <= tolerance);
    CHECK(std::abs(f.re * f.re + f.im * f.im - 1) <= tolerance);
    CHECK(f.im < 0);
    CHECK(malus::fresnel_transmission(cos_i, eta).mean() == 0);
    // r_p lags r_s by `lag`, which to a retarder along s is a phase of 2π − lag.
    const double lag = -std::atan2(f.im, f.re);
    const auto m = malus::dielectric_reflection<double>(cos_i, eta, Lab{}, Lab{});
    CHECK(difference(m, malus::linear_retarder(1.0, -lag, Lab{})) <= tolerance);
  }
}

TEST_CASE("a conductor without absorption is a dielectric, on both sides of the critical angle") {
  Random random(44);
  for (int i = 0; i < trials; ++i) {
    const double cos_i = random.unit(), eta = any_eta(random);
    const Terms dielectric = malus::fresnel_dielectric(cos_i, eta);
    CHECK(terms_difference(malus::fresnel_conductor(cos_i, eta, 0.0), dielectric) <= tolerance);
    // The way there is continuous; q has an infinite slope at the critical angle.
    if (std::abs((eta - 1) * (eta + 1) + cos_i * cos_i) > 0.01)
      CHECK(terms_difference(malus::fresnel_conductor(cos_i, eta, 1e-9), dielectric) <= 1e-6);
  }
}

TEST_CASE("transmission is reciprocal, and reflection from both sides equally strong") {
  Random random(45);
  for (int i = 0; i < trials; ++i) {
    const double eta = random.between(1, 3), cos_i = random.between(0.01, 1);
    const double cos_t = malus::refracted_cosine(cos_i, eta);
    CHECK(malus::refracted_cosine(cos_t, 1 / eta) == doctest::Approx(cos_i).epsilon(1e-9));
    const auto in = malus::dielectric_transmission<double>(cos_i, eta, Lab{}, Lab{});
    const auto out = malus::dielectric_transmission<double>(cos_t, 1 / eta, Lab{}, Lab{});
    CHECK(difference(in, out) <= 1e-10);
    CHECK(terms_difference(malus::fresnel_dielectric(cos_i, eta),
                           malus::fresnel_dielectric(cos_t, 1 / eta)) <= 1e-10);
  }
}

TEST_CASE("Snell's law gives the refracted cosine, zero beyond the critical angle") {
  Random random(46);
  for (int i = 0; i < trials; ++i) {
    const double cos_i = random.unit(), eta = any_eta(random);
    const double sin_t = std::sqrt(1 - cos_i * cos_i) / eta;
    const double cos_t = malus::refracted_cosine(cos_i, eta);
    if (sin_t < 1)
      CHECK(std::abs(cos_t * cos_t + sin_t * sin_t - 1) <= tolerance);
    else
      CHECK(cos_t == 0);
  }
}

TEST_CASE("refraction and its cosine agree, to the last bit, about where reflection is total") {
  const auto check = []<class T>(T eta) {
    const T critical = std::sqrt((1 - eta) * (1 + eta));
    T cos_i = critical * (1 - 20 * std::numeric_limits<T>::epsilon());
    for (int i = 0; i < 40; ++i, cos_i = std::nextafter(cos_i, T(1))) {
      const auto r = malus::fresnel_dielectric(cos_i, eta);
      const auto t = malus::fresnel_transmission(cos_i, eta);
      CHECK((t.mean() > 0) == (malus::refracted_cosine(cos_i, eta) > 0));
      CHECK(all_finite(r));
      CHECK(std::abs(r.s + t.s - 1) <= 16 * std::numeric_limits<T>::epsilon());
      CHECK(std::abs(r.p + t.p - 1) <= 16 * std::numeric_limits<T>::epsilon());
    }
  };
  for (const double eta : {0.4, 1 / 1.5, 0.9}) {
    check(eta);
    check(static_cast<float>(eta));
  }
}

TEST_CASE("where there is no interface nothing is reflected, up to grazing incidence") {
  const auto check = []<class T>(T cos_i) {
    CAPTURE(cos_i);
    const auto r = malus::fresnel_dielectric(cos_i, T(1));
    const auto absorbing = malus::fresnel_conductor(cos_i, T(1), T(0));
    const auto t = malus::fresnel_transmission(cos_i, T(1));
    constexpr double few = 4 * std::numeric_limits<T>::epsilon();
    CHECK(terms_difference(r, Terms{0, 0, 0, 0}) <= few);
    // |q²|² of the general formula underflows below.
    if (cos_i == 0 || cos_i >= T(1e-8))
      CHECK(terms_difference(absorbing, Terms{0, 0, 0, 0}) <= few);
    CHECK(terms_difference(t, Terms{1, 1, 1, 0}) <= few);
    CHECK(std::abs(malus::refracted_cosine(cos_i, T(1)) - cos_i) <= few);
  };
  for (const double cos_i : {1.0, 0.5, 1e-2, 1e-4, 1e-6, 1e-8, 1e-15, 0.0}) {
    check(cos_i);
    check(static_cast<float>(cos_i));
  }
}

TEST_CASE("all light is reflected at grazing incidence, none of it transmitted") {
  for (const double eta : {0.5, 1 / 1.5, 0.999, 1.001, 1.5, 3.0}) {
    const Terms r = malus::fresnel_dielectric(0.0, eta);
    CHECK(terms_difference(r, Terms{1, 1, 1, 0}) <= tolerance);
    CHECK(malus::fresnel_transmission(0.0, eta).mean() == 0);
    CHECK(terms_difference(malus::fresnel_conductor(0.0, eta, 3.0), Terms{1, 1, 1, 0}) <=
          tolerance);
    // The limit, and not its value alone.
    CHECK(terms_difference(malus::fresnel_dielectric(1e-9, eta), Terms{1, 1, 1, 0}) <= 1e-6);
  }
}

TEST_CASE("at normal incidence s and p are alike, and the reflected p axis is turned round") {
  for (const double eta : {0.5, 1.5, 3.0})
    for (const double k : {0.0, 0.1, 4.0}) {
      const double r = ((eta - 1) * (eta - 1) + k * k) / ((eta + 1) * (eta + 1) + k * k);
      CHECK(terms_difference(malus::fresnel_conductor(1.0, eta, k), Terms{r, r, -r, 0}) <=
            tolerance);
    }
}

TEST_CASE("Fresnel terms are finite at every edge, in float and in double") {
  const auto check = []<class T>(T) {
    for (const double cos_value : {0.0, 1e-30, 1e-12, 1e-4, 0.5, 1 - 1e-7, 1.0})
      for (const double eta_value : {1e-3, 0.5, 1 - 1e-7, 1.0, 1 + 1e-7, 1.5, 100.0}) {
        const T cos_i = static_cast<T>(cos_value), eta = static_cast<T>(eta_value);
        CAPTURE(cos_i);
        CAPTURE(eta);
        CHECK(all_finite(malus::fresnel_dielectric(cos_i, eta)));
        CHECK(all_finite(malus::fresnel_transmission(cos_i, eta)));
        for (const double k : {0.0, 1e-7, 1.0, 1e4}) {
          CAPTURE(k);
          const auto f = malus::fresnel_conductor(cos_i, eta, static_cast<T>(k));
          CHECK(all_finite(f));
          constexpr T above = 1 + 8 * std::numeric_limits<T>::epsilon();
          CHECK(f.s <= above);
          CHECK(f.p <= above);
        }
      }
  };
  check(float{});
  check(double{});
}

TEST_CASE("a mirror of k = 10⁴ reflects nearly all light, its p with the sign of a perfect one") {
  const Terms f = malus::fresnel_conductor(0.5, 1.0, 1e4);
  CHECK(terms_difference(f, Terms{1, 1, -1, 0}) <= 1e-3);
}

TEST_CASE(
    "Fresnel terms in float are those in double to a few roundings, next to no interface too") {
  Random random(47);
  constexpr double few = 32 * std::numeric_limits<float>::epsilon();
  for (int i = 0; i < trials; ++i) {
    const auto cos_i = static_cast<float>(random.between(0.05, 1));
    const auto k = static_cast<float>(random.between(0.5, 8));
    const auto eta = i % 4 ? static_cast<float>(random.between(1.05, 3))
                           : std::nextafter(1.0f, i % 8 ? 2.0f : 0.0f);
    const double cos2 = cos_i, eta2 = eta, k2 = k;
    CAPTURE(cos_i);
    CAPTURE(eta);
    CHECK(terms_difference(malus::fresnel_dielectric(cos_i, eta),
                           malus::fresnel_dielectric(cos2, eta2)) <= few);
    CHECK(terms_difference(malus::fresnel_conductor(cos_i, eta, k),
                           malus::fresnel_conductor(cos2, eta2, k2)) <= few);
    CHECK(terms_difference(malus::fresnel_transmission(cos_i, eta),
                           malus::fresnel_transmission(cos2, eta2)) <= few);
  }
}
