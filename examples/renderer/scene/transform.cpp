// SPDX-License-Identifier: MIT
#include "transform.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "text.hpp"

namespace renderer {
namespace {

struct SineCosine {
  double sine;
  double cosine;
};

SineCosine of_degrees(double degrees) {
  const double turn = std::remainder(degrees, 360.0);
  if (turn == 0.0) return {0.0, 1.0};
  if (turn == 90.0) return {1.0, 0.0};
  if (turn == -90.0) return {-1.0, 0.0};
  if (turn == 180.0 || turn == -180.0) return {0.0, -1.0};
  const double angle = glm::radians(turn);
  return {std::sin(angle), std::cos(angle)};
}

/// Scaled first, so that neither huge nor tiny vectors overflow on the way.
std::optional<glm::dvec3> direction_of(const glm::dvec3& v) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(largest > 0.0) || !is_finite(largest)) return {};
  return glm::normalize(v / largest);
}

}  // namespace

glm::dmat4 translation(const glm::dvec3& offset) { return glm::translate(glm::dmat4(1.0), offset); }

glm::dmat4 scaling(const glm::dvec3& factors) { return glm::scale(glm::dmat4(1.0), factors); }

glm::dmat4 rotation(const glm::dvec3& axis, double degrees) {
  const glm::dvec3 a = direction_of(axis).value_or(glm::dvec3(0.0, 0.0, 1.0));
  const auto [s, c] = of_degrees(degrees);
  // Rodrigues: cos I + (1 - cos) a aT + sin [a]x, column by column.
  const double t = 1.0 - c;
  glm::dmat4 m(1.0);
  m[0] = glm::dvec4(c + t * a.x * a.x, t * a.x * a.y + s * a.z, t * a.x * a.z - s * a.y, 0.0);
  m[1] = glm::dvec4(t * a.x * a.y - s * a.z, c + t * a.y * a.y, t * a.y * a.z + s * a.x, 0.0);
  m[2] = glm::dvec4(t * a.x * a.z + s * a.y, t * a.y * a.z - s * a.x, c + t * a.z * a.z, 0.0);
  return m;
}

std::optional<glm::dmat4> look_at(const glm::dvec3& origin, const glm::dvec3& target,
                                  const glm::dvec3& up) {
  const auto forward = direction_of(target - origin);
  const auto upward = direction_of(up);
  if (!forward || !upward) return {};
  const glm::dvec3 side = glm::cross(*upward, *forward);
  if (!(glm::length(side) > 1e-9)) return {};
  const glm::dvec3 left = glm::normalize(side);
  return glm::dmat4(glm::dvec4(left, 0.0), glm::dvec4(glm::cross(*forward, left), 0.0),
                    glm::dvec4(*forward, 0.0), glm::dvec4(origin, 1.0));
}

std::pair<glm::dvec3, glm::dvec3> coordinate_system(const glm::dvec3& n) {
  const double sign = std::copysign(1.0, n.z);
  const double a = -1.0 / (sign + n.z);
  const double b = n.x * n.y * a;
  return {glm::dvec3(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x),
          glm::dvec3(b, sign + n.y * n.y * a, -n.y)};
}

bool is_singular(const glm::dmat4& transform) {
  glm::dmat3 linear(transform);
  for (int column = 0; column < 3; ++column) {
    const auto unit = direction_of(linear[column]);
    if (!unit) return true;
    linear[column] = *unit;
  }
  return !(std::abs(glm::determinant(linear)) > 1e-12);
}

bool is_finite(const glm::dmat4& transform) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      if (!is_finite(transform[column][row])) return false;
    }
  }
  return true;
}

bool is_affine(const glm::dmat4& transform) {
  return transform[0][3] == 0.0 && transform[1][3] == 0.0 && transform[2][3] == 0.0 &&
         transform[3][3] == 1.0;
}

}  // namespace renderer
