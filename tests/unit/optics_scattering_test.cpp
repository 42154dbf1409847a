// SPDX-License-Identifier: MIT
// Scattering by particles: Mie's series by Wiscombe's printed amplitudes, by its limits for small
// and for large spheres and by energy; Rayleigh's matrix by the mean over turned molecules; all
// signs by Jones calculus and by what a mirror does.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <complex>
#include <vector>

#include <malus/analysis/physicality.hpp>
#include <malus/change_frame.hpp>
#include <malus/optics/fresnel.hpp>
#include <malus/optics/mie_sizes.hpp>
#include <malus/optics/rayleigh.hpp>

#include "reference/miev0_amplitudes.hpp"
#include "unit/jones.hpp"
#include "unit/optics_support.hpp"

namespace {

using namespace optics_test;
using Complex = std::complex<double>;
using Vec = glm::dvec3;
using Elements = malus::ScatteringElements<double>;
using malus::MieSphere;

constexpr double Elements::*all_elements[] = {&Elements::a1, &Elements::a2, &Elements::a3,
                                              &Elements::a4, &Elements::b1, &Elements::b2};

double worst_difference(const Elements& a, const Elements& b) {
  double worst = 0;
  for (const auto e : all_elements) worst = worse(worst, a.*e - b.*e);
  return worst;
}

double cosine_of(double degrees) { return degrees == 90 ? 0.0 : std::cos(radians(degrees)); }

/// ∫ f d cos Θ/2, the mean over the sphere, in Θ: by the midpoint rule, of what is smooth.
template <class F>
double mean_over_sphere(const F& f, int steps = 8000) {
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double theta = pi * (i + 0.5) / steps;
    sum += f(std::cos(theta)) * std::sin(theta) / 2 * pi / steps;
  }
  return sum;
}

/// The mean of a molecule's phase matrix over all its turns, not normalised: a dipole α·E, of which
/// the far field is what is across the line of sight. Of polarisabilities along three axes.
jones::Rows mean_of_turned_molecules(const Vec& along_axes, double theta) {
  const Vec x_in(1, 0, 0), y(0, 1, 0), x_out(std::cos(theta), 0, -std::sin(theta));
  // Fourth powers of a rotation's components: exact with 3 points of Gauss's rule and 6 turns.
  constexpr double node[] = {-0.7745966692414834, 0, 0.7745966692414834};
  constexpr double weight[] = {5.0 / 9, 8.0 / 9, 5.0 / 9};
  jones::Rows mean{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 6; ++j)
      for (int k = 0; k < 6; ++k) {
        const double z = node[i], r = std::sqrt(1 - z * z), f = pi * j / 3, g = pi * k / 3;
        const Vec c(r * std::cos(f), r * std::sin(f), z);
        const Vec e(z * std::cos(f), z * std::sin(f), -r), h(-std::sin(f), std::cos(f), 0);
        const Vec a = std::cos(g) * e + std::sin(g) * h, b = glm::cross(c, a);
        const auto component = [&](const Vec& out, const Vec& in) {
          return Complex(along_axes.x * glm::dot(out, a) * glm::dot(a, in) +
                         along_axes.y * glm::dot(out, b) * glm::dot(b, in) +
                         along_axes.z * glm::dot(out, c) * glm::dot(c, in));
        };
        const auto m = jones::mueller(
            {component(x_out, x_in), component(x_out, y), component(y, x_in), component(y, y)});
        for (std::size_t row = 0; row < 4; ++row)
          for (std::size_t column = 0; column < 4; ++column)
            mean[row][column] += m[row][column] * weight[i] / 72;
      }
  return mean;
}

}  // namespace

