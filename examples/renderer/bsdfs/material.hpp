// SPDX-License-Identifier: MIT
// The material of a shape: which BSDF each of its sides has, the detail in its normal, and where
// there is any surface at all.
#pragma once

#include <algorithm>

#include "bsdf.hpp"
#include "perturbation.hpp"

namespace renderer {

/// The BSDFs of a shape's sides. `back` is none for one BSDF that knows both sides itself; else it
/// sees the surface flipped, as its own front.
struct Material {
  const Bsdf* front = nullptr;
  const Bsdf* back = nullptr;
  const Perturbation* front_detail = nullptr;  ///< of both sides where `back` is none
  const Perturbation* back_detail = nullptr;
  FloatTexture coverage{1.0f};  ///< of a mask
  HitNeeds needs{};             ///< of all the above

  /// Part of the light goes straight on, as if there were no surface.
  bool is_masked() const { return !coverage.is_constant() || coverage.constant < 1; }
  /// From one side or in places at least.
  bool lets_light_pass() const {
    return is_masked() || front->is_sheet() || (back && back->is_sheet());
  }
  /// The chance that a ray meets the surface here.
  float opacity(const Hit& hit) const { return std::clamp(coverage(hit), 0.0f, 1.0f); }

  /// The BSDF of the side that `seen_from` points away from. Gives the hit that side's normal: to
  /// be called once for a hit that Scene::intersect() found.
  const Bsdf& facing(Hit& hit, const Vec3& seen_from) const {
    const bool from_behind = back && glm::dot(hit.normal, seen_from) < 0;
    if (const Perturbation* detail = from_behind ? back_detail : front_detail) detail->apply(hit);
    if (!from_behind) return *front;
    hit.flip();
    return *back;
  }
};

}  // namespace renderer
