// SPDX-License-Identifier: MIT
#include <algorithm>

#include "../core/affine.hpp"
#include "../io/memory.hpp"
#include "build.hpp"
#include "mesh_reader.hpp"
#include "read_for.hpp"
#include "text.hpp"

namespace renderer {

namespace {

/// Corners (±1, ±1, 0), normal +z, u along x and v along y.
TriangleMesh unit_rectangle() {
  TriangleMesh m;
  m.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  m.texcoords = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  m.triangles = {{0, 1, 2}, {2, 3, 0}};
  return m;
}

/// Corners (±1, ±1, ±1), normals outwards, and on each face the u and v that Mitsuba's cube has: v
/// = u × n.
TriangleMesh unit_cube() {
  constexpr glm::vec3 normals_and_u[6][2] = {{{0, -1, 0}, {0, 0, 1}}, {{0, 1, 0}, {-1, 0, 0}},
                                             {{1, 0, 0}, {0, 1, 0}},  {{0, 0, 1}, {0, 1, 0}},
                                             {{-1, 0, 0}, {0, 1, 0}}, {{0, 0, -1}, {0, -1, 0}}};
  TriangleMesh m;
  for (const auto& [n, u] : normals_and_u) {
    const Vec3 v = glm::cross(u, n);
    const auto first = static_cast<std::uint32_t>(m.positions.size());
    for (const auto& [a, b] :
         {std::pair{-1.0f, -1.0f}, {-1.0f, 1.0f}, {1.0f, 1.0f}, {1.0f, -1.0f}}) {
      m.positions.push_back(n + a * u + b * v);
      m.texcoords.push_back({(a + 1) / 2, (b + 1) / 2});
    }
    m.triangles.push_back({first, first + 1, first + 2});
    m.triangles.push_back({first + 2, first + 3, first});
  }
  return m;
}

void turn_inside_out(TriangleMesh& mesh) {
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  for (auto& n : mesh.normals) n = -n;
}

/// `keep_front`: the front stays the front in a mirroring transform. (Mitsuba lets it turn where a
/// mesh has no normals.)
void apply_transform(TriangleMesh& mesh, const glm::dmat4& to_world, bool keep_front) {
  for (auto& p : mesh.positions) p = Vec3(transform_point(to_world, glm::dvec3(p)));
  for (auto& n : mesh.normals) n = Vec3(glm::normalize(transform_normal(to_world, glm::dvec3(n))));
  if (glm::determinant(glm::dmat3(to_world)) < 0 && (keep_front || !mesh.normals.empty()))
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
}

TriangleMesh read_mesh(const Object& o, std::vector<std::string>& warnings) {
  const auto path = o.file("filename");
  const bool is_obj = o.type() == "obj", flip = o.boolean("flip_tex_coords", is_obj);
  TriangleMesh mesh = read_for(o.location(), [&] {
    return is_obj ? read_obj(path, flip, o.location()) : read_ply(path, flip, o.location());
  });
  if (mesh.dropped > 0)
    warnings.push_back(path.string() + ": left out " + std::to_string(mesh.dropped) +
                       " triangles without an area");
  return mesh;
}

/// Squares of lengths and areas are single-precision numbers.
constexpr double largest_coordinate = 1e18, smallest_radius = 1e-18;

/// In double precision, for the message: 1e39 is no float.
void check_extent(const Object& o, const glm::dvec3& center, double radius) {
  const double reach = glm::length(center) + radius;
  if (!(radius >= smallest_radius && reach <= largest_coordinate))
    o.fail("its radius is " + shown(radius) + " and it reaches to " + shown(reach) +
           " from the origin; allowed: a radius of " + shown(smallest_radius) + " or more, up to " +
           shown(largest_coordinate) + " from the origin");
}

Sphere make_sphere(const Object& o) {
  const glm::dvec3 center = o.point("center", glm::dvec3(0));
  const double radius = o.positive("radius", 1);
  const glm::dmat4 to_world = o.transform("to_world");
  const glm::dmat3 m(to_world);
  const double scale = glm::length(m[0]);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const double expected = i == j ? scale * scale : 0;
      if (std::abs(glm::dot(m[i], m[j]) - expected) > 1e-6 * scale * scale)
        o.fail("to_world",
               "a sphere can be moved, turned and scaled evenly, not sheared or stretched");
    }
  const glm::dvec3 placed = transform_point(to_world, center);
  check_extent(o, placed, radius * scale);
  Sphere sphere;
  sphere.center = Vec3(placed);
  sphere.radius = static_cast<float>(radius * scale);
  sphere.rotation = glm::mat3(m / scale);
  sphere.flipped = o.boolean("flip_normals", false);
  return sphere;
}

void check_extent(const Object& o, const TriangleMesh& mesh, std::vector<std::string>& warnings) {
  for (const auto& p : mesh.positions)
    for (int i = 0; i < 3; ++i)
      if (!(std::abs(static_cast<double>(p[i])) <= largest_coordinate))
        o.fail("it reaches to " + shown(static_cast<double>(p[i])) +
               "; allowed: coordinates up to " + shown(largest_coordinate));
  const auto empty =
      std::count_if(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& t) {
        const auto& p = mesh.positions;
        return !(glm::length(glm::cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]])) > 0);
      });
  if (empty > 0)
    warnings.push_back(o.location().file + ":" + std::to_string(o.location().line) + ": " +
                       o.description() + ": " + std::to_string(empty) + " of its " +
                       std::to_string(mesh.triangles.size()) +
                       " triangles are too small to have an area, or too thin");
}

}  // namespace

void check_triangles_fit(const Object& o, double triangles) {
  constexpr double bytes_per_triangle = 160;  // with normals, and Embree's tree
  const double bytes = bytes_per_triangle * triangles;
  if (!fits_into_memory(bytes))
    o.fail("with this one, the scene's meshes take " + in_gigabytes(bytes) + allowed_memory());
}

std::uint32_t add_shape_geometry(const Object& o, Geometry& geometry,
                                 std::vector<std::string>& warnings) {
  if (o.type() == "sphere") return geometry.add(make_sphere(o));

  TriangleMesh mesh;
  const bool from_file = o.type() == "obj" || o.type() == "ply";
  if (o.type() == "rectangle")
    mesh = unit_rectangle();
  else if (o.type() == "cube")
    mesh = unit_cube();
  else if (from_file)
    mesh = read_mesh(o, warnings);
  else
    fail_unknown_plugin(o, {"cube", "obj", "ply", "rectangle", "sphere"});

  if (from_file)
    check_triangles_fit(o, static_cast<double>(geometry.triangle_count() + mesh.triangles.size()));
  const bool face_normals = from_file && o.boolean("face_normals", false);
  if (face_normals) mesh.normals.clear();
  apply_transform(mesh, o.transform("to_world"), !from_file);
  check_extent(o, mesh, warnings);
  if (from_file && !face_normals && mesh.normals.empty()) mesh.normals = vertex_normals(mesh);
  if (o.boolean("flip_normals", false)) turn_inside_out(mesh);
  return geometry.add(std::move(mesh));
}

}  // namespace renderer
