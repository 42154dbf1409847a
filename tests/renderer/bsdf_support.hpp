// SPDX-License-Identifier: MIT
// What the tests of BSDFs share: one BSDF of every kind and more, surfaces and directions to try
// them with, and whether draws follow the density that they claim, by χ².
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "bsdfs/bsdf.hpp"
#include "core/warp.hpp"

namespace bsdf_test {

using namespace renderer;
using Polarized = malus::Polarized<Rgb>;
using Unpolarized = malus::Unpolarized<Rgb>;
using malus::MicrofacetShape;

inline constexpr Tracing both_tracings[] = {Tracing::from_camera, Tracing::from_light};

struct Named {
  std::string name;
  Bsdf bsdf;
  float roughness = 1;  ///< about which directions are spread: how exact single precision can be
};

/// A BSDF of any kind.
template <class B>
Named named(std::string name, const B& b, float roughness = 1) {
  return {std::move(name), Bsdf(Bsdf::Kind(b)), roughness};
}

inline const Rgb gold_eta{0.143f, 0.375f, 1.442f}, gold_k{3.98f, 2.39f, 1.60f};

inline Named rough_conductor(MicrofacetShape shape, float ax, float ay) {
  const char* name = shape == MicrofacetShape::ggx ? "ggx conductor " : "beckmann conductor ";
  return named(name + std::to_string(ax) + " " + std::to_string(ay),
               RoughConductor{{shape, ax, ay}, gold_eta, gold_k, Rgb(0.9f, 1.0f, 0.8f)},
               std::min(ax, ay));
}
inline Named rough_dielectric(MicrofacetShape shape, float ax, float ay, float eta) {
  const char* name = shape == MicrofacetShape::ggx ? "ggx dielectric " : "beckmann dielectric ";
  return named(name + std::to_string(ax) + " " + std::to_string(ay) + " of " + std::to_string(eta),
               RoughDielectric{{shape, ax, ay}, eta, Rgb(1.0f, 0.9f, 0.8f), Rgb(0.7f, 1.0f, 0.9f)},
               std::min(ax, ay));
}
inline Named polarized_plastic(MicrofacetShape shape, float ax, float ay) {
  return named(
      "pplastic " + std::to_string(ax) + " " + std::to_string(ay),
      PolarizedPlastic{{shape, ax, ay}, 1.5f, Rgb(0.2f, 0.5f, 0.9f), Rgb(1.0f, 0.9f, 0.8f)},
      std::min(ax, ay));
}
inline Named plastic(float eta, bool nonlinear, const Rgb& base) {
  Plastic p(eta, nonlinear);
  p.diffuse_reflectance = base;
  return named("plastic of " + std::to_string(eta), p);
}

/// Of every kind that isn't discrete.
inline std::vector<Named> smooth_kinds(std::initializer_list<float> roughnesses) {
  std::vector<Named> all{named("diffuse", Diffuse{Rgb(0.3f, 0.5f, 0.9f)}),
                         plastic(1.5f, false, Rgb(0.2f, 0.5f, 0.9f)),
                         plastic(1.9f, true, Rgb(0.9f, 0.8f, 1.0f))};
  for (const auto shape : {MicrofacetShape::beckmann, MicrofacetShape::ggx}) {
    for (const float alpha : roughnesses) {
      all.push_back(rough_conductor(shape, alpha, alpha));
      all.push_back(rough_dielectric(shape, alpha, alpha, 1.5f));
      all.push_back(polarized_plastic(shape, alpha, alpha));
    }
    const float alpha = std::data(roughnesses)[0];
    all.push_back(rough_conductor(shape, alpha, 3 * alpha));
    all.push_back(rough_dielectric(shape, 2 * alpha, alpha, 1 / 1.33f));
    all.push_back(polarized_plastic(shape, 2.5f * alpha, alpha));
  }
  return all;
}

/// A surface turned at random, and a direction anywhere around it.
struct Event {
  Hit hit;
  Vec3 known;
  explicit Event(Sampler& s) {
    hit.normal = hit.geometric_normal = square_to_sphere(s.next_2d());
    const Basis basis(hit.normal);
    const float a = 2 * pi * s.next_1d();
    hit.tangent = std::cos(a) * basis.s + std::sin(a) * basis.t;
    known = square_to_sphere(s.next_2d());
  }
  /// The same surface, seen from a polar and an azimuth angle.
  void look_from(float theta_degrees, float phi_degrees) {
    const float t = theta_degrees * pi / 180, p = phi_degrees * pi / 180;
    known = direction(std::cos(t), p);
  }
  Vec3 direction(float z, float phi) const {
    const float r = std::sqrt(std::max(0.0f, 1 - z * z));
    return glm::normalize(r * std::cos(phi) * hit.tangent +
                          r * std::sin(phi) * glm::cross(hit.normal, hit.tangent) + z * hit.normal);
  }
};

inline float drawing_pdf(const Bsdf& bsdf, const Event& e, const Vec3& drawn, Tracing tracing) {
  const Flow flow(e.known, drawn, tracing);
  const auto v = bsdf.value<Polarized>(e.hit, flow.incident, flow.exitant);
  return tracing == Tracing::from_camera ? v.pdf_incident : v.pdf_exitant;
}

/// Integrates over a patch of the sphere, of z and azimuth, as finely as the function needs.
template <class F>
double integrate(const F& f, double z0, double z1, double phi0, double phi1, double tolerance,
                 int depth = 0) {
  const auto cell = [&](double za, double zb, double pa, double pb) {
    // Gauss's rule of 3 × 3 points.
    constexpr double x = 0.7745966692414834;
    constexpr double node[] = {-x, 0, x}, weight[] = {5.0 / 9, 8.0 / 9, 5.0 / 9};
    double sum = 0;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        sum += weight[i] * weight[j] *
               static_cast<double>(f(static_cast<float>((za + zb + node[i] * (zb - za)) / 2),
                                     static_cast<float>((pa + pb + node[j] * (pb - pa)) / 2)));
    return sum * (zb - za) * (pb - pa) / 4;
  };
  const double zm = (z0 + z1) / 2, pm = (phi0 + phi1) / 2;
  const double whole = cell(z0, z1, phi0, phi1);
  const double parts = cell(z0, zm, phi0, pm) + cell(zm, z1, phi0, pm) + cell(z0, zm, pm, phi1) +
                       cell(zm, z1, pm, phi1);
  if (depth >= 1 && (std::abs(whole - parts) < tolerance || depth >= 7)) return parts;
  const double rest = tolerance / 2;
  return integrate(f, z0, zm, phi0, pm, rest, depth + 1) +
         integrate(f, zm, z1, phi0, pm, rest, depth + 1) +
         integrate(f, z0, zm, pm, phi1, rest, depth + 1) +
         integrate(f, zm, z1, pm, phi1, rest, depth + 1);
}

/// Rows of z and columns of azimuth, over the whole sphere; z = 0 is between rows.
inline constexpr int rows = 16, columns = 20;
template <class F>
std::array<double, rows * columns> integrate_by_bins(const F& f, double tolerance) {
  std::array<double, rows * columns> bins{};
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c)
      bins[static_cast<std::size_t>(r * columns + c)] =
          integrate(f, -1 + 2.0 * r / rows, -1 + 2.0 * (r + 1) / rows,
                    2 * static_cast<double>(pi) * c / columns,
                    2 * static_cast<double>(pi) * (c + 1) / columns, tolerance);
  return bins;
}

