// SPDX-License-Identifier: MIT
// Light sources, all of which emit unpolarised light: area lights on shapes, points, a direction at
// infinity, a constant environment, and one by a picture. Each is met in three ways: a path from
// the camera finds it, a point of a surface is connected to it, or a path starts from it.
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "../core/sampler.hpp"
#include "../geometry/geometry.hpp"
#include "environment_map.hpp"

namespace renderer {

class Medium;

/// A direction in which a source may be seen from a point, and what would come from there.
struct LightSample {
  Vec3 direction;      ///< to the light, unit
  Vec3 position;       ///< of the light; for sources at infinity, a point far outside the scene
  Rgb radiance{0.0f};  ///< of delta sources, the irradiance across the direction
  float pdf = 0;       ///< by solid angle; of delta sources, 1
  bool is_delta = false;
  /// The density, by area across the ray at the point, of paths from the light along this ray, over
  /// that of being connected to it: what MIS weights compare the two by.
  float emission_ratio = 0;
  bool is_at_infinity = false;
};

/// The start of a path from a light.
struct EmissionSample {
  Vec3 position;      ///< where the path starts
  Vec3 direction;     ///< where the light goes, unit
  float reach = 0;    ///< how far off the surface the ray starts
  Vec3 normal{0.0f};  ///< of the surface that emits; zero where there is none
  Rgb power{0.0f};    ///< radiance · cos/pdf: what the path carries
  float cosine_over_pdf =
      0;  ///< 0 of delta sources, which nothing finds; cosine 1 of those at infinity
  std::size_t light = 0;  ///< its number in the scene
  bool is_at_infinity = false;
  const Medium* medium = nullptr;  ///< that the path starts in; null in vacuum
  bool is_glow = false;            ///< it starts within a medium, not at a light
};

/// Every point of a shape's front emits the same radiance into its hemisphere.
class AreaLight {
 public:
  AreaLight(const Geometry& geometry, std::uint32_t shape, const Rgb& radiance);

  std::uint32_t shape() const { return shape_; }
  Rgb radiance(const Hit& hit, const Vec3& exitant) const {
    return glm::dot(hit.geometric_normal, exitant) > 0 ? radiance_ : Rgb(0.0f);
  }
  bool sample(const Geometry& geometry, const Vec3& from, const Vec2& u, LightSample& light) const;
  /// The density with which sample() finds this point of the light from `from`.
  float pdf(const Geometry& geometry, const Vec3& from, const Hit& hit) const;

  bool emit(const Geometry& geometry, const Vec2& place, const Vec2& u, EmissionSample& e) const;
  float area() const { return area_; }
  /// The density, by area and solid angle, of emit() at a cosine from the normal.
  float emission_pdf(float cosine) const { return std::max(cosine, 0.0f) / (pi * area_); }
  /// As LightSample has it, of a path that emit() started and that has reached `to`.
  float emission_ratio(const Geometry& geometry, const EmissionSample& e, const Vec3& to) const;

 private:
  struct Point {
    Vec3 position, normal;
  };
  /// A flat mesh of two triangles may be one, which is drawn from without a search.
  struct Parallelogram {
    Vec3 corner, u, v, normal;
  };
  static std::optional<Parallelogram> parallelogram(const Geometry& geometry, std::uint32_t shape);
  bool sample_sphere(const Sphere& s, const Vec3& from, const Vec2& u, LightSample& light) const;
  bool connect(const Point& point, const Vec3& from, LightSample& light) const;
  Point sample_point(const Geometry& geometry, const Vec2& u) const;

  std::uint32_t shape_;
  Rgb radiance_;
  float area_ = 0;
  std::optional<Parallelogram> parallelogram_;
  std::vector<float> cumulative_area_;  // of a mesh, after each triangle
};

struct PointLight {
  Vec3 position;
  Rgb intensity{1.0f};
  bool sample(const Vec3& from, LightSample& light) const;
  bool emit(const Vec2& u, EmissionSample& e) const;
};

struct DirectionalLight {
  Vec3 propagation;  ///< the direction that light travels in, unit
  Rgb irradiance{1.0f};
  bool sample(const Geometry& geometry, const Vec3& from, LightSample& light) const;
  bool emit(const Geometry& geometry, const Vec2& place, EmissionSample& e) const;
};

/// The same radiance from all directions at infinity.
struct ConstantLight {
  Rgb radiance{1.0f};
  bool sample(const Geometry& geometry, const Vec3& from, const Vec2& u, LightSample& light) const;
  bool emit(const Geometry& geometry, const Vec2& place, const Vec2& u, EmissionSample& e) const;
  static constexpr float pdf() { return 1 / (4 * pi); }
};

/// Radiance from infinity by direction.
struct EnvironmentLight {
  EnvironmentMap map;
  bool sample(const Geometry& geometry, const Vec3& from, const Vec2& u, LightSample& light) const;
  bool emit(const Geometry& geometry, const Vec2& place, const Vec2& u, EmissionSample& e) const;
};

using Emitter =
    std::variant<AreaLight, PointLight, DirectionalLight, ConstantLight, EnvironmentLight>;

// What sources at infinity share: paths start from a disk that the scene hides behind.

/// The density by area of a path's start.
inline float disk_pdf(const Geometry& geometry) {
  return 1 / (pi * geometry.radius() * geometry.radius());
}
/// A point of the disk across the direction that light goes in, before the scene.
Vec3 disk_point(const Geometry& geometry, const Vec3& propagation, const Vec2& u);
/// A point far outside the scene, in a direction from a point within.
Vec3 far_point(const Geometry& geometry, const Vec3& from, const Vec3& direction);

}  // namespace renderer