TEST_CASE("Mie: amplitudes are Wiscombe's, at all angles and for all kinds of spheres") {
  for (const auto& row : reference::mie_rows) {
    CAPTURE(row.number);
    CAPTURE(row.theta_degrees);
    const MieSphere sphere(row.size, {row.index_re, -row.index_im});
    const auto [s1, s2] = sphere.amplitudes(cosine_of(row.theta_degrees));
    const double mine[] = {s1.real(), s1.imag(), s2.real(), s2.imag()};
    const double printed[] = {row.s1_re, -row.s1_im, row.s2_re, -row.s2_im};
    // Case 5 is printed by a formula for small spheres, which is good to 3e-6 of the amplitudes.
    const double size[] = {std::abs(s1), std::abs(s1), std::abs(s2), std::abs(s2)};
    for (int i = 0; i < 4; ++i)
      CHECK(std::abs(mine[i] - printed[i]) <=
            (row.number == 5 ? 3e-6 * size[i] : 1e-6 * std::abs(printed[i])));
  }
  // The same sphere at right angles, to 60 digits by the power series of the Bessel functions.
  const auto [s1, s2] = MieSphere(0.099, 0.75).amplitudes(0);
  CHECK(s1.real() == doctest::Approx(1.817558525e-8).epsilon(1e-9));
  CHECK(s1.imag() == doctest::Approx(1.651161741e-4).epsilon(1e-9));
  CHECK(s2.real() == doctest::Approx(1.510919471e-15).epsilon(1e-9));
  CHECK(s2.imag() == doctest::Approx(-2.938379863e-8).epsilon(1e-9));
}

TEST_CASE("elements of amplitudes are those of the Jones matrix diag(S2, S1)") {
  Random random(60);
  for (int i = 0; i < 100; ++i) {
    const Complex s1(random.between(-1, 1), random.between(-1, 1));
    const Complex s2(random.between(-1, 1), random.between(-1, 1));
    const auto frames = malus::frames_of_scattering<double>(random.direction(), random.direction());
    const auto m = malus::scattering_matrix(malus::scattering_elements(s1, s2), frames);
    CHECK(deviation(m, jones::mueller({s2, 0, 0, s1})) < 1e-14);
  }
}

TEST_CASE("frames of scattering have x in the plane and the common normal as y, and follow light") {
  Random random(61);
  for (int i = 0; i < 1000; ++i) {
    const auto a = random.direction(), b = random.direction();
    const Vec in(a[0], a[1], a[2]), out(b[0], b[1], b[2]);
    const auto [enter, exit] = malus::frames_of_scattering<double>(in, out);
    CHECK(enter.y() == exit.y());
    for (const auto& [frame, direction] : {std::pair(enter, in), std::pair(exit, out)}) {
      const double length = glm::length(frame.x());
      CHECK(glm::length(frame.y()) == doctest::Approx(length));
      CHECK(glm::dot(frame.direction(), direction) == doctest::Approx(length * length));
      CHECK(std::abs(glm::dot(frame.x(), glm::cross(in, out))) < 1e-14);
    }
    // Seen along the light before, x points to where the light after goes to.
    CHECK(glm::dot(enter.x(), out) > 0);
  }
}

TEST_CASE("directions that are nearly parallel have frames, and the matrix of those that are") {
  // Straight on the matrix is diag(a1, a2, a2, a4), and back diag(a1, a2, −a2, a4), in any plane.
  const auto rayleigh = malus::RayleighScattering<float>(0.1f);
  Random random(62);
  for (int i = 0; i < 4000; ++i) {
    const auto a = random.direction(), b = random.direction();
    const auto forward = glm::normalize(glm::vec3(a[0], a[1], a[2]));
    const float angle = static_cast<float>(std::pow(10, random.between(-9, -3)));
    const auto near = glm::normalize(forward + angle * glm::vec3(b[0], b[1], b[2]));
    const auto x = malus::Frame<float>::about(forward);
    for (const float sign : {1.0f, -1.0f}) {
      const auto out = i % 10 == 0 ? sign * forward : sign * near;
      const auto e = rayleigh.elements(sign);
      const auto m = malus::scattering_matrix(e, malus::frames_of_scattering<float>(forward, out));
      const malus::Frame<float> back(x.x(), sign * x.y());
      const auto fixed = m.expressed_in(x, back);
      CHECK(all_finite(fixed));
      // S2's sign goes with y's: in axes that stay, both a2.
      CHECK(deviation(fixed,
                      std::array<std::array<float, 4>, 4>{
                          {{e.a1, 0, 0, 0}, {0, e.a2, 0, 0}, {0, 0, e.a3, 0}, {0, 0, 0, e.a4}}}) <
            2e-3);
    }
  }
  const glm::vec3 z(0, 0, 1);
  for (const auto& out : {z, -z}) {
    const auto frames = malus::frames_of_scattering<float>(z, out);
    CHECK(glm::length(frames.enter.x()) == doctest::Approx(1));
    CHECK(glm::length(frames.exit.x()) == doctest::Approx(1));
  }
}

