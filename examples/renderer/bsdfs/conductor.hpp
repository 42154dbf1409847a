// SPDX-License-Identifier: MIT
// A smooth conductor of complex index eta + ik, one a channel. Its front alone reflects.
#pragma once

#include "../textures/texture.hpp"
#include "sample.hpp"

namespace renderer {

struct Conductor {
  Rgb eta{0.0f}, k{1.0f};
  ColorTexture specular_reflectance{Rgb(1.0f)};

  static constexpr bool is_delta = true;
  static constexpr bool polarizes = true;

  bool sample(const SurfacePoint& point, const Vec3& known, Tracing, Sampler&,
              BsdfSample& result) const {
    const float c = glm::dot(point.normal, known);
    if (c <= 0) return false;
    result.direction = glm::normalize(reflect_about(known, point.normal));
    result.is_delta = true;
    result.pdf = result.reverse_pdf = 1;
    result.weight =
        specular_reflectance(point) * malus::fresnel_conductor(cosine(c), eta, k).mean();
    return true;
  }

  template <class R>
  MALUS_INLINE auto weight(const SurfacePoint& point, const Vec3& known, Tracing tracing,
                           const BsdfSample& sample, float factor) const {
    if constexpr (R::polarized) {
      const Flow flow(known, sample.direction, tracing);
      const auto frames = specular_frames(point.normal, flow.incident, flow.exitant);
      const float c = cosine(glm::dot(point.normal, known));
      return malus::conductor_reflection(c, eta, k, frames.enter, frames.exit) *
             (specular_reflectance(point) * factor);
    } else {
      return sample.weight * factor;
    }
  }

 private:
  static float cosine(float c) { return std::min(c, 1.0f); }
};

}  // namespace renderer
