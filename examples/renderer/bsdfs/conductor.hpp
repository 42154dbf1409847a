// SPDX-License-Identifier: MIT
// A smooth conductor of complex index eta + ik, one a channel. Its front alone reflects.
#pragma once

#include "../textures/texture.hpp"
#include "conductor_terms.hpp"
#include "sample.hpp"

namespace renderer {

struct Conductor {
  Rgb eta{0.0f}, k{1.0f};
  ColorTexture specular_reflectance{Rgb(1.0f)};

  static constexpr bool is_delta = true;
  static constexpr bool polarizes = true;

  template <class Sample>
  bool sample(const SurfacePoint& point, const Vec3& known, Tracing, Sampler&,
              Sample& result) const {
    const float c = glm::dot(point.normal, known);
    if (c <= 0) return false;
    result.direction = glm::normalize(reflect_about(known, point.normal));
    result.is_delta = true;
    result.pdf = result.reverse_pdf = 1;
    const ConductorTerms terms = conductor_terms(std::min(c, 1.0f), eta, k);
    result.weight = specular_reflectance(point) * terms.mean;
    if constexpr (std::is_same_v<Sample, PolarizedBsdfSample>) result.conductor = terms;
    return true;
  }

  template <class R>
  MALUS_INLINE auto weight(const SurfacePoint& point, const Vec3& known, Tracing tracing,
                           const BsdfSampleOf<R>& sample, float factor) const {
    if constexpr (R::polarized) {
      const Flow flow(known, sample.direction, tracing);
      return conductor_block(sample.conductor,
                             specular_frames(point.normal, flow.incident, flow.exitant)) *
             (specular_reflectance(point) * factor);
    } else {
      return sample.weight * factor;
    }
  }
};

}  // namespace renderer
