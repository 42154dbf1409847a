// SPDX-License-Identifier: MIT
// Maps from the unit square to directions and points, with their densities (Pharr, Jakob &
// Humphreys 2023, appendix A.5).
#pragma once

#include <algorithm>

#include "vector.hpp"

namespace renderer {

/// (cos x, sin x) for |x| ≤ π/4, to 2e-7: Taylor's polynomials to x⁸ and x⁹.
inline Vec2 cosine_and_sine(float x) {
  const float y = x * x;
  const float c = 1 + y * (-0.5f + y * (1.0f / 24 + y * (-1.0f / 720 + y * (1.0f / 40320))));
  const float s = 1 + y * (-1.0f / 6 + y * (1.0f / 120 + y * (-1.0f / 5040 + y * (1.0f / 362880))));
  return {c, x * s};
}

/// Concentric map to the unit disk (Shirley & Chiu 1997).
inline Vec2 square_to_disk(const Vec2& u) {
  const float a = 2 * u.x - 1, b = 2 * u.y - 1;
  if (a == 0 && b == 0) return {0, 0};
  // Selections rather than branches, which no processor could predict.
  const bool wide = std::abs(a) > std::abs(b);
  const float r = wide ? a : b;
  const Vec2 turn = cosine_and_sine(pi / 4 * ((wide ? b : a) / r));
  return r * Vec2(wide ? turn.x : turn.y, wide ? turn.y : turn.x);
}

/// Density cos θ/π about +z.
inline Vec3 square_to_cosine_hemisphere(const Vec2& u) {
  const Vec2 d = square_to_disk(u);
  return {d.x, d.y, std::sqrt(std::max(0.0f, 1 - d.x * d.x - d.y * d.y))};
}

/// Density 1/4π.
inline Vec3 square_to_sphere(const Vec2& u) {
  const float z = 1 - 2 * u.x, r = std::sqrt(std::max(0.0f, 1 - z * z)), phi = 2 * pi * u.y;
  return {r * std::cos(phi), r * std::sin(phi), z};
}

/// Uniform over the cone about +z of opening 1 − cos θ = `one_minus_cos`; density 1/(2π
/// one_minus_cos).
inline Vec3 square_to_cone(const Vec2& u, float one_minus_cos) {
  const float h = u.x * one_minus_cos;  // 1 − cos θ, exact for narrow cones
  const float r = std::sqrt(std::max(0.0f, h * (2 - h))), phi = 2 * pi * u.y;
  return {r * std::cos(phi), r * std::sin(phi), 1 - h};
}

/// Barycentric coordinates uniform over a triangle.
inline Vec2 square_to_triangle(const Vec2& u) {
  const float root = std::sqrt(u.x);
  return {1 - root, u.y * root};
}

}  // namespace renderer
