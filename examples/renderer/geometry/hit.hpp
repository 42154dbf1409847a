// SPDX-License-Identifier: MIT
// A ray, and the point where it meets a surface.
#pragma once

#include <algorithm>
#include <cstdint>

#include "../core/vector.hpp"

namespace renderer {

/// Points origin + t direction, 0 < t < length. The direction is of unit length.
struct Ray {
  Vec3 origin, direction;
  float length = infinity;
};

struct Hit {
  Vec3 position;
  Vec3 geometric_normal;  ///< unit, on the side that the shape calls its front
  Vec3 normal;            ///< unit, interpolated where the mesh has normals: what BSDFs see
  float distance = 0;
  std::uint32_t shape = 0, primitive = 0;
  Vec2 parameter{};  ///< barycentric coordinates of the primitive
  Vec3 tangent{};  ///< unit ∂p/∂u, perpendicular to the normal; only where the material asks for it

  /// The side of the surface that w points to, for both normals alike. Where they disagree, the
  /// interpolated normal claims light to pass through the surface, and there is none.
  bool sides_agree(const Vec3& w) const {
    return glm::dot(geometric_normal, w) * glm::dot(normal, w) > 0;
  }
  /// The same point seen as the other side's front.
  void flip() {
    geometric_normal = -geometric_normal;
    normal = -normal;
  }
  /// A ray that leaves towards w, from far enough off the surface not to meet it again.
  Ray leave(const Vec3& w) const { return {offset(w), w}; }
  /// The ray to another point, seen in direction w, and short of it. It is aimed anew from where it
  /// starts: a parallel one would meet a sphere before a point on its limb.
  Ray leave_for(const Vec3& target, const Vec3& w) const {
    const Vec3 origin = offset(w), way = target - origin;
    const float far = glm::length(way);
    return {origin, far > 0 ? way / far : w, far * (1 - 2e-4f)};
  }

 private:
  Vec3 offset(const Vec3& w) const {
    const Vec3 a = glm::abs(position);
    const float reach = (1 + std::max(a.x, std::max(a.y, a.z))) * 1e-4f;
    return position + geometric_normal * std::copysign(reach, glm::dot(geometric_normal, w));
  }
};

}  // namespace renderer