TEST_CASE("Rayleigh: the matrix is the mean over turned molecules, whatever their shape") {
  for (const Vec& axes :
       {Vec(1, 1, 1), Vec(1, 0, 0), Vec(1, 1, 0), Vec(1, 2, 3.5), Vec(1, -1, 0)}) {
    CAPTURE(axes.x + axes.y + axes.z);
    const auto side = mean_of_turned_molecules(axes, pi / 2);
    // The definition of ρ: S1 > 0 is parallel to the plane.
    const double rho = (side[0][0] + side[1][0]) / (side[0][0] - side[1][0]);
    const double mean = mean_over_sphere(
        [&](double c) { return mean_of_turned_molecules(axes, std::acos(c))[0][0]; }, 300);
    for (const double degrees : {0.0, 35.0, 90.0, 140.0, 180.0}) {
      auto expected = mean_of_turned_molecules(axes, radians(degrees));
      for (auto& row : expected)
        for (double& m : row) m /= mean;
      const auto e = malus::RayleighScattering<double>(rho).elements(std::cos(radians(degrees)));
      const auto frames = malus::frames_of_scattering<double>(
          Vec(0, 0, 1), Vec(std::sin(radians(degrees)), 0, std::cos(radians(degrees))));
      CHECK(deviation(malus::scattering_matrix(e, frames), expected) < 1e-4);
    }
  }
}

TEST_CASE("Rayleigh: depolarisation factors have their limits, and all of them are physical") {
  const auto factor = [](const Vec& axes) {
    const auto side = mean_of_turned_molecules(axes, pi / 2);
    return (side[0][0] + side[1][0]) / (side[0][0] - side[1][0]);
  };
  CHECK(factor({1, 0, 0}) == doctest::Approx(0.5));
  CHECK(factor({1, -1, 0}) == doctest::Approx(6.0 / 7));
  const auto physical = [](double rho) {
    for (double c = -1; c <= 1; c += 0.25) {
      const auto e = malus::RayleighScattering<double>(rho).elements(c);
      const Vec out(std::sqrt(1 - c * c), 0, c);
      const auto frames = malus::frames_of_scattering<double>(Vec(0, 0, 1), out);
      if (!malus::is_physical(malus::scattering_matrix(e, frames), 1e-12)) return false;
    }
    return true;
  };
  for (const double rho : {0.0, 0.028, 0.3, 0.5, 0.7, 6.0 / 7}) CHECK(physical(rho));
  for (const double rho : {0.0, 0.1, 0.8}) {
    const malus::RayleighScattering<double> scattering(rho);
    CHECK(mean_over_sphere([&](double c) { return scattering.value(c); }) ==
          doctest::Approx(1).epsilon(1e-6));
    CHECK(scattering.value(0.3) == scattering.elements(0.3).a1);
    CHECK((scattering.elements(0).a1 + scattering.elements(0).b1) /
              (scattering.elements(0).a1 - scattering.elements(0).b1) ==
          doctest::Approx(rho));
  }
  // One a channel.
  const auto colours = malus::RayleighScattering<Double3>(Double3(0.0, 0.1, 0.2)).elements(0.4);
  CHECK(colours.a4[1] == malus::RayleighScattering<double>(0.1).elements(0.4).a4);
}

