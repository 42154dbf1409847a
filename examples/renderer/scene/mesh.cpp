// SPDX-License-Identifier: MIT
#include "mesh.hpp"

#include <algorithm>
#include <cmath>

namespace renderer {
namespace {

std::array<glm::dvec3, 3> corners(const TriangleMesh& mesh,
                                  const std::array<std::uint32_t, 3>& triangle) {
  return {glm::dvec3(mesh.positions[triangle[0]]), glm::dvec3(mesh.positions[triangle[1]]),
          glm::dvec3(mesh.positions[triangle[2]])};
}

/// Along the normal; zero where the corners are on a line.
glm::dvec3 area_vector(const std::array<glm::dvec3, 3>& p) {
  return glm::cross(p[1] - p[0], p[2] - p[0]);
}

bool has_area(const glm::dvec3& area) {
  // A squared length would underflow for triangles of 1e-40.
  return std::max({std::abs(area.x), std::abs(area.y), std::abs(area.z)}) > 1e-300;
}

/// Robust for angles near 0 and 180 degrees, where acos isn't.
double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

}  // namespace

void drop_degenerate_triangles(TriangleMesh& mesh) {
  const auto kept = std::remove_if(
      mesh.triangles.begin(), mesh.triangles.end(),
      [&](const auto& triangle) { return !has_area(area_vector(corners(mesh, triangle))); });
  mesh.dropped += static_cast<std::size_t>(mesh.triangles.end() - kept);
  mesh.triangles.erase(kept, mesh.triangles.end());
}

std::vector<glm::vec3> vertex_normals(const TriangleMesh& mesh) {
  std::vector<glm::dvec3> sums(mesh.positions.size(), glm::dvec3(0.0));
  for (const auto& triangle : mesh.triangles) {
    const std::array<glm::dvec3, 3> p = corners(mesh, triangle);
    const glm::dvec3 area = area_vector(p);
    if (!has_area(area)) continue;
    const double largest = std::max({std::abs(area.x), std::abs(area.y), std::abs(area.z)});
    const glm::dvec3 normal = glm::normalize(area / largest);
    for (std::size_t i = 0; i < 3; ++i) {
      const double angle = angle_between(p[(i + 1) % 3] - p[i], p[(i + 2) % 3] - p[i]);
      sums[triangle[i]] += angle * normal;
    }
  }
  std::vector<glm::vec3> normals;
  normals.reserve(sums.size());
  for (const glm::dvec3& sum : sums) {
    const double length = glm::length(sum);
    normals.emplace_back(length > 1e-9 ? sum / length : glm::dvec3(0.0, 0.0, 1.0));
  }
  return normals;
}

}  // namespace renderer
