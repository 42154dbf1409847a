// SPDX-License-Identifier: MIT
// What every BSDF agrees on. Directions point away from the surface, in world space: `incident` to
// where light comes from, `exitant` to where it goes. Light therefore propagates along −incident,
// then along exitant.
#pragma once

#include <malus/malus.hpp>

#include "../core/sampler.hpp"
#include "../geometry/hit.hpp"

namespace renderer {

/// A sampled incident direction. weight = m00 |cos|/pdf, the share of unpolarised light that it
/// brings; of delta distributions, pdf is the probability of the choice.
struct BsdfSample {
  Vec3 incident{};
  Rgb weight{0.0f};
  float pdf = 0;
  float eta = 1;  ///< index on the incident side over that on the exitant side
  bool is_delta = false;
};

using MuellerFrame = malus::Frame<float>;

/// The frames of a specular event at a normal.
inline malus::FramePair<float> specular_frames(const Vec3& normal, const Vec3& incident,
                                               const Vec3& exitant) {
  return malus::frames_of_incidence<float>(normal, -incident, exitant);
}

}  // namespace renderer
