// SPDX-License-Identifier: MIT
// A smooth conductor of complex index eta + ik, one a channel. Its front alone reflects.
#pragma once

#include "sample.hpp"

namespace renderer {

struct Conductor {
  Rgb eta{0.0f}, k{1.0f};
  Rgb specular_reflectance{1.0f};

  static constexpr bool is_delta = true;
  static constexpr bool polarizes = true;

  bool sample(const Hit& hit, const Vec3& exitant, Sampler&, BsdfSample& result) const {
    const float cos_o = glm::dot(hit.normal, exitant);
    if (cos_o <= 0) return false;
    result.incident = glm::normalize(reflect_about(exitant, hit.normal));
    result.is_delta = true;
    result.pdf = 1;
    result.weight =
        specular_reflectance *
        malus::map_channels(
            [&](float n, float x) { return malus::fresnel_conductor(cosine(cos_o), n, x).mean(); },
            eta, k);
    return true;
  }

  template <class R>
  typename R::Scattering weight(const Hit& hit, const Vec3& exitant,
                                const BsdfSample& sample) const {
    if constexpr (R::polarized) {
      const auto frames = specular_frames(hit.normal, sample.incident, exitant);
      const float cos_o = cosine(glm::dot(hit.normal, exitant));
      return malus::conductor_reflection(cos_o, eta, k, frames.enter, frames.exit) *
             specular_reflectance;
    } else {
      return sample.weight;
    }
  }

 private:
  static float cosine(float c) { return std::min(c, 1.0f); }
};

}  // namespace renderer
