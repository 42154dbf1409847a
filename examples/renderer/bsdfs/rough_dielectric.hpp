// SPDX-License-Identifier: MIT
// A rough interface between two dielectrics; the normal points to the outer one. A facet reflects
// or refracts, chosen by its reflectance for unpolarised light.
#pragma once

#include "../textures/texture.hpp"
#include "microfacet.hpp"

namespace renderer {

struct RoughDielectric {
  Facets facets{malus::MicrofacetShape::beckmann, 0.1f, 0.1f};
  float eta = 1.5046f / 1.000277f;  ///< inner over outer index, not 1
  ColorTexture specular_reflectance{Rgb(1.0f)}, specular_transmittance{Rgb(1.0f)};

  static constexpr bool is_delta = false;
  static constexpr bool polarizes = true;
  bool needs_tangent() const { return !facets.is_isotropic(); }

  bool sample(const SurfacePoint& point, const Vec3& known, Tracing tracing, Sampler& sampler,
              BsdfSample& result) const {
    const Vec2 u = sampler.next_2d();
    const float choice = sampler.next_1d();
    const LocalSpace space = facets.space(point);
    Vec3 from = space.from_world(known);
    if (from.z == 0) return false;
    const float up = std::copysign(1.0f, from.z);
    from.z = std::abs(from.z);
    const float behind = index_behind(up);
    const Vec3 m = facets.sample_visible(from, u.x, u.y);
    const float cosine = std::clamp(glm::dot(from, m), 0.0f, 1.0f);
    const float reflectance = malus::fresnel_dielectric(cosine, behind).mean();
    const bool drawn = choice < reflectance
                           ? reflect(point, from, m, reflectance, result)
                           : refract(point, from, m, cosine, behind, 1 - reflectance, result);
    if (!drawn || !(result.pdf > 0)) return false;
    // Refraction conserves radiance over n², and power.
    if (tracing == Tracing::from_camera) result.weight /= result.eta * result.eta;
    result.direction.z *= up;
    result.direction = space.to_world(result.direction);
    return true;
  }

  template <class Value>
  Value value(const SurfacePoint& point, const Vec3& incident, const Vec3& exitant) const {
    const float cos_i = glm::dot(point.normal, incident), cos_o = glm::dot(point.normal, exitant);
    const bool reflects = cos_i * cos_o > 0;
    const float behind = index_behind(cos_i);
    const auto lobe = reflects ? reflection(point, incident, exitant, cos_i < 0)
                               : facets.refraction(point, incident, exitant, 1 / behind);
    if (lobe.value <= 0) return {};
    const auto fresnel = terms(reflects, lobe.cosine, behind);
    const float share = fresnel.mean();
    const Rgb scale = (reflects ? specular_reflectance : specular_transmittance)(point)*lobe.value;
    return with_terms<Value>({scale * share, lobe.pdf_i * share, lobe.pdf_o * share, scale},
                             InterfaceTerms{fresnel, {}, {}});
  }

  template <class R>
  MALUS_INLINE auto scattering(const SurfacePoint&, const Vec3& incident, const Vec3& exitant,
                               const BsdfValueOf<R>& value) const {
    if constexpr (R::polarized)
      return block(value.terms.facet, incident, exitant, value.lobe);
    else
      return value.m00;
  }

  template <class R>
  MALUS_INLINE auto weight(const SurfacePoint& point, const Vec3& known, Tracing tracing,
                           const BsdfSample& sample, float factor) const {
    if constexpr (R::polarized) {
      const Flow flow(known, sample.direction, tracing);
      const auto fresnel = facet_terms(point, flow.incident, flow.exitant);
      const float share = fresnel.mean();
      return block(fresnel, flow.incident, flow.exitant,
                   share > 0 ? sample.weight * (factor / share) : Rgb(0.0f));
    } else {
      return sample.weight * factor;
    }
  }

 private:
  malus::MicrofacetLobe<float> reflection(const SurfacePoint& point, const Vec3& incident,
                                          const Vec3& exitant, bool from_below) const {
    if (!from_below) return facets.reflection(point, incident, exitant);
    // A plane's mirror image of it all.
    const auto up = [&](const Vec3& w) { return w - 2 * glm::dot(w, point.normal) * point.normal; };
    return facets.reflection(point, up(incident), up(exitant));
  }

  /// The index on the other side over that on the side that `up` is the sign of.
  float index_behind(float up) const { return up > 0 ? eta : 1 / eta; }

  /// Of reflection from the side before `behind`; of refraction from the optically thinner side.
  static malus::FresnelTerms<float> terms(bool reflects, float cosine, float behind) {
    return reflects ? malus::fresnel_dielectric(cosine, behind)
                    : malus::fresnel_transmission(cosine, std::max(behind, 1 / behind));
  }

  // Of a known direction with z > 0 and a facet that it sees; the direction drawn is local.

  bool reflect(const SurfacePoint& point, const Vec3& from, const Vec3& m, float chance,
               BsdfSample& result) const {
    const Vec3 to = reflect_about(from, m);
    if (to.z <= 0) return false;
    const float area = facets.projected_area(to);
    const float density = chance * facets.density(m) / 4;
    result.direction = to;
    result.pdf = density / facets.projected_area(from);
    result.reverse_pdf = density / area;
    result.eta = 1;
    result.weight = specular_reflectance(point) * (to.z / area);
    return true;
  }

  bool refract(const SurfacePoint& point, const Vec3& from, const Vec3& m, float cosine,
               float behind, float chance, BsdfSample& result) const {
    const float refracted = malus::refracted_cosine(cosine, behind);
    if (refracted <= 0) return false;
    const Vec3 to = (cosine / behind - refracted) * m - from / behind;
    if (to.z >= 0) return false;
    const float area = facets.projected_area({to.x, to.y, -to.z});
    const float half_length = cosine - behind * refracted;
    const float density =
        chance * facets.density(m) * cosine * refracted / (half_length * half_length);
    result.direction = to;
    result.pdf = density * behind * behind / facets.projected_area(from);
    result.reverse_pdf = density / area;
    result.eta = behind;
    result.weight = specular_transmittance(point) * (-to.z / area);
    return true;
  }

  malus::FresnelTerms<float> facet_terms(const SurfacePoint& point, const Vec3& incident,
                                         const Vec3& exitant) const {
    const float cos_i = glm::dot(point.normal, incident), cos_o = glm::dot(point.normal, exitant);
    const float behind = index_behind(cos_i);
    const bool reflects = cos_i * cos_o > 0;
    float cosine = reflected_cosine(incident, exitant);
    if (!reflects) {
      const Vec3 h = incident + behind * exitant;
      const Vec3& thinner = behind > 1 ? incident : exitant;
      cosine = std::min(std::abs(glm::dot(thinner, h)) / glm::length(h), 1.0f);
    }
    return terms(reflects, cosine, behind);
  }

  /// The facet's Fresnel block, scaled.
  MALUS_INLINE static FacetMueller block(const malus::FresnelTerms<float>& fresnel,
                                         const Vec3& incident, const Vec3& exitant,
                                         const Rgb& scale) {
    const auto frames = facet_frames(incident, exitant);
    return malus::fresnel_block<Rgb>(fresnel, frames.enter, frames.exit) * scale;
  }
};

}  // namespace renderer
