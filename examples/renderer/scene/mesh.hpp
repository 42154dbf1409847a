// SPDX-License-Identifier: MIT
// A triangle mesh in memory. Every index is below positions.size(); every triangle has an area
// above zero; normals and texcoords are empty or one a position; every number is finite and every
// normal of unit length.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace renderer {

struct TriangleMesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<glm::vec2> texcoords;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::size_t dropped = 0;  // triangles without an area, left out
};

/// Takes out the triangles without an area and counts them in `dropped`.
void drop_degenerate_triangles(TriangleMesh& mesh);

/// The mean of the adjacent faces' normals, weighted by the faces' angles at the vertex, as Mitsuba
/// computes them for a file without normals (Thürmer and Wüthrich 1998, "Computing Vertex Normals
/// from Polygonal Facets"). A vertex of no triangle gets +z.
std::vector<glm::vec3> vertex_normals(const TriangleMesh& mesh);

}  // namespace renderer
