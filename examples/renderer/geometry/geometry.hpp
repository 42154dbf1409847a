// SPDX-License-Identifier: MIT
// The shapes of a scene and the rays through them, traced by Embree. Triangle meshes go in as they
// are, spheres as user geometry, which meets them exactly and faster than Embree's own points.
#pragma once

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
  /// To be called once, after the last shape and before the first ray. Throws WorkError where
  /// Embree can't.
  void commit();

  bool intersect(const Ray& ray, Hit& hit) const;
  bool occluded(const Ray& ray) const;

  /// ∂p/∂u at a hit, of unit length and perpendicular to the normal: the surface's own x axis.
  Vec3 tangent(const Hit& hit) const;

  bool is_sphere(std::uint32_t shape) const;
  const Sphere& sphere(std::uint32_t shape) const;
  const TriangleMesh& mesh(std::uint32_t shape) const;
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
