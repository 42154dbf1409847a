// SPDX-License-Identifier: MIT
// The exponential of the differential Mueller matrix against thin slices, elements and a Taylor
// series in long double.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include <malus/optics/diattenuator.hpp>
#include <malus/optics/differential.hpp>
#include <malus/optics/retarder.hpp>
#include <malus/optics/rotator.hpp>
#include <malus/propagate.hpp>

#include "unit/optics_support.hpp"

namespace {

using namespace optics_test;
using malus::MuellerForm;
using Lab = malus::StaticFrame<struct LabTag>;
using Axes = malus::Frame<double>;
using Differential = malus::DifferentialMueller<double>;
using Vec3 = glm::dvec3;
template <class T>
using Matrix4 = std::array<std::array<T, 4>, 4>;

constexpr int trials = 200;

template <class T>
Matrix4<T> operator*(const Matrix4<T>& a, const Matrix4<T>& b) {
  Matrix4<T> product{};
  for (std::size_t r = 0; r < 4; ++r)
    for (std::size_t c = 0; c < 4; ++c)
      for (std::size_t k = 0; k < 4; ++k) product[r][c] += a[r][k] * b[k][c];
  return product;
}

template <class M>
Matrix4<double> components(const M& m) {
  Matrix4<double> rows;
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

/// exp(−K l) by a Taylor series and squarings in long double, K as it is documented.
template <class T>
Matrix4<long double> series(const malus::DifferentialMueller<T>& k, T length) {
  const auto at = [&](T x) {
    return static_cast<long double>(x) * static_cast<long double>(length);
  };
  const long double e = at(k.extinction), d1 = at(k.diattenuation[0]), d2 = at(k.diattenuation[1]),
                    d3 = at(k.diattenuation[2]), r1 = at(k.retardance[0]), r2 = at(k.retardance[1]),
                    r3 = at(k.retardance[2]);
  Matrix4<long double> minus_k = {
      {{-e, d1, d2, d3}, {d1, -e, r3, -r2}, {d2, -r3, -e, r1}, {d3, r2, -r1, -e}}};
  constexpr int squarings = 12;
  for (auto& row : minus_k)
    for (auto& x : row) x = std::ldexp(x, -squarings);
  Matrix4<long double> sum{}, term{};
  for (std::size_t i = 0; i < 4; ++i) sum[i][i] = term[i][i] = 1;
  for (int n = 1; n < 14; ++n) {
    term = term * minus_k;
    for (std::size_t i = 0; i < 16; ++i) {
      term[i / 4][i % 4] /= static_cast<long double>(n);
      sum[i / 4][i % 4] += term[i / 4][i % 4];
    }
  }
  return doubled(sum, squarings);
}

/// The product of 2^power slices, each of half a retarder, a diattenuator and half a retarder.
Matrix4<double> slices(const Differential& k, double length, int power) {
  const double h = std::ldexp(length, -power);
  const auto norm = [](const std::array<double, 3>& v) { return std::hypot(v[0], v[1], v[2]); };
  const double d = norm(k.diattenuation), r = norm(k.retardance);
  auto dichroism = k.diattenuation, fast = k.retardance;
  for (double& x : dichroism) x *= d > 0 ? std::tanh(d * h) / d : 0;
  for (double& x : fast) x /= r > 0 ? r : 1;
  const auto half = components(malus::elliptical_retarder(1.0, fast, r * h / 2, Lab{}));
  const auto loss = components(malus::elliptical_diattenuator(
      std::exp(-k.extinction * h) * std::cosh(d * h), dichroism, Lab{}));
  return doubled(half * loss * half, power);
}

/// Random matter that does not amplify: |D| ≤ ε.
Differential passive(Random& random, double largest = 2) {
  Differential k;
  k.extinction = random.between(0, largest);
  const auto d = random.direction(), r = random.direction();
  const double dichroism = random.unit() * k.extinction,
               retardance = random.between(0, 2 * largest);
  for (std::size_t i = 0; i < 3; ++i)
    k.diattenuation[i] = dichroism * d[i], k.retardance[i] = retardance * r[i];
  return k;
}

Vec3 vector(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

}  // namespace

TEST_CASE("a stretch is a fine product of slices made of diattenuators and retarders") {
  Random random(70);
  for (int i = 0; i < trials; ++i) {
    const Differential k = passive(random);
    const double length = random.between(0, 3);
    auto expected = slices(k, length, 9);
    const auto coarser = slices(k, length, 8);
    for (std::size_t j = 0; j < 16; ++j)  // Richardson: the error goes with the square
      expected[j / 4][j % 4] += (expected[j / 4][j % 4] - coarser[j / 4][j % 4]) / 3;
    CHECK(deviation(malus::transmittance(k, length, Lab{}), expected) <= 1e-8);
  }
}

TEST_CASE("pure media are the elements: attenuator, diattenuator, retarder, rotator") {
  Random random(71);
  const Axes frame = random.frame();
  for (int i = 0; i < trials; ++i) {
    const double e = random.between(1, 2), x = random.between(-1, 1), l = random.between(0, 3);
    const double t = std::exp(-e * l);
    const Differential absorber{.extinction = e}, dichroic{e, {x, 0, 0}, {0, 0, 0}},
        birefringent{e, {0, 0, 0}, {x, 0, 0}}, active{e, {0, 0, 0}, {0, 0, -2 * x}};
    const auto transmittance = [&](const Differential& k) {
      const auto m = malus::transmittance(k, l, frame);
      CHECK(difference(m, malus::transmittance(k, l, Lab{})) <= 1e-15);
      CHECK(m.form() == k.form());
      CHECK(std::abs(m.m00() - malus::unpolarized_transmittance(k, l)) <= 1e-15);
      return m;
    };
    CHECK(transmittance(absorber).form() == MuellerForm::plain);
    CHECK(transmittance(absorber).m00() == t);
    CHECK(transmittance(dichroic).form() == MuellerForm::block);
    CHECK(difference(transmittance(dichroic),
                     malus::linear_diattenuator(std::exp(-(e - x) * l), std::exp(-(e + x) * l),
                                                frame)) <= 1e-15);
    CHECK(transmittance(birefringent).form() == MuellerForm::block);
    CHECK(difference(transmittance(birefringent), malus::linear_retarder(t, x * l, frame)) <=
          1e-15);
    CHECK(transmittance(active).form() == MuellerForm::full);
    CHECK(difference(transmittance(active), malus::rotator(t, x * l, frame)) <= 1e-15);

    const auto axis = random.direction();
    Differential elliptical{.extinction = e};
    for (std::size_t c = 0; c < 3; ++c) elliptical.retardance[c] = axis[c] * x;
    CHECK(difference(transmittance(elliptical),
                     malus::elliptical_retarder(t, axis, x * l, frame)) <= 2e-15);
    std::swap(elliptical.diattenuation, elliptical.retardance);
    auto diattenuation = axis;
    for (double& c : diattenuation) c *= std::tanh(x * l);
    CHECK(difference(transmittance(elliptical),
                     malus::elliptical_diattenuator(t * std::cosh(x * l), diattenuation, frame)) <=
          2e-15);
  }
}

TEST_CASE_TEMPLATE("a stretch is the exponential to rounding, also where eigenvalues meet", T,
                   float, double) {
  Random random(72);
  double worst = 0;
  for (int i = 0; i < 20 * trials; ++i) {
    // Either vector at any scale; parallel, perpendicular, equal (all eigenvalues coincide), or one
    // only.
    const double scale = std::pow(10.0, random.between(-9, 0.5));
    const auto a = vector(random.direction()), b = vector(random.direction());
    Vec3 d = a * scale, r = b * (scale * std::pow(10.0, random.between(-3, 0.5)));
    const auto kind = random.below(8);
    if (kind == 1) r = glm::cross(d, glm::normalize(glm::cross(a, b)));
    if (kind == 2) r = d * random.between(-3, 3);
    if (kind == 3) r = Vec3(0);
    if (kind == 4) d = Vec3(0);
    if (kind == 5) r = glm::cross(d, glm::normalize(glm::cross(a, b))) * (1 + 1e-5 * random.unit());
    malus::DifferentialMueller<T> k;
    k.extinction = static_cast<T>(glm::length(d) * random.between(1.001, 2));
    for (int c = 0; c < 3; ++c) {
      k.diattenuation[static_cast<std::size_t>(c)] = static_cast<T>(d[c]);
      k.retardance[static_cast<std::size_t>(c)] = static_cast<T>(r[c]);
    }
    const T length = static_cast<T>(random.between(0, 2));
    const auto expected = series(k, length);
    const auto m = malus::transmittance(k, length, Lab{});
    // All components are bounded by m00. Arguments are rounded, which a phase turns into an error.
    const long double argument = static_cast<long double>(length) *
                                 static_cast<long double>(glm::length(d) + glm::length(r));
    const long double unit = static_cast<long double>(std::numeric_limits<T>::epsilon()) *
                             expected[0][0] * (1 + argument);
    for (std::size_t j = 0; j < 16; ++j) {
      const auto error =
          static_cast<long double>(m(static_cast<int>(j / 4), static_cast<int>(j % 4))) -
          expected[j / 4][j % 4];
      worst = optics_test::worse(worst, static_cast<double>(error / unit));
    }
  }
  CHECK(worst <= 4);
}

TEST_CASE_TEMPLATE("any length is finite, and infinitely much matter is dark", T, float, double) {
  Random random(73);
  const auto frame = malus::Frame<T>::about(glm::vec<3, T>(0, 0, 1));
  const T huge = std::numeric_limits<T>::infinity(), largest = std::numeric_limits<T>::max();
  for (int i = 0; i < 20 * trials; ++i) {
    const Differential p = passive(random);
    malus::DifferentialMueller<T> k;
    const auto scale = static_cast<T>(std::pow(10.0, random.between(-30, 12)));
    k.extinction = static_cast<T>(p.extinction) * scale;
    for (std::size_t c = 0; c < 3; ++c) {
      k.diattenuation[c] = static_cast<T>(p.diattenuation[c]) * scale * (i % 3 > 0);
      k.retardance[c] = static_cast<T>(p.retardance[c]) * (i % 2 > 0 ? scale : T(1e10));
    }
    const auto length = static_cast<T>(std::pow(10.0, random.between(-12, 30)));
    for (const T l : {T(0), length, largest, huge}) {
      const auto m = malus::transmittance(k, l, Lab{});
      CHECK(all_finite(m));
      CHECK(m(0, 0) <= T(1.00001));
      CHECK(m(0, 0) >= 0);
      // The same along x, where the form is a block.
      auto along_x = k;
      along_x.diattenuation = {k.diattenuation[0], T(0), T(0)};
      along_x.retardance = {k.retardance[0], T(0), T(0)};
      const auto block = malus::transmittance(along_x, l, frame);
      CHECK(all_finite(block));
      CHECK(block.m00() >= 0);
      CHECK(block.m00() <= T(1));
      if (l == huge) CHECK(block.m00() == 0);
      if (l == huge) CHECK(m(0, 0) == 0);
    }
    CHECK(difference(malus::transmittance(k, T(0), Lab{}),
                     malus::linear_retarder(T(1), T(0), Lab{})) == 0);
  }
  // What spares one polarisation altogether does not amplify it by rounding.
  for (int i = 0; i < trials; ++i) {
    const auto n = random.direction();
    malus::DifferentialMueller<T> k;
    for (std::size_t c = 0; c < 3; ++c) k.diattenuation[c] = static_cast<T>(n[c]);
    k.extinction = std::hypot(k.diattenuation[0], k.diattenuation[1], k.diattenuation[2]);
    CHECK(malus::transmittance(k, 1000 / std::numeric_limits<T>::epsilon(), Lab{})(0, 0) <= 1);
  }
  const malus::DifferentialMueller<T> clear{}, dye{T(1e10), {}, {}},
      birefringent{T(0), {}, {T(3), T(0), T(0)}}, polarizing{T(1e9), {T(1e9), 0, 0}, {}},
      skew{T(5), {T(0), T(3), T(4)}, {}};
  CHECK(malus::transmittance(clear, huge, frame).m00() == 1);
  CHECK(malus::transmittance(dye, T(1e30), frame).m00() == 0);
  CHECK(all_finite(malus::transmittance(birefringent, huge, frame)));
  CHECK(malus::transmittance(birefringent, huge, frame).m00() == 1);
  // What absorbs but one polarisation becomes a polarizer.
  for (const T l : {T(1e30), huge})
    CHECK(difference(malus::transmittance(polarizing, l, frame),
                     malus::linear_diattenuator(T(1), T(0), frame)) == 0);
  CHECK(difference(malus::transmittance(skew, T(200), Lab{}),
                   malus::elliptical_diattenuator(T(0.5), {T(0), T(0.6), T(0.8)}, Lab{})) <= 1e-4);
}

TEST_CASE("decay rates: what long stretches lose, and what the trace of all stretches is") {
  Random random(79);
  for (int i = 0; i < trials; ++i) {
    const Differential k = passive(random);
    const auto rates = malus::decay_rates(k);
    CHECK(rates.slowest + rates.fastest == doctest::Approx(2 * k.extinction));
    // tr exp(−Kl) is the sum over the eigenvalues: two are real, two conjugate ones ε ± ib.
    const auto oscillation = [&](double l) {
      const auto m = malus::transmittance(k, l, Lab{});
      return (m(0, 0) + m(1, 1) + m(2, 2) + m(3, 3) - std::exp(-rates.slowest * l) -
              std::exp(-rates.fastest * l)) *
             std::exp(k.extinction * l) / 2;
    };
    const double c = oscillation(0.5);
    CHECK(oscillation(1) == doctest::Approx(2 * c * c - 1).epsilon(1e-9));
    CHECK(oscillation(2) == doctest::Approx(2 * std::pow(2 * c * c - 1, 2) - 1).epsilon(1e-7));
  }
  const auto rates = malus::decay_rates<float>({3e-30f, {0, 2e-30f, 0}, {1e-30f, 0, 0}});
  CHECK(rates.slowest == doctest::Approx((3 - std::sqrt(3.0)) * 1e-30).epsilon(1e-6));
}
