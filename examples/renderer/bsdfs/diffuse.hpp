// SPDX-License-Identifier: MIT
// An ideally diffuse surface, which depolarises completely: one value, no frame. Its front alone
// reflects.
#pragma once

#include "../core/warp.hpp"
#include "../textures/texture.hpp"
#include "sample.hpp"

namespace renderer {

struct Diffuse {
  ColorTexture reflectance{Rgb(0.5f)};

  static constexpr bool is_delta = false;
  static constexpr bool polarizes = false;

  bool sample(const SurfacePoint& point, const Vec3& known, Tracing, Sampler& sampler,
              BsdfSample& result) const {
    const Vec2 u = sampler.next_2d();
    const float cos_known = glm::dot(point.normal, known);
    if (cos_known <= 0) return false;
    const Vec3 d = square_to_cosine_hemisphere(u);
    if (d.z <= 0) return false;
    const Basis basis(point.normal);
    result.direction = d.x * basis.s + d.y * basis.t + d.z * point.normal;
    result.weight = reflectance(point);
    result.pdf = d.z / pi;
    result.reverse_pdf = cos_known / pi;
    return true;
  }

  BsdfValue value(const SurfacePoint& point, const Vec3& incident, const Vec3& exitant) const {
    const float cos_i = glm::dot(point.normal, incident), cos_o = glm::dot(point.normal, exitant);
    if (cos_i <= 0 || cos_o <= 0) return {};
    return {reflectance(point) * (1 / pi), cos_i / pi, cos_o / pi, Rgb(0.0f)};
  }

  template <class R>
  auto scattering(const SurfacePoint&, const Vec3&, const Vec3&, const BsdfValue& value) const {
    return R::depolarizer(value.m00);
  }

  template <class R>
  auto weight(const SurfacePoint&, const Vec3&, Tracing, const BsdfSample& sample,
              float factor) const {
    return R::depolarizer(sample.weight * factor);
  }
};

}  // namespace renderer
