// SPDX-License-Identifier: MIT
// Sensors: where a camera ray of a point of the film starts, and in which frame its Stokes vector
// is read.
#pragma once

#include <malus/frame.hpp>

#include "../geometry/hit.hpp"

namespace renderer {

/// Perspective pinhole, or a radiancemeter, which measures along one ray.
class Sensor {
 public:
  enum class Kind { perspective, radiancemeter };

  /// The lens looks along the local +z; +x is the picture's left and +y its top, as in Mitsuba.
  struct Lens {
    Vec2 half_extent{1.0f};   ///< tangents of half the field of view
    Vec2 principal_point{0};  ///< where on the film, from its centre, a camera without it looks:
                              ///< fractions of the film
    float near_clip = 1e-2f, far_clip = 1e4f;
  };

  Sensor(Kind kind, const glm::dmat4& to_world, const Lens& lens)
      : kind_(kind),
        to_world_(to_world),
        origin_(to_world[3]),
        up_(glm::normalize(glm::dvec3(to_world[1]))),
        lens_(lens) {}

  Kind kind() const { return kind_; }
  const Vec3& origin() const { return origin_; }

  /// The ray of a point of the film, (0, 0) its upper left and (1, 1) its lower right corner.
  Ray ray(const Vec2& film) const {
    Vec3 local(0, 0, 1);
    if (kind_ == Kind::perspective) {
      const Vec2 p = Vec2(1) - 2.0f * (film + lens_.principal_point);
      local = {p.x * lens_.half_extent.x, p.y * lens_.half_extent.y, 1};
    }
    const Vec3 d = glm::normalize(glm::mat3(to_world_) * local);
    if (kind_ == Kind::radiancemeter) return {origin_, d};
    // The clipping planes are perpendicular to the optical axis, along which local.z is 1.
    const float stretch = glm::length(local);
    return {origin_ + lens_.near_clip * stretch * d, d,
            (lens_.far_clip - lens_.near_clip) * stretch};
  }

  /// The frame of light that arrives along a camera ray: x is right and y up in the picture.
  malus::Frame<float> frame(const Vec3& ray_direction) const {
    const auto upright = malus::Frame<float>::toward(-ray_direction, up_);
    return {-upright.y(), upright.x()};
  }

 private:
  Kind kind_;
  glm::mat4 to_world_;
  Vec3 origin_, up_;
  Lens lens_;
};

}  // namespace renderer
