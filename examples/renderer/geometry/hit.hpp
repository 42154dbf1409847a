// SPDX-License-Identifier: MIT
// A ray, and the point where it meets a surface.
#pragma once

#include <algorithm>
#include <cstdint>

#include "../core/vector.hpp"

namespace renderer {

/// Points origin + t direction, 0 < t < length. The direction is of unit length, but for rays that
/// ask only whether something is in the way.
struct Ray {
  Vec3 origin, direction;
  float length = infinity;
};

/// What a material asks to know of a hit beyond what every hit tells.
struct HitNeeds {
  bool uv = false;
  bool tangent = false;
  bool partials = false;  ///< dp_du and dp_dv

  bool any() const { return uv || tangent || partials; }
  HitNeeds operator|(const HitNeeds& b) const {
    return {uv || b.uv, tangent || b.tangent, partials || b.partials};
  }
};

/// A vector's part perpendicular to a unit normal, of unit length; any such vector if there is
/// none.
inline Vec3 tangent_along(const Vec3& v, const Vec3& normal) {
  const Vec3 t = v - glm::dot(v, normal) * normal;
  const float length2 = glm::dot(t, t);
  return length2 > 0 ? t / std::sqrt(length2) : Basis(normal).s;
}

/// A point of a surface as one of its sides: what scatters there needs no more of it.
struct SurfacePoint {
  Vec3 position;
  Vec3 geometric_normal;  ///< unit, on the side that the shape calls its front
  Vec3 normal;            ///< unit, interpolated where the mesh has normals: what BSDFs see
  float reach = 0;        ///< how far off the surface rays start, so as not to meet it again

  // Only where the material asks for them: see HitNeeds.
  Vec2 uv{};       ///< what textures are looked up by
  Vec3 tangent{};  ///< unit ∂p/∂u, perpendicular to the normal

  /// The side of the surface that w points to, for both normals alike. Where they disagree, the
  /// interpolated normal claims light to pass through the surface, and there is none.
  MALUS_INLINE bool sides_agree(const Vec3& w) const {
    return glm::dot(geometric_normal, w) * glm::dot(normal, w) > 0;
  }
  /// The same point seen as the other side's front.
  void flip() {
    geometric_normal = -geometric_normal;
    normal = -normal;
  }
  /// Whether a point is nearer to the plane of the surface here than rays start off it: which side
  /// it is on is rounding.
  bool touches(const Vec3& point) const {
    return std::abs(glm::dot(geometric_normal, point - position)) < reach / 2;
  }
  /// A ray that leaves towards w.
  MALUS_INLINE Ray leave(const Vec3& w) const {
    return {by_components(offset(w)), by_components(w)};
  }
  /// The ray to another point, seen in direction w, and short of it. It is aimed anew from where it
  /// starts: a parallel one would meet a sphere before a point on its limb. Its direction is not
  /// of unit length.
  MALUS_INLINE Ray leave_for(const Vec3& target, const Vec3& w) const {
    const Vec3 origin = offset(w);
    return {by_components(origin), by_components(target - origin), 1 - 2e-4f};
  }
  /// The ray to another surface's point, between points off both: the same seen from either end.
  /// Its direction is not of unit length.
  MALUS_INLINE Ray leave_for(const SurfacePoint& other, const Vec3& w) const {
    const Vec3 origin = offset(w);
    return {by_components(origin), by_components(other.offset(-w) - origin), 1};
  }

 private:
  MALUS_INLINE Vec3 offset(const Vec3& w) const {
    return position + geometric_normal * std::copysign(reach, glm::dot(geometric_normal, w));
  }
};

/// A point that no surface is at: rays leave it from where it is.
inline SurfacePoint point_in_medium(const Vec3& position) {
  return {position, Vec3(0.0f), Vec3(0.0f)};
}

/// Where a ray has met a shape.
struct Hit : SurfacePoint {
  float distance = 0;
  std::uint32_t shape = 0, primitive = 0;
  Vec2 parameter{};  ///< barycentric coordinates of the primitive
  Vec3 dp_du{}, dp_dv{};  ///< ∂p/∂u and ∂p/∂v of the shape itself, where the material asks for them
};

}  // namespace renderer