TEST_CASE("Mie: small spheres are Rayleigh's") {
  for (const Complex index : {Complex(1.33, 0), Complex(0.7, 0), Complex(1.5, 1)})
    for (const double x : {1e-4, 1e-3}) {
      const MieSphere sphere(x, index);
      const Complex m2 = index * index, dipole = (m2 - 1.0) / (m2 + 2.0);
      CHECK(sphere.scattering() ==
            doctest::Approx(8.0 / 3 * std::pow(x, 4) * std::norm(dipole)).epsilon(1e-5));
      if (index.imag() > 0)
        CHECK(sphere.extinction() == doctest::Approx(4 * x * dipole.imag()).epsilon(1e-5));
      else
        CHECK(sphere.extinction() == doctest::Approx(sphere.scattering()).epsilon(1e-12));
      for (const double c : {-1.0, -0.3, 0.0, 0.6, 1.0})
        CHECK(worst_difference(sphere.elements(c),
                               malus::RayleighScattering<double>().elements(c)) < 1e-5);
    }
}

TEST_CASE("Mie: large opaque spheres reflect as mirrors do, which fixes the sign of b2") {
  // Away from forward diffraction what an absorbing sphere scatters is what its surface reflects,
  // at angles of incidence (π − Θ)/2: Fresnel's matrix in his frames, whose x is the normal of the
  // plane.
  constexpr double n = 1.5, k = 1;
  const MieSphere sphere(5000, {n, k});
  for (const double degrees : {60.0, 80.0, 100.0, 120.0, 150.0}) {
    CAPTURE(degrees);
    const double theta = radians(degrees);
    const Vec in(0, 0, 1), out(std::sin(theta), 0, std::cos(theta));
    const Vec normal = glm::normalize(out - in);
    const auto surface = malus::frames_of_incidence<double>(normal, in, out);
    const auto mirror =
        malus::conductor_reflection<double>(std::sin(theta / 2), n, k, surface.enter, surface.exit);
    const auto e = sphere.elements(std::cos(theta));
    const auto plane = malus::frames_of_scattering<double>(in, out);
    const auto m = malus::scattering_matrix(e, plane).expressed_in(surface.enter, surface.exit);
    CHECK(difference(m * (1 / e.a1), mirror * (1 / mirror.m00())) < 2e-3);
    CHECK(std::abs(e.b2) > 0.04 * e.a1);
  }
}

TEST_CASE("Mie: light is conserved, and what is missing forward is what is extinguished") {
  for (const Complex index : {Complex(1.33, 0), Complex(1.33, 1e-5), Complex(0.75, 0),
                              Complex(1.5, 1), Complex(10, 10), Complex(0.2, 3)})
    for (const double x : {0.05, 1.0, 7.3, 100.0}) {
      CAPTURE(x);
      const MieSphere sphere(x, index);
      CHECK(4 / (x * x) * sphere.amplitudes(1).s1.real() ==
            doctest::Approx(sphere.extinction()).epsilon(1e-10));
      CHECK(mean_over_sphere([&](double c) { return sphere.elements(c).a1; }) ==
            doctest::Approx(1).epsilon(2e-4));
      CHECK(mean_over_sphere([&](double c) { return sphere.elements(c).a1 * c; }) ==
            doctest::Approx(sphere.asymmetry()).epsilon(2e-4));
      if (index.imag() > 0)
        CHECK(sphere.extinction() > sphere.scattering());
      else
        CHECK(sphere.extinction() == doctest::Approx(sphere.scattering()).epsilon(1e-10));
    }
}

