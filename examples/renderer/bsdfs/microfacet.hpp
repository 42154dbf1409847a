// SPDX-License-Identifier: MIT
// What the rough kinds share: facets (malus/optics/microfacet.hpp) laid on a surface of world
// space.
#pragma once

#include "sample.hpp"

namespace renderer {

/// The surface's own coordinates: s and t along x and y, the normal along z.
struct LocalSpace : Basis {
  Vec3 normal;
  Vec3 from_world(const Vec3& w) const {
    return {glm::dot(w, s), glm::dot(w, t), glm::dot(w, normal)};
  }
  Vec3 to_world(const Vec3& v) const { return glm::normalize(v.x * s + v.y * t + v.z * normal); }
};

/// A rough surface. Where its roughness depends on the direction, it is along the tangent that
/// alpha_x says.
struct Facets : malus::MicrofacetDistribution<float> {
  using MicrofacetDistribution::MicrofacetDistribution;

  LocalSpace space(const SurfacePoint& point) const {
    if (!is_isotropic())
      return {Basis(point.tangent, glm::cross(point.normal, point.tangent)), point.normal};
    return {Basis(point.normal), point.normal};
  }

  // Of directions in world space.

  malus::MicrofacetLobe<float> reflection(const SurfacePoint& point, const Vec3& incident,
                                          const Vec3& exitant) const {
    if (is_isotropic()) return MicrofacetDistribution::reflection(incident, exitant, point.normal);
    const LocalSpace local = space(point);
    return MicrofacetDistribution::reflection(local.from_world(incident),
                                              local.from_world(exitant));
  }
  /// `eta`: the index on the incident side over that on the exitant one.
  malus::MicrofacetLobe<float> refraction(const SurfacePoint& point, const Vec3& incident,
                                          const Vec3& exitant, float eta) const {
    if (is_isotropic())
      return MicrofacetDistribution::refraction(incident, exitant, eta, point.normal);
    const LocalSpace local = space(point);
    return MicrofacetDistribution::refraction(local.from_world(incident), local.from_world(exitant),
                                              eta);
  }
};

/// The cosine of both directions with the normal of the facet that reflects one into the other.
inline float reflected_cosine(const Vec3& incident, const Vec3& exitant) {
  const Vec3 h = incident + exitant;
  return std::min(std::sqrt(glm::dot(h, h)) / 2, 1.0f);
}

using FacetMueller = malus::BlockMueller<Rgb, malus::incident, malus::exitant, MuellerFrame>;

/// The frames of a facet's plane of incidence: malus::frames_of_facet() of −incident and exitant,
/// but that nothing is turned around for it.
MALUS_INLINE malus::FramePair<float> facet_frames(const Vec3& incident, const Vec3& exitant) {
  Vec3 s = glm::cross(exitant, incident);
  constexpr float parallel = std::numeric_limits<float>::epsilon();
  if (!(glm::dot(s, s) > parallel)) [[unlikely]]
    s = MuellerFrame::about(-incident).x();
  return {MuellerFrame(s, glm::cross(s, incident)), MuellerFrame(s, glm::cross(exitant, s))};
}

}  // namespace renderer