struct DrawTest {
  double deviations = 0;  ///< of χ², in standard deviations of a normal distribution
  double density = 0;     ///< the density's integral
  double discrete = 0;    ///< the share of discrete draws
  int lost = 0;           ///< draws that gave no direction
  int inconsistent = 0;   ///< draws whose pdfs or weight are not what value() says
};

/// Do the directions drawn follow value()'s density, and do discrete draws and draws without a
/// direction take what it leaves of 1?
inline DrawTest test_draws(const Named& which, const Event& e, Tracing tracing, Sampler& sampler,
                           int samples = 40000) {
  DrawTest result;
  std::array<double, rows * columns> counts{};
  const Vec3 across = glm::cross(e.hit.normal, e.hit.tangent);
  double discrete = 0, chance = 0;
  for (int i = 0; i < samples; ++i) {
    BsdfSampleOf<Polarized> s;
    if (!which.bsdf.sample(e.hit, e.known, tracing, sampler, s)) {
      ++result.lost;
      continue;
    }
    if (s.is_delta) {
      ++discrete;
      chance = static_cast<double>(s.pdf);
      continue;
    }
    const float z = glm::dot(s.direction, e.hit.normal);
    const float phi =
        std::atan2(glm::dot(s.direction, across), glm::dot(s.direction, e.hit.tangent));
    const float turn = phi < 0 ? phi / (2 * pi) + 1 : phi / (2 * pi);
    const int row = std::clamp(static_cast<int>((z + 1) / 2 * rows), 0, rows - 1);
    const int column = std::clamp(static_cast<int>(turn * columns), 0, columns - 1);
    ++counts[static_cast<std::size_t>(row * columns + column)];

    const Flow flow(e.known, s.direction, tracing);
    const auto v = which.bsdf.value<Polarized>(e.hit, flow.incident, flow.exitant);
    const bool camera = tracing == Tracing::from_camera;
    const float pdf = camera ? v.pdf_incident : v.pdf_exitant;
    const float reverse = camera ? v.pdf_exitant : v.pdf_incident;
    // Near the horizon, and far down the tails, the directions' own rounding shows.
    const float tolerance = 2e-5f / (which.roughness * which.roughness) + 1e-4f;
    const auto differ = [&](float a, float b) {
      return !(std::abs(a - b) <= tolerance * (std::abs(a) + std::abs(b)) + 1e-5f);
    };
    const Rgb weight = v.m00 * (std::abs(z) / s.pdf);
    if (std::abs(z) > 1e-3f &&
        (differ(pdf, s.pdf) || differ(reverse, s.reverse_pdf) || differ(weight[0], s.weight[0]) ||
         differ(weight[1], s.weight[1]) || differ(weight[2], s.weight[2])))
      ++result.inconsistent;
  }
  const auto expected = integrate_by_bins(
      [&](float z, float phi) { return drawing_pdf(which.bsdf, e, e.direction(z, phi), tracing); },
      1e-6);
  for (const double p : expected) result.density += p;
  result.discrete = discrete / samples;

  double chi2 = 0, pool = 0, pool_expected = 0;
  int degrees = -1;
  const auto compare = [&](double n, double m) {
    if (m < 10) {
      pool += n, pool_expected += m;
      return;
    }
    chi2 += (n - m) * (n - m) / m;
    ++degrees;
  };
  for (std::size_t i = 0; i < counts.size(); ++i) compare(counts[i], expected[i] * samples);
  compare(discrete, chance * samples);
  compare(result.lost, std::max(0.0, 1 - result.density - chance) * samples);
  if (pool_expected > 1 || pool > 20)
    chi2 += (pool - pool_expected) * (pool - pool_expected) / std::max(pool_expected, 1.0),
        ++degrees;
  // Wilson & Hilferty's normal approximation.
  if (degrees > 0) {
    const double k = degrees, spread = 2 / (9 * k);
    result.deviations = (std::cbrt(chi2 / k) - (1 - spread)) / std::sqrt(spread);
  }
  return result;
}

inline bool close(const Rgb& a, const Rgb& b, float relative, float least = 1e-3f) {
  for (std::size_t i = 0; i < 3; ++i)
    if (!(std::abs(a[i] - b[i]) <= relative * (least + std::abs(a[i])))) return false;
  return true;
}

}  // namespace bsdf_test
