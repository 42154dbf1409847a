// SPDX-License-Identifier: MIT
// An ideally diffuse surface, which depolarises completely: one value, no frame. Its front alone
// reflects.
#pragma once

#include "../core/warp.hpp"
#include "sample.hpp"

namespace renderer {

struct Diffuse {
  Rgb reflectance{0.5f};

  static constexpr bool is_delta = false;
  static constexpr bool polarizes = false;

  bool sample(const Hit& hit, const Vec3& exitant, Sampler& sampler, BsdfSample& result) const {
    const Vec2 u = sampler.next_2d();
    if (glm::dot(hit.normal, exitant) <= 0) return false;
    const Vec3 d = square_to_cosine_hemisphere(u);
    if (d.z <= 0) return false;
    const Basis basis(hit.normal);
    result.incident = glm::normalize(d.x * basis.s + d.y * basis.t + d.z * hit.normal);
    result.weight = reflectance;
    result.pdf = d.z / pi;
    return true;
  }

  float pdf(const Hit& hit, const Vec3& incident, const Vec3& exitant) const {
    const float cos_i = glm::dot(hit.normal, incident);
    return cos_i > 0 && glm::dot(hit.normal, exitant) > 0 ? cos_i / pi : 0.0f;
  }

  Rgb m00(const Hit& hit, const Vec3& incident, const Vec3& exitant) const {
    const bool reflects = glm::dot(hit.normal, incident) > 0 && glm::dot(hit.normal, exitant) > 0;
    return reflects ? reflectance / pi : Rgb(0.0f);
  }

  template <class R>
  typename R::Scattering evaluate(const Hit& hit, const Vec3& incident, const Vec3& exitant) const {
    return R::depolarizer(m00(hit, incident, exitant));
  }

  template <class R>
  typename R::Scattering weight(const Hit&, const Vec3&, const BsdfSample& sample) const {
    return R::depolarizer(sample.weight);
  }
};

}  // namespace renderer
