// SPDX-License-Identifier: MIT
// What an affine transform does to points, vectors and normals. Matrices act on columns.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace renderer {

inline glm::dvec3 transform_point(const glm::dmat4& m, const glm::dvec3& p) {
  return glm::dvec3(m * glm::dvec4(p, 1.0));
}
inline glm::dvec3 transform_vector(const glm::dmat4& m, const glm::dvec3& v) {
  return glm::dmat3(m) * v;
}
/// Normals go by the inverse transpose; the result is not normalised.
inline glm::dvec3 transform_normal(const glm::dmat4& m, const glm::dvec3& n) {
  return glm::transpose(glm::inverse(glm::dmat3(m))) * n;
}

}  // namespace renderer
