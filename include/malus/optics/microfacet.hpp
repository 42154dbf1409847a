// SPDX-License-Identifier: MIT
// Torrance–Sparrow scattering: a rough surface as many small mirrors or refracting facets, each of
// which polarises as Fresnel says (Walter et al. 2007, "Microfacet models for refraction through
// rough surfaces"; Heitz 2014, "Understanding the masking-shadowing function").
//
// Directions point away from the surface, in local coordinates with the surface's normal along z:
// wi to where light comes from, wo to where it goes. A facet of normal m, the half vector of the
// two, turns light of one into the other; how many there are is D(m), how many of them are seen is
// Smith's G = G1(wi) G1(wo). The Mueller matrix is the lobe below, a number, times Fresnel's block
// at the facet, in the frames of the facet's plane of incidence.
//
// No trigonometry but in the drawing of facets, no normalised half vector, since D is homogeneous,
// and no division by cosines: cos/G1, the facets' projected area, is not 0 at grazing directions.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <malus/optics/fresnel.hpp>

namespace malus {

enum class MicrofacetShape {
  beckmann,  ///< of Gaussian slopes
  ggx,       ///< of long tails: Trowbridge & Reitz 1975
};

/// What facets do with a pair of directions, but for the Fresnel factor; all 0 where no facet turns
/// one into the other.
template <std::floating_point T>
struct MicrofacetLobe {
  T value = 0;   ///< the BSDF over the facets' reflectance or transmittance
  T pdf_i = 0;   ///< by solid angle, of wi by way of a facet drawn among those visible from wo
  T pdf_o = 0;   ///< of wo by way of a facet drawn among those visible from wi
  T cosine = 0;  ///< with the facet's normal, of both; in refraction, of the optically thinner side
};

namespace detail {

/// The inverse of erf, to 3e-6 in float (Giles 2010, "Approximating the erfinv function"), polished
/// by Newton's method in wider types. Arguments that round to ±1 count as the next number within.
template <std::floating_point T>
T inverse_erf(T x) {
  constexpr T limit = 1 - std::numeric_limits<T>::epsilon() / 2;
  x = std::clamp(x, -limit, limit);
  constexpr std::array<double, 9> centre{2.81022636e-08,  3.43273939e-07, -3.5233877e-06,
                                         -4.39150654e-06, 0.00021858087,  -0.00125372503,
                                         -0.00417768164,  0.246640727,    1.50140941};
  constexpr std::array<double, 9> tail{-0.000200214257, 0.000100950558, 0.00134934322,
                                       -0.00367342844,  0.00573950773,  -0.0076224613,
                                       0.00943887047,   1.00167406,     2.83297682};
  const T w = -std::log((1 - x) * (1 + x));
  const bool central = w < 5;
  const T z = central ? w - T(2.5) : std::sqrt(w) - 3;
  T p = 0;
  for (const double c : central ? centre : tail) p = p * z + static_cast<T>(c);
  T y = p * x;
  if constexpr (sizeof(T) > 4)
    for (int i = 0; i < 2; ++i)
      y -= (std::erf(y) - x) * std::exp(y * y) / (2 * std::numbers::inv_sqrtpi_v<T>);
  return y;
}

/// a/G1 of Gaussian slopes, (a(1 + erf a) + exp(−a²)/√π)/2, where a = cot θ/α. In float by a
/// rational function that differs by less than 1e-6 (fitted for Malus).
template <std::floating_point T>
T gaussian_slope_over_masking(T a) {
  if constexpr (sizeof(T) > 4) {
    return (a * (1 + std::erf(a)) + std::exp(-a * a) * std::numbers::inv_sqrtpi_v<T>) / 2;
  } else {
    if (a >= T(3.2)) return a;
    const T p = T(3.5449097) +
                a * (T(0.14066469) + a * (T(1.02711997) + a * (T(0.12246201) + a * T(0.11089486))));
    const T q =
        1 +
        a * (T(1.81219399) +
             a * (T(1.35914525) + a * (T(0.59322309) + a * (T(0.20054625) + a * T(0.10522531)))));
    return q / p;
  }
}

/// The slope s of a facet along the plane of a direction at θ, drawn among those visible from
/// there: density ∝ (cos θ − s sin θ) exp(−s²), s < cot θ. Inverts the cumulative distribution as a
/// function of y = erf s, in which it is concave and nearly straight, by Halley's method, from the
/// solution for grazing light fitted to the interval (Jakob 2014, "An improved visible normal
/// sampling routine for the Beckmann distribution").
template <std::floating_point T>
T visible_gaussian_slope(T cos_theta, T sin_theta, T u) {
  constexpr T inv_sqrt_pi = std::numbers::inv_sqrtpi_v<T>;
  constexpr T least = std::numeric_limits<T>::epsilon();
  u = std::max(u, least);
  const T cot = cos_theta / std::max(sin_theta, std::numeric_limits<T>::min());
  const T top = std::erf(cot), weight = sin_theta * inv_sqrt_pi;
  const T target = u * (cos_theta * (1 + top) + weight * std::exp(-cot * cot));
  T y = -1 + (1 + top) * std::erfc(std::sqrt(-std::log(u)));
  T s = inverse_erf(y);
  // In float, two steps leave 5e-6 of u; a fixed number is faster than a test for convergence.
  constexpr int steps = sizeof(T) > 4 ? 6 : 2;
  for (int i = 0; i < steps; ++i) {
    const T bell = std::exp(-s * s);
    const T excess = cos_theta * (1 + y) + weight * bell - target;
    const T slope = std::max(cos_theta - s * sin_theta, least);
    const T bend = sin_theta / (4 * inv_sqrt_pi * std::max(bell, std::numeric_limits<T>::min()));
    const T divisor = std::max(slope * slope + excess * bend, slope * slope / 2);
    y = std::clamp(y - excess * slope / divisor, -1 + least, top);
    s = inverse_erf(y);
  }
  return s;
}

}  // namespace detail

/// The facets of a surface: shape and roughness of their slopes' distribution, along x and y.
template <std::floating_point T>
class MicrofacetDistribution {
 public:
  using scalar_type = T;
  using vector = glm::vec<3, T>;

