// SPDX-License-Identifier: MIT
// Surface detail that is in the shading normal alone. A BSDF, its frames and its Mueller matrices
// know no other normal, so they are those of the surface that the detail stands for.
#pragma once

#include <variant>

#include "../textures/texture.hpp"

namespace renderer {

/// The normal of the surface displaced along its normal by scale · height (Blinn 1978, "Simulation
/// of Wrinkled Surfaces"), the change of the normal itself over the displacement neglected.
struct BumpMap {
  FloatTexture height;
  float scale = 1;

  /// Perpendicular to both partial derivatives of the displaced surface; of any length.
  Vec3 normal(const Hit& hit) const {
    const Vec2 slope = scale * height.gradient(hit);
    const Vec3& n = hit.normal;
    const Vec3 du = hit.dp_du + (slope.x - glm::dot(n, hit.dp_du)) * n;
    const Vec3 dv = hit.dp_dv + (slope.y - glm::dot(n, hit.dp_dv)) * n;
    const Vec3 across = glm::cross(du, dv);
    return glm::dot(across, n) < 0 ? -across : across;
  }
};

/// Colours c mean the normal 2c − 1 in the frame of tangent, normal × tangent and normal.
struct NormalMap {
  ColorTexture normals;

  Vec3 normal(const Hit& hit) const {
    const Rgb c = normals(hit) * 2.0f - Rgb(1.0f);
    return c[0] * hit.tangent + c[1] * glm::cross(hit.normal, hit.tangent) + c[2] * hit.normal;
  }
};

class Perturbation {
 public:
  using Kind = std::variant<BumpMap, NormalMap>;
  Perturbation(Kind kind) : kind_(std::move(kind)) {}  // NOLINT: any kind is a perturbation

  const Kind& kind() const { return kind_; }
  HitNeeds needs() const {
    const bool is_bump = std::holds_alternative<BumpMap>(kind_);
    return {.uv = false, .tangent = !is_bump, .partials = is_bump};
  }

  /// To a hit that isn't flipped: a surface is the same one from behind.
  void apply(Hit& hit) const {
    const Vec3 n = std::visit([&](const auto& kind) { return kind.normal(hit); }, kind_);
    const float length2 = glm::dot(n, n);
    if (!(length2 > 0)) return;
    hit.normal = n / std::sqrt(length2);
    hit.tangent = tangent_along(hit.tangent, hit.normal);
  }

 private:
  Kind kind_;
};

}  // namespace renderer
