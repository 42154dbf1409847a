// SPDX-License-Identifier: MIT
// A rough conductor of complex index eta + ik, one a channel. Its front alone reflects.
#pragma once

#include "../textures/texture.hpp"
#include "conductor_terms.hpp"
#include "microfacet.hpp"

namespace renderer {

struct RoughConductor {
  Facets facets{malus::MicrofacetShape::beckmann, 0.1f, 0.1f};
  Rgb eta{0.0f}, k{1.0f};
  ColorTexture specular_reflectance{Rgb(1.0f)};

  static constexpr bool is_delta = false;
  static constexpr bool polarizes = true;
  bool needs_tangent() const { return !facets.is_isotropic(); }

  template <class Sample>
  bool sample(const SurfacePoint& point, const Vec3& known, Tracing, Sampler& sampler,
              Sample& result) const {
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
    const ConductorTerms terms = conductor_terms(reflected_cosine(from, to), eta, k);
    result.weight = result.lobe * terms.mean;
    if constexpr (std::is_same_v<Sample, PolarizedBsdfSample>) result.conductor = terms;
    return result.pdf > 0;
  }

  template <class Value>
  Value value(const SurfacePoint& point, const Vec3& incident, const Vec3& exitant) const {
    const auto lobe = facets.reflection(point, incident, exitant);
    if (lobe.value <= 0) return {};
    const ConductorTerms terms = conductor_terms(lobe.cosine, eta, k);
    const Rgb scale = specular_reflectance(point) * lobe.value;
    return with_terms<Value>({scale * terms.mean, lobe.pdf_i, lobe.pdf_o, scale}, terms);
  }

  template <class R>
  MALUS_INLINE auto scattering(const SurfacePoint&, const Vec3& incident, const Vec3& exitant,
                               const BsdfValueOf<R>& value) const {
    if constexpr (R::polarized)
      return conductor_block(value.conductor, facet_frames(incident, exitant)) * value.lobe;
    else
      return value.m00;
  }

  template <class R>
  MALUS_INLINE auto weight(const SurfacePoint&, const Vec3& known, Tracing tracing,
                           const BsdfSampleOf<R>& sample, float factor) const {
    if constexpr (R::polarized) {
      const Flow flow(known, sample.direction, tracing);
      return conductor_block(sample.conductor, facet_frames(flow.incident, flow.exitant)) *
             (sample.lobe * factor);
    } else {
      return sample.weight * factor;
    }
  }
};

}  // namespace renderer