TEST_CASE("Mie: spheres from a thousandth to ten thousand, of any index, have finite matrices") {
  for (const Complex index : {Complex(1.33, 0), Complex(0.05, 0), Complex(20, 0), Complex(20, 20),
                              Complex(1.0000001, 0), Complex(1, 0)})
    for (const double x : {1e-3, pi / 2, pi, 33.0, 1e4}) {
      const MieSphere sphere(x, index);
      for (const double c : {-1.0, 0.0, 0.5, 1.0}) {
        const auto e = sphere.elements(c);
        for (const auto element : all_elements) CHECK(malus::is_finite(e.*element));
        CHECK(std::abs(e.b2) <= e.a1);
      }
      CHECK(sphere.extinction() >= sphere.scattering() * (1 - 1e-9));
      CHECK(std::abs(sphere.asymmetry()) <= 1);
    }
}

TEST_CASE("Mie: many angles at once are one angle after the other") {
  std::vector<double> cosines;
  for (int i = 0; i <= 100; ++i) cosines.push_back(std::cos(pi * i / 100));
  const MieSphere sphere(23.4, {1.4, 0.01});
  std::vector<Elements> sums(cosines.size(), Elements{1, 1, 1, 1, 1, 1});
  sphere.add_elements(cosines, 2 * sphere.normalization(), sums);
  for (std::size_t i = 0; i < cosines.size(); ++i)
    CHECK(
        worst_difference(sums[i], sphere.elements(cosines[i]) * 2.0 + Elements{1, 1, 1, 1, 1, 1}) <
        1e-11 * sphere.elements(1).a1);
}

TEST_CASE("Mie: a log-normal distribution is its integral by number, of cross-sections") {
  const malus::MieSizes sizes{3, 1.3};
  const Complex index(1.45, 0.001);
  const std::vector<double> cosines{1, 0.7, 0, -0.8, -1};
  const auto mean = malus::mie_mean(sizes, index, cosines);
  // Simpson's rule in the size itself.
  constexpr int steps = 4000;
  const double low = 0.3, high = 15, s = std::log(sizes.geometric_deviation);
  double extinction = 0, scattering = 0, forward = 0, number = 0;
  std::vector<Elements> elements(cosines.size());
  for (int i = 0; i <= steps; ++i) {
    const double x = low + (high - low) * i / steps, z = std::log(x / sizes.median) / s;
    const double rule = (i == 0 || i == steps ? 1 : i % 2 == 1 ? 4 : 2) * (high - low) / steps / 3;
    const double density = rule * std::exp(-z * z / 2) / (x * s * std::sqrt(2 * pi));
    const MieSphere sphere(x, index);
    number += density;
    extinction += density * x * x * sphere.extinction();
    scattering += density * x * x * sphere.scattering();
    forward += density * x * x * sphere.scattering() * sphere.asymmetry();
    for (std::size_t j = 0; j < cosines.size(); ++j)
      elements[j] += sphere.elements(cosines[j]) * (density * x * x * sphere.scattering());
  }
  CHECK(number == doctest::Approx(1).epsilon(1e-6));
  CHECK(mean.extinction == doctest::Approx(extinction).epsilon(1e-6));
  CHECK(mean.scattering == doctest::Approx(scattering).epsilon(1e-6));
  CHECK(mean.asymmetry == doctest::Approx(forward / scattering).epsilon(1e-6));
  for (std::size_t j = 0; j < cosines.size(); ++j) {
    const Elements expected = elements[j] * (1 / scattering);
    CHECK(worst_difference(mean.elements[j], expected) < 2e-6 * expected.a1);
  }

  // Six deviations beyond where x⁴ times the density is largest, four squared deviations up.
  CHECK(malus::largest_size(sizes) ==
        doctest::Approx(3 * std::exp(4 * s * s + 6 * s)).epsilon(0.05));
  for (const double narrow : {1 + 1e-15, 1 + 2e-6})
    CHECK(malus::mie_mean({3, narrow}, index, {}).scattering ==
          doctest::Approx(9 * MieSphere(3, index).scattering()));
  const auto one = malus::mie_mean({3, 1}, index, cosines);
  CHECK(worst_difference(one.elements[1], MieSphere(3, index).elements(0.7)) < 1e-12);
  CHECK(one.scattering == doctest::Approx(9 * MieSphere(3, index).scattering()));
}
