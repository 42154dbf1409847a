// SPDX-License-Identifier: MIT
// Affine transforms as Mitsuba's scene files define them. Matrices act on columns and `b * a`
// applies a first. Angles are in degrees, as in the files.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <utility>

#include "../core/affine.hpp"

namespace renderer {

glm::dmat4 translation(const glm::dvec3& offset);
glm::dmat4 scaling(const glm::dvec3& factors);

/// Counter-clockwise about the axis when it points at the viewer. Multiples of 90 degrees are
/// exact. The axis may have any length but zero.
glm::dmat4 rotation(const glm::dvec3& axis, double degrees);

/// Camera to world: the camera looks along its +z, +y is up and +x is to the left in the picture.
/// Nothing if the target is the origin or `up` is along the direction.
std::optional<glm::dmat4> look_at(const glm::dvec3& origin, const glm::dvec3& target,
                                  const glm::dvec3& up);

/// Two unit vectors that form a right-handed frame with the unit vector n
/// (Duff et al. 2017, "Building an Orthonormal Basis, Revisited").
std::pair<glm::dvec3, glm::dvec3> coordinate_system(const glm::dvec3& n);

/// No inverse exists to working precision, whatever the scale of the whole.
bool is_singular(const glm::dmat4& transform);
bool is_finite(const glm::dmat4& transform);
bool is_affine(const glm::dmat4& transform);

}  // namespace renderer
