// SPDX-License-Identifier: MIT
// The shapes of a scene and the rays through them, traced by Embree. Triangle meshes go in as they
// are, spheres as user geometry, which meets them exactly and faster than Embree's own points.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "../scene/mesh.hpp"
#include "hit.hpp"

namespace renderer {

struct Sphere {
  Vec3 center;
  float radius = 1;
  bool flipped = false;      ///< normals point inwards
  glm::mat3 rotation{1.0f};  ///< turns the sphere's own axes into the world's
};

class Geometry {
 public:
  Geometry();
  ~Geometry();
  Geometry(Geometry&&) noexcept;
  Geometry& operator=(Geometry&&) noexcept;

  /// Adds a shape and returns its number, counted from 0.
  std::uint32_t add(TriangleMesh mesh);
  std::uint32_t add(const Sphere& sphere);
  /// The shape doesn't always stop light: it stops no shadow rays, which have to ask what it does.
  void let_light_pass(std::uint32_t shape);
  /// To be called once, after the last shape and before the first ray. Throws WorkError where
  /// Embree can't.
  void commit();

  bool intersect(const Ray& ray, Hit& hit) const;
  /// Whether something is in the way that lets no light pass.
  bool occluded(const Ray& ray) const;
  /// Like intersect(), of the shapes alone that may let light pass.
  bool intersect_passages(const Ray& ray, Hit& hit) const;

  /// Fills in what a material needs to know of a hit.
  void complete(const HitNeeds& needs, Hit& hit) const;
  /// The mesh's texture coordinates, or the barycentric ones of a mesh without; of a sphere,
  /// longitude and colatitude as fractions of 360 and 180 degrees.
  Vec2 uv(const Hit& hit) const;
  /// ∂p/∂u and ∂p/∂v at a hit; 0 where a mesh's texture coordinates are the same all over.
  std::array<Vec3, 2> partials(const Hit& hit) const;
  /// ∂p/∂u at a hit, of unit length and perpendicular to the normal: the surface's own x axis. Any
  /// such vector where a mesh has no texture coordinates.
  Vec3 tangent(const Hit& hit) const;

  bool is_sphere(std::uint32_t shape) const;
  const Sphere& sphere(std::uint32_t shape) const;
  const TriangleMesh& mesh(std::uint32_t shape) const;
  /// A box around a shape: its least and its greatest coordinates.
  std::array<Vec3, 2> bounds(std::uint32_t shape) const;
  /// Of a mesh's triangle, by its winding.
  const Vec3& face_normal(std::uint32_t shape, std::size_t triangle) const;
  /// SurfacePoint's, of a point of a shape.
  float reach(std::uint32_t shape, const Vec3& geometric_normal) const;
  std::size_t shape_count() const;
  std::size_t triangle_count() const;
  /// A sphere around everything; of radius 0 if there is nothing.
  Vec3 center() const { return center_; }
  float radius() const { return radius_; }

 private:
  struct Embree;
  std::unique_ptr<Embree> embree_;
  Vec3 center_{};
  float radius_ = 0;
};

}  // namespace renderer
