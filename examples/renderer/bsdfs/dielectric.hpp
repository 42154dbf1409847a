// SPDX-License-Identifier: MIT
// A smooth interface between two dielectrics; the normal points to the outer one. Reflection or
// refraction is chosen by the reflectance for unpolarised light.
#pragma once

#include "sample.hpp"

namespace renderer {

struct Dielectric {
  float eta = 1.5046f / 1.000277f;  ///< inner over outer index
  Rgb specular_reflectance{1.0f}, specular_transmittance{1.0f};

  static constexpr bool is_delta = true;
  static constexpr bool polarizes = true;

  bool sample(const Hit& hit, const Vec3& exitant, Sampler& sampler, BsdfSample& result) const {
    const Side side(*this, hit, exitant);
    const float reflectance = malus::fresnel_dielectric(side.cos_o, side.eta).mean();
    result.is_delta = true;
    if (sampler.next_1d() < reflectance) {
      result.incident = glm::normalize(reflect_about(exitant, side.normal));
      result.pdf = reflectance;
      result.weight = specular_reflectance;
      return true;
    }
    const float cos_i = malus::refracted_cosine(side.cos_o, side.eta);
    if (cos_i <= 0) return false;
    const float inverse = 1 / side.eta;
    result.incident =
        glm::normalize((side.cos_o * inverse - cos_i) * side.normal - exitant * inverse);
    result.pdf = 1 - reflectance;
    result.eta = side.eta;
    // n² radiance is what refraction conserves.
    result.weight = specular_transmittance * (inverse * inverse);
    return true;
  }

  template <class R>
  typename R::Scattering weight(const Hit& hit, const Vec3& exitant,
                                const BsdfSample& sample) const {
    if constexpr (R::polarized) {
      const Side side(*this, hit, exitant);
      const bool reflected = glm::dot(side.normal, sample.incident) > 0;
      const auto frames = specular_frames(side.normal, sample.incident, exitant);
      const auto terms = reflected ? malus::fresnel_dielectric(side.cos_o, side.eta)
                                   : malus::fresnel_transmission(side.cos_o, side.eta);
      return malus::fresnel_block<Rgb>(terms, frames.enter, frames.exit) *
             (sample.weight / sample.pdf);
    } else {
      return sample.weight;
    }
  }

 private:
  /// The interface as light leaves it: the normal on the exitant side, and the index behind it over
  /// that before it.
  struct Side {
    Vec3 normal;
    float cos_o, eta;
    Side(const Dielectric& d, const Hit& hit, const Vec3& exitant) {
      const float c = glm::dot(hit.normal, exitant);
      normal = c >= 0 ? hit.normal : -hit.normal;
      cos_o = std::min(std::abs(c), 1.0f);
      eta = c >= 0 ? d.eta : 1 / d.eta;
    }
  };
};

}  // namespace renderer
