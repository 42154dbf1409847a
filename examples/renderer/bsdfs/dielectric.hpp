// SPDX-License-Identifier: MIT
// A smooth interface between two dielectrics; the normal points to the outer one. Reflection or
// refraction is chosen by the reflectance for unpolarised light, which is the same from both sides
// of a refraction.
#pragma once

#include "../textures/texture.hpp"
#include "sample.hpp"

namespace renderer {

struct Dielectric {
  float eta = 1.5046f / 1.000277f;  ///< inner over outer index
  ColorTexture specular_reflectance{Rgb(1.0f)}, specular_transmittance{Rgb(1.0f)};

  static constexpr bool is_delta = true;
  static constexpr bool polarizes = true;

  bool sample(const SurfacePoint& point, const Vec3& known, Tracing tracing, Sampler& sampler,
              BsdfSample& result) const {
    const Side side(*this, point, known);
    const float reflectance = malus::fresnel_dielectric(side.cosine, side.eta).mean();
    result.is_delta = true;
    if (sampler.next_1d() < reflectance) {
      result.direction = glm::normalize(reflect_about(known, side.normal));
      result.pdf = result.reverse_pdf = reflectance;
      result.weight = specular_reflectance(point);
      return true;
    }
    const float refracted = malus::refracted_cosine(side.cosine, side.eta);
    if (refracted <= 0) return false;
    const float inverse = 1 / side.eta;
    result.direction =
        glm::normalize((side.cosine * inverse - refracted) * side.normal - known * inverse);
    result.pdf = result.reverse_pdf = 1 - reflectance;
    result.eta = side.eta;
    // Refraction conserves radiance over n², and power.
    result.weight = specular_transmittance(point);
    if (tracing == Tracing::from_camera) result.weight *= Rgb(inverse * inverse);
    return true;
  }

  template <class R>
  MALUS_INLINE auto weight(const SurfacePoint& point, const Vec3& known, Tracing tracing,
                           const BsdfSample& sample, float factor) const {
    if constexpr (R::polarized) {
      const Side side(*this, point, known);
      const Flow flow(known, sample.direction, tracing);
      const bool reflected = glm::dot(side.normal, sample.direction) > 0;
      const auto frames = specular_frames(side.normal, flow.incident, flow.exitant);
      const auto terms = reflected ? malus::fresnel_dielectric(side.cosine, side.eta)
                                   : malus::fresnel_transmission(side.cosine, side.eta);
      return malus::fresnel_block<Rgb>(terms, frames.enter, frames.exit) *
             (sample.weight * (factor / sample.pdf));
    } else {
      return sample.weight * factor;
    }
  }

 private:
  /// The interface as the known direction sees it: the normal on its side, and the index behind it
  /// over that before it.
  struct Side {
    Vec3 normal;
    float cosine, eta;
    Side(const Dielectric& d, const SurfacePoint& point, const Vec3& known) {
      const float c = glm::dot(point.normal, known);
      normal = c >= 0 ? point.normal : -point.normal;
      cosine = std::min(std::abs(c), 1.0f);
      eta = c >= 0 ? d.eta : 1 / d.eta;
    }
  };
};

}  // namespace renderer