  /// Roughnesses α > 0: of Gaussian slopes, √2 times their standard deviation.
  MicrofacetDistribution(MicrofacetShape shape, T alpha_x, T alpha_y)
      : shape_(shape),
        alpha_x_(alpha_x),
        alpha_y_(alpha_y),
        inverse_x_(1 / alpha_x),
        inverse_y_(1 / alpha_y),
        scale_(std::numbers::inv_pi_v<T> * inverse_x_ * inverse_y_) {}

  MicrofacetShape shape() const { return shape_; }
  T alpha_x() const { return alpha_x_; }
  T alpha_y() const { return alpha_y_; }
  bool is_isotropic() const { return alpha_x_ == alpha_y_; }

  /// D(m): facets' area by solid angle of their normals, on a unit of the surface's area. m is of
  /// any length, m.z > 0.
  T density(const vector& m) const {
    return quotient(density_of(across_slopes(m), m.z, glm::dot(m, m)));
  }

  /// The area of the facets that are seen from v, on a unit of the surface's area, projected along
  /// v: v.z/G1(v), with Smith's masking G1. Not 0 at grazing directions. v is of unit length, v.z
  /// > 0.
  T projected_area(const vector& v) const {
    return area_of(square(alpha_x_ * v.x) + square(alpha_y_ * v.y), v.z);
  }
  T masking(const vector& v) const { return v.z / projected_area(v); }

  /// The density of sample_visible(), by solid angle: D G1 max(0, v·m)/v.z, of unit m.
  T visible_density(const vector& v, const vector& m) const {
    return density(m) * std::max(glm::dot(v, m), T(0)) / projected_area(v);
  }

  /// The unit normal of a facet, drawn among those that are seen from a unit v, v.z > 0, by two
  /// uniform numbers in [0, 1). Squeezed by the roughnesses, all surfaces are one of roughness 1.
  vector sample_visible(const vector& v, T u1, T u2) const {
    const vector w = glm::normalize(vector(alpha_x_ * v.x, alpha_y_ * v.y, v.z));
    const vector m =
        shape_ == MicrofacetShape::ggx ? visible_ggx(w, u1, u2) : visible_beckmann(w, u1, u2);
    return glm::normalize(vector(alpha_x_ * m.x, alpha_y_ * m.y, m.z));
  }

  /// D G/(4 cos cos) and what belongs to it, of reflection; wi.z > 0, wo.z > 0.
  MicrofacetLobe<T> reflection(const vector& wi, const vector& wo) const {
    if (!(wi.z > 0) || !(wo.z > 0)) return {};
    const vector h = wi + wo;
    const T length2 = glm::dot(h, h);
    return reflection_of(density_of(across_slopes(h), h.z, length2), length2, projected_area(wi),
                         projected_area(wo));
  }

