// SPDX-License-Identifier: MIT
// Light sources, all of which emit unpolarised light: area lights on shapes, points, a direction at
// infinity, and a constant environment.
#pragma once

#include <optional>
#include <variant>
#include <vector>

#include "../core/sampler.hpp"
#include "../geometry/geometry.hpp"

namespace renderer {

/// A direction in which a source may be seen from a point, and what would come from there.
struct LightSample {
  Vec3 direction;      ///< to the light, unit
  Vec3 position;       ///< of the light; for sources at infinity, a point far outside the scene
  Rgb radiance{0.0f};  ///< of delta sources, the irradiance across the direction
  float pdf = 0;       ///< by solid angle; of delta sources, 1
  bool is_delta = false;
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

 private:
  bool sample_sphere(const Sphere& s, const Vec3& from, const Vec2& u, LightSample& light) const;

  std::uint32_t shape_;
  Rgb radiance_;
  float area_ = 0;
  std::vector<float> cumulative_area_;  // of a mesh, after each triangle
};

struct PointLight {
  Vec3 position;
  Rgb intensity{1.0f};
  bool sample(const Vec3& from, LightSample& light) const;
};

struct DirectionalLight {
  Vec3 propagation;  ///< the direction that light travels in, unit
  Rgb irradiance{1.0f};
  bool sample(const Geometry& geometry, const Vec3& from, LightSample& light) const;
};

/// The same radiance from all directions at infinity.
struct ConstantLight {
  Rgb radiance{1.0f};
  bool sample(const Geometry& geometry, const Vec3& from, const Vec2& u, LightSample& light) const;
  static constexpr float pdf() { return 1 / (4 * pi); }
};

using Emitter = std::variant<AreaLight, PointLight, DirectionalLight, ConstantLight>;

}  // namespace renderer
