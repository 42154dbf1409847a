// SPDX-License-Identifier: MIT
// Vectors, and small geometry on them. World space is single precision, as Embree's is.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <malus/spectrum.hpp>

/// A function that is too large for its callers, and whose own callees are to be part of it: one
/// call instead of several, each with its arguments and result in memory.
#if defined(__GNUC__)
#define RENDERER_FLATTEN [[gnu::flatten]]
#else
#define RENDERER_FLATTEN
#endif

namespace renderer {

using Vec2 = glm::vec2;
using Vec3 = glm::vec3;
using malus::Rgb;

inline constexpr float pi = 3.14159265358979323846f;
inline constexpr float infinity = std::numeric_limits<float>::infinity();

inline Rgb to_rgb(const glm::dvec3& c) {
  return {static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z)};
}

/// The same vector, where it has just been made and is kept in memory next. g++ writes a vector's
/// three components, and then copies them from there as two words, for which it must wait until all
/// of them have arrived.
MALUS_INLINE Vec3 by_components(const Vec3& v) { return {v.x, v.y, v.z}; }

/// Of unit length; v is not zero. One division, where GLM's operators have three.
MALUS_INLINE Vec3 normalized(const Vec3& v) { return v * (1 / std::sqrt(glm::dot(v, v))); }

/// Mirror image of w about the axis n; both point away from the surface.
inline Vec3 reflect_about(const Vec3& w, const Vec3& n) { return 2 * glm::dot(w, n) * n - w; }

/// Two unit vectors that make a right-handed basis with a unit vector n (Duff et al. 2017).
struct Basis {
  Vec3 s, t;
  MALUS_INLINE explicit Basis(const Vec3& n) : Basis(n, std::copysign(1.0f, n.z)) {}
  Basis(const Vec3& along_s, const Vec3& along_t) : s(along_s), t(along_t) {}

 private:
  MALUS_INLINE Basis(const Vec3& n, float sign) : Basis(n, sign, -1 / (sign + n.z)) {}
  MALUS_INLINE Basis(const Vec3& n, float sign, float a)
      : s(1 + sign * n.x * n.x * a, sign * (n.x * n.y * a), -sign * n.x),
        t(n.x * n.y * a, sign + n.y * n.y * a, -n.y) {}
};

}  // namespace renderer