  /// The same for isotropic facets on a surface of unit normal n: they need no local coordinates.
  MicrofacetLobe<T> reflection(const vector& wi, const vector& wo, const vector& n) const {
    const T iz = glm::dot(wi, n), oz = glm::dot(wo, n);
    if (!(iz > 0) || !(oz > 0)) return {};
    const vector h = wi + wo;
    const T length2 = glm::dot(h, h);
    return reflection_of(density_about(h, n, iz + oz, length2), length2, area_about(iz),
                         area_about(oz));
  }

  /// The same of refraction; wi and wo are on different sides, and eta is the index on wi's side
  /// over that on wo's. The value is of radiance, which refraction into a denser medium condenses:
  /// value(wo, wi, 1/eta) = eta² value(wi, wo, eta).
  MicrofacetLobe<T> refraction(const vector& wi, const vector& wo, T eta) const {
    if (!(wi.z * wo.z < 0)) return {};
    const T up = wi.z > 0 ? T(1) : T(-1);
    vector h = eta * wi + wo;
    if (up * h.z < 0) h = -h;
    const T length2 = glm::dot(h, h);
    return refraction_of(density_of(across_slopes(h), up * h.z, length2), length2, glm::dot(wi, h),
                         -glm::dot(wo, h), projected_area({wi.x, wi.y, up * wi.z}),
                         projected_area({wo.x, wo.y, -up * wo.z}), eta);
  }

  MicrofacetLobe<T> refraction(const vector& wi, const vector& wo, T eta, const vector& n) const {
    const T iz = glm::dot(wi, n), oz = glm::dot(wo, n);
    if (!(iz * oz < 0)) return {};
    const T up = iz > 0 ? T(1) : T(-1);
    vector h = eta * wi + wo;
    T hz = up * (eta * iz + oz);
    if (hz < 0) h = -h, hz = -hz;
    const T length2 = glm::dot(h, h);
    return refraction_of(density_about(h, n, up * hz, length2), length2, glm::dot(wi, h),
                         -glm::dot(wo, h), area_about(up * iz), area_about(-up * oz), eta);
  }

 private:
  static constexpr T negligible = sizeof(T) == 4 ? T(80) : T(600);

  static constexpr T square(T x) { return x * x; }

  /// A number over another one: divided last, together with what else divides.
  struct Fraction {
    T above = 0, below = 1;
  };
  static T quotient(const Fraction& f) { return f.above / f.below; }

  T across_slopes(const vector& m) const {
    return square(m.x * inverse_x_) + square(m.y * inverse_y_);
  }

  /// D of a facet's normal of any length, from its squared components across, in units of the
  /// roughness, and its z.
  Fraction density_of(T across, T z, T length2) const {
    const T z2 = z * z, squeezed2 = across + z2;
    if (!(z > 0) || !(z2 * z2 > std::numeric_limits<T>::min())) return {};
    if (shape_ == MicrofacetShape::ggx) return {scale_ * square(length2), square(squeezed2)};
    // Where exp is next to nothing, the rest may be infinite.
    if (!(across < negligible * z2)) return {};
    return {scale_ * std::exp(-across / z2) * square(length2), square(z2)};
  }
  T area_of(T across, T z) const {
    if (shape_ == MicrofacetShape::ggx) return (z + std::sqrt(z * z + across)) / 2;
    const T width = std::sqrt(across);
    // Seen nearly along the normal, everything is visible.
    if (!(width > z * (1 / T(64)))) return z;
    return width * detail::gaussian_slope_over_masking(z / width);
  }
  Fraction density_about(const vector& h, const vector& n, T hz, T length2) const {
    const vector across = h - hz * n;
    return density_of(glm::dot(across, across) * square(inverse_x_), std::abs(hz), length2);
  }
  T area_about(T z) const { return area_of(square(alpha_x_) * std::max(1 - z * z, T(0)), z); }

  static MicrofacetLobe<T> reflection_of(const Fraction& density, T length2, T area_i, T area_o) {
    const T value = density.above / (4 * density.below * area_i * area_o);
    return {value, value * area_i, value * area_o, std::min(std::sqrt(length2) / 2, T(1))};
  }
  static MicrofacetLobe<T> refraction_of(const Fraction& density, T length2, T ih, T oh, T area_i,
                                         T area_o, T eta) {
    if (!(ih > 0) || !(oh > 0)) return {};
    // (eta i·m + o·m)² = |h|², the denominator of the change of solid angle.
    const T value =
        density.above * (ih / length2) * (oh / length2) / (density.below * area_i * area_o);
    const T cosine = (eta > 1 ? oh : ih) / std::sqrt(length2);
    return {value, value * area_i * eta * eta, value * area_o, std::min(cosine, T(1))};
  }

