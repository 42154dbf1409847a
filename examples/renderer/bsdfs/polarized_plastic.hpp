// SPDX-License-Identifier: MIT
// Facets of a dielectric over a diffuse base (Baek et al. 2018, "Simultaneous acquisition of
// polarimetric SVBRDF and normals"): the coat's reflection is rough, the light of the base goes
// through the coat as if it were smooth, once in and once out. Its front alone reflects.
#pragma once

#include "../core/warp.hpp"
#include "../textures/texture.hpp"
#include "microfacet.hpp"
#include "plastic_base.hpp"

namespace renderer {

struct PolarizedPlastic {
  Facets facets{malus::MicrofacetShape::beckmann, 0.1f, 0.1f};
  float eta = 1.49f / 1.000277f;  ///< inner over outer index
  ColorTexture diffuse_reflectance{Rgb(0.5f)}, specular_reflectance{Rgb(1.0f)};

  static constexpr bool is_delta = false;
  static constexpr bool polarizes = true;
  bool needs_tangent() const { return !facets.is_isotropic(); }

  template <class Sample>
  bool sample(const SurfacePoint& point, const Vec3& known, Tracing tracing, Sampler& sampler,
              Sample& result) const {
    constexpr bool keeps = std::is_same_v<Sample, PolarizedBsdfSample>;
    using Value = std::conditional_t<keeps, PolarizedBsdfValue, BsdfValue>;
    const float choice = sampler.next_1d();
    const Vec2 u = sampler.next_2d();
    const LocalSpace space = facets.space(point);
    const Vec3 from = space.from_world(known);
    if (from.z <= 0) return false;
    const float share = coat_share(1 - transmission(from.z).mean(), specular_reflectance(point),
                                   diffuse_reflectance(point));
    const Vec3 to = choice < share ? reflect_about(from, facets.sample_visible(from, u.x, u.y))
                                   : square_to_cosine_hemisphere(u);
    if (to.z <= 0) return false;
    const Vec3 drawn = space.to_world(to);
    result.direction = by_components(drawn);
    const Flow flow(known, drawn, tracing);
    const auto v = value<Value>(point, flow.incident, flow.exitant);
    const bool from_camera = tracing == Tracing::from_camera;
    result.pdf = from_camera ? v.pdf_incident : v.pdf_exitant;
    result.reverse_pdf = from_camera ? v.pdf_exitant : v.pdf_incident;
    if (!(result.pdf > 0)) return false;
    const float factor = glm::dot(point.normal, drawn) / result.pdf;
    result.weight = v.m00 * factor;
    result.lobe = v.lobe * factor;
    if constexpr (keeps) result.terms = v.terms;
    return true;
  }

  template <class Value>
  MALUS_INLINE Value value(const SurfacePoint& point, const Vec3& incident,
                           const Vec3& exitant) const {
    const float cos_i = glm::dot(point.normal, incident), cos_o = glm::dot(point.normal, exitant);
    if (cos_i <= 0 || cos_o <= 0) return {};
    const auto lobe = facets.reflection(point, incident, exitant);
    const Rgb coat = specular_reflectance(point), base = diffuse_reflectance(point);
    const InterfaceTerms terms{malus::fresnel_dielectric(lobe.cosine, eta),
                               InterfaceTerms::passage(transmission(cos_i)),
                               InterfaceTerms::passage(transmission(cos_o))};
    const float in = terms.in.mean, out = terms.out.mean;
    const float share_i = coat_share(1 - out, coat, base), share_o = coat_share(1 - in, coat, base);
    const Rgb scale = coat * lobe.value;
    return with_terms<Value>({scale * terms.facet.mean() + base * (in * out / pi),
                              share_i * lobe.pdf_i + (1 - share_i) * cos_i / pi,
                              share_o * lobe.pdf_o + (1 - share_o) * cos_o / pi, scale},
                             terms);
  }

  template <class R>
  MALUS_INLINE auto scattering(const SurfacePoint& point, const Vec3& incident, const Vec3& exitant,
                               const BsdfValueOf<R>& value) const {
    if constexpr (R::polarized)
      return matrix(point, incident, exitant, value.terms, value.lobe,
                    diffuse_reflectance(point) * (1 / pi));
    else
      return value.m00;
  }

  template <class R>
  MALUS_INLINE auto weight(const SurfacePoint& point, const Vec3& known, Tracing tracing,
                           const BsdfSampleOf<R>& sample, float factor) const {
    if constexpr (R::polarized) {
      const Flow flow(known, sample.direction, tracing);
      const float share = glm::dot(point.normal, sample.direction) * factor / (pi * sample.pdf);
      return matrix(point, flow.incident, flow.exitant, sample.terms, sample.lobe * factor,
                    diffuse_reflectance(point) * share);
    } else {
      return sample.weight * factor;
    }
  }

 private:
  /// The sum of coat and base in the frames of the coat's facet.
  MALUS_INLINE static CoatOverBase matrix(const SurfacePoint& point, const Vec3& incident,
                                          const Vec3& exitant, const InterfaceTerms& terms,
                                          const Rgb& coat, const Rgb& base) {
    return {terms.facet, coat, facet_frames(incident, exitant),
            BasePolarization(point.normal, incident, exitant, terms.in, terms.out), base};
  }

  malus::FresnelTerms<float> transmission(float c) const {
    return malus::fresnel_transmission(std::min(c, 1.0f), eta);
  }
};

}  // namespace renderer
