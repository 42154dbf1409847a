// SPDX-License-Identifier: MIT
// A rough conductor of complex index eta + ik, one a channel. Its front alone reflects.
#pragma once

#include "../textures/texture.hpp"
#include "microfacet.hpp"

namespace renderer {

struct RoughConductor {
  Facets facets{malus::MicrofacetShape::beckmann, 0.1f, 0.1f};
  Rgb eta{0.0f}, k{1.0f};
  ColorTexture specular_reflectance{Rgb(1.0f)};

  static constexpr bool is_delta = false;
  static constexpr bool polarizes = true;
  bool needs_tangent() const { return !facets.is_isotropic(); }

  bool sample(const SurfacePoint& point, const Vec3& known, Tracing, Sampler& sampler,
              BsdfSample& result) const {
    const Vec2 u = sampler.next_2d();
    const LocalSpace space = facets.space(point);
    const Vec3 from = space.from_world(known);
    if (from.z <= 0) return false;
    const Vec3 m = facets.sample_visible(from, u.x, u.y);
    const Vec3 to = reflect_about(from, m);
    if (to.z <= 0) return false;
    const float quarter = facets.density(m) / 4;
    const float area = facets.projected_area(to);
    result.direction = space.to_world(to);
    result.pdf = quarter / facets.projected_area(from);
    result.reverse_pdf = quarter / area;
    result.lobe = specular_reflectance(point) * (to.z / area);
    result.weight = result.lobe * reflectance(reflected_cosine(from, to));
    return result.pdf > 0;
  }

  BsdfValue value(const SurfacePoint& point, const Vec3& incident, const Vec3& exitant) const {
    const auto lobe = facets.reflection(point, incident, exitant);
    if (lobe.value <= 0) return {};
    const Rgb scale = specular_reflectance(point) * lobe.value;
    return {scale * reflectance(lobe.cosine), lobe.pdf_i, lobe.pdf_o, scale};
  }

  template <class R>
  MALUS_INLINE auto scattering(const SurfacePoint&, const Vec3& incident, const Vec3& exitant,
                               const BsdfValue& value) const {
    if constexpr (R::polarized)
      return block(incident, exitant) * value.lobe;
    else
      return value.m00;
  }

  template <class R>
  MALUS_INLINE auto weight(const SurfacePoint&, const Vec3& known, Tracing tracing,
                           const BsdfSample& sample, float factor) const {
    if constexpr (R::polarized) {
      const Flow flow(known, sample.direction, tracing);
      return block(flow.incident, flow.exitant) * (sample.lobe * factor);
    } else {
      return sample.weight * factor;
    }
  }

 private:
  /// malus::fresnel_conductor().mean() with one division where that has three: value() spends most
  /// of its time here. With q² = (η + ik)² − sin² θ, q = a + ib: R_s = (A − B)/(A + B), A = |q|² +
  /// c², B = 2ac, and R_p = R_s (C − D)/(C + D), C = |q|² c² + s⁴, D = B s², so that the mean is
  /// R_s C/(C + D). Where b is the larger of the two, a = Im q²/2b, and all is taken times b.
  Rgb reflectance(float cosine) const {
    const Rgb one(1.0f), c(cosine), c2(cosine * cosine), s2((1 - cosine) * (1 + cosine));
    const Rgb re = (eta - one) * (eta + one) + c2 - k * k, im = 2.0f * eta * k;
    const Rgb modulus = sqrt(re * re + im * im);
    const Rgb larger = sqrt(0.5f * (modulus + where_negative(re, -re, re)));
    const Rgb times = where_negative(re, larger, one);
    const Rgb a = (modulus + c2) * times, b = c * where_negative(re, im, larger + larger);
    const Rgb p = (modulus * c2 + s2 * s2) * times;
    const Rgb below = (a + b) * (p + b * s2);
    return where_negative(-below, (a - b) * p / below, Rgb(0.0f));
  }

  MALUS_INLINE FacetMueller block(const Vec3& incident, const Vec3& exitant) const {
    const auto frames = facet_frames(incident, exitant);
    return malus::conductor_reflection(reflected_cosine(incident, exitant), eta, k, frames.enter,
                                       frames.exit);
  }
};

}  // namespace renderer