  /// Dupuy & Benyoub 2023, "Sampling visible GGX normals with spherical caps": w reflected by the
  /// facets of a hemisphere covers a spherical cap evenly.
  static vector visible_ggx(const vector& w, T u1, T u2) {
    const T phi = 2 * std::numbers::pi_v<T> * u1;
    const T above = (1 - u2) * (1 + w.z), z = above - w.z;
    const T r = std::sqrt(std::max((1 - z) * (1 + z), T(0)));
    return {w.x + r * std::cos(phi), w.y + r * std::sin(phi), above};
  }

  /// Heitz & d'Eon 2014: the slope across the plane of w doesn't know w.
  static vector visible_beckmann(const vector& w, T u1, T u2) {
    const T sin_theta = std::sqrt(w.x * w.x + w.y * w.y);
    const T along = detail::visible_gaussian_slope(w.z, sin_theta, u1);
    const T across = detail::inverse_erf(2 * u2 - 1);
    const T cos_phi = sin_theta > 0 ? w.x / sin_theta : T(1);
    const T sin_phi = sin_theta > 0 ? w.y / sin_theta : T(0);
    return {-(cos_phi * along - sin_phi * across), -(sin_phi * along + cos_phi * across), 1};
  }

  MicrofacetShape shape_;
  T alpha_x_, alpha_y_;
  T inverse_x_, inverse_y_, scale_;
};

/// The frames that scattering by a facet is mirror-symmetric in: the common axis s = h × ω is
/// perpendicular to both directions of propagation, of reflection and refraction alike, and so
/// along their product; its axes are as long as that and not normalised, since rotations need no
/// more. Where the directions are parallel, every s will do.
template <std::floating_point T, Vector3 D>
FramePair<T> frames_of_facet(const D& in, const D& out) {
  const auto a = detail::to_vec3<T>(in), b = detail::to_vec3<T>(out);
  glm::vec<3, T> s = glm::cross(a, b);
  constexpr T parallel = std::numeric_limits<T>::epsilon();
  if (!(glm::dot(s, s) > parallel)) [[unlikely]]
    s = Frame<T>::about(a).x();
  return frames_with_common_axis<T>(a, b, s);
}

/// The Mueller BRDF of a rough conductor of relative complex index eta + ik, in the coordinates of
/// the facets; nothing below the surface.
template <SpectralValue V>
BlockMueller<V, incident, exitant, Frame<scalar_t<V>>> conductor_facets(
    const MicrofacetDistribution<scalar_t<V>>& facets, const glm::vec<3, scalar_t<V>>& wi,
    const glm::vec<3, scalar_t<V>>& wo, const V& eta, const V& k) {
  const auto frames = frames_of_facet<scalar_t<V>>(-wi, wo);
  const auto lobe = facets.reflection(wi, wo);
  return conductor_reflection(lobe.cosine, eta, k, frames.enter, frames.exit) * lobe.value;
}

/// The Mueller BSDF of a rough interface between dielectrics, eta the index below over that above:
/// reflection on both sides, and refraction (of radiance).
template <SpectralValue V>
BlockMueller<V, incident, exitant, Frame<scalar_t<V>>> dielectric_facets(
    const MicrofacetDistribution<scalar_t<V>>& facets, const glm::vec<3, scalar_t<V>>& wi,
    const glm::vec<3, scalar_t<V>>& wo, scalar_t<V> eta) {
  using T = scalar_t<V>;
  const auto frames = frames_of_facet<T>(-wi, wo);
  const bool above = wi.z > 0;
  if ((wo.z > 0) == above) {
    const T up = above ? T(1) : T(-1);
    const auto lobe = facets.reflection({wi.x, wi.y, up * wi.z}, {wo.x, wo.y, up * wo.z});
    return dielectric_reflection<V>(lobe.cosine, above ? eta : 1 / eta, frames.enter, frames.exit) *
           lobe.value;
  }
  const auto lobe = facets.refraction(wi, wo, above ? 1 / eta : eta);
  return dielectric_transmission<V>(lobe.cosine, std::max(eta, 1 / eta), frames.enter,
                                    frames.exit) *
         lobe.value;
}

}  // namespace malus
