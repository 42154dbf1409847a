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

  /// Where on the film a point is seen.
  struct Projection {
    Vec2 film;        ///< as ray() takes it; may be off the film
    Vec3 direction;   ///< from the lens to the point
    float distance;   ///< between them
    float near, far;  ///< what is nearer to the lens, or farther from it, is not seen
  };

  Sensor(Kind kind, const glm::dmat4& to_world, const Lens& lens)
      : kind_(kind),
        to_world_(to_world),
        to_local_(glm::inverse(glm::dmat3(to_world))),
        volume_(static_cast<float>(std::abs(1 / glm::determinant(glm::dmat3(to_world))))),
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

  /// Where a point is seen; false if it is behind the lens, or if the sensor is a single ray, which
  /// no point is on.
  bool project(const Vec3& point, Projection& p) const {
    if (kind_ == Kind::radiancemeter) return false;
    const Vec3 way = point - origin_, local = to_local_ * way;
    if (!(local.z > 0)) return false;
    const Vec2 tangent = Vec2(local) / local.z;
    p.film = 0.5f * (1.0f - tangent / lens_.half_extent) - lens_.principal_point;
    p.distance = glm::length(way);
    p.direction = way / p.distance;
    const float stretch = glm::length(Vec3(tangent, 1));
    p.near = lens_.near_clip * stretch;
    p.far = lens_.far_clip * stretch;
    return true;
  }

  /// The density by solid angle of rays, if there is one to each of so many parts of the film:
  /// what a sensor's importance is, per part (Veach 1997, section 8.3.2).
  float pdf(const Vec3& ray_direction, float parts) const {
    const float z = (to_local_ * ray_direction).z;
    return parts * volume_ / (4 * lens_.half_extent.x * lens_.half_extent.y * z * z * z);
  }

  /// The frame of light that arrives along a camera ray: x is right and y up in the picture. Axes
  /// of any length: rotations need no more.
  malus::Frame<float> frame(const Vec3& ray_direction) const {
    const Vec3 right = glm::cross(ray_direction, up_);
    if (glm::dot(right, right) > 1e-6f)
      return malus::Frame<float>::from_direction_and_x(-ray_direction, right);
    const auto upright = malus::Frame<float>::toward(-ray_direction, up_);
    return {-upright.y(), upright.x()};
  }

 private:
  Kind kind_;
  glm::mat4 to_world_;
  glm::mat3 to_local_;
  float volume_;  // that to_local_ gives a unit of the world's
  Vec3 origin_, up_;
  Lens lens_;
};

}  // namespace renderer
