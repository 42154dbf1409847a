// SPDX-License-Identifier: MIT
#include "emitter.hpp"

#include <algorithm>

#include "../core/warp.hpp"

namespace renderer {

namespace {

float triangle_area(const TriangleMesh& mesh, std::size_t i) {
  const auto& t = mesh.triangles[i];
  const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
  return 0.5f * glm::length(glm::cross(b - a, c - a));
}

/// 1 − cos of the half angle at which a sphere is seen; negative from within it.
float cone_opening(const Sphere& s, const Vec3& from) {
  const float d2 = glm::dot(s.center - from, s.center - from), r2 = s.radius * s.radius;
  if (d2 <= r2 * (1 + 1e-4f)) return -1;
  const float sin2 = r2 / d2;
  return sin2 / (1 + std::sqrt(1 - sin2));
}

/// From a density by area to one by solid angle.
float per_solid_angle(float pdf_area, float distance2, float cos_light) {
  return cos_light > 0 ? pdf_area * distance2 / cos_light : 0.0f;
}

}  // namespace

AreaLight::AreaLight(const Geometry& geometry, std::uint32_t shape, const Rgb& radiance)
    : shape_(shape), radiance_(radiance) {
  if (geometry.is_sphere(shape)) {
    const float r = geometry.sphere(shape).radius;
    area_ = 4 * pi * r * r;
    return;
  }
  const TriangleMesh& mesh = geometry.mesh(shape);
  double sum = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    sum += static_cast<double>(triangle_area(mesh, i));
    cumulative_area_.push_back(static_cast<float>(sum));
  }
  area_ = static_cast<float>(sum);
}

bool AreaLight::sample_sphere(const Sphere& s, const Vec3& from, const Vec2& u,
                              LightSample& light) const {
  const float opening = cone_opening(s, from);
  Vec3 outward;
  if (opening > 0 && !s.flipped) {
    const Vec3 axis = glm::normalize(s.center - from);
    const Vec3 d = square_to_cone(u, opening);
    const Basis basis(axis);
    light.direction = glm::normalize(d.x * basis.s + d.y * basis.t + d.z * axis);
    const float along = glm::dot(s.center - from, light.direction);
    const Vec3 across = from + along * light.direction - s.center;
    const float half_chord2 = s.radius * s.radius - glm::dot(across, across);
    light.position = from + (along - std::sqrt(std::max(half_chord2, 0.0f))) * light.direction;
    light.pdf = 1 / (2 * pi * opening);
    light.radiance = radiance_;
    return true;
  }
  outward = square_to_sphere(u);
  light.position = s.center + s.radius * outward;
  const Vec3 to = light.position - from;
  const float distance2 = glm::dot(to, to);
  if (!(distance2 > 0)) return false;
  light.direction = to / std::sqrt(distance2);
  const float cos_light = glm::dot(s.flipped ? outward : -outward, light.direction);
  light.pdf = per_solid_angle(1 / area_, distance2, cos_light);
  light.radiance = radiance_;
  return light.pdf > 0;
}

bool AreaLight::sample(const Geometry& geometry, const Vec3& from, const Vec2& u,
                       LightSample& light) const {
  if (geometry.is_sphere(shape_)) return sample_sphere(geometry.sphere(shape_), from, u, light);
  const TriangleMesh& mesh = geometry.mesh(shape_);
  const float target = u.x * area_;
  const auto found = std::upper_bound(cumulative_area_.begin(), cumulative_area_.end(), target);
  const auto i = std::min(static_cast<std::size_t>(found - cumulative_area_.begin()),
                          cumulative_area_.size() - 1);
  const float before = i > 0 ? cumulative_area_[i - 1] : 0.0f;
  const float width = cumulative_area_[i] - before;
  const float reused =
      width > 0 ? std::clamp((target - before) / width, 0.0f, 0x1.fffffep-1f) : 0.5f;

  const auto& t = mesh.triangles[i];
  const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
  const Vec2 uv = square_to_triangle({reused, u.y});
  light.position = a + uv.x * (b - a) + uv.y * (c - a);
  Vec3 normal = glm::normalize(glm::cross(b - a, c - a));
  if (!mesh.normals.empty()) {
    const Vec3 n = (1 - uv.x - uv.y) * mesh.normals[t[0]] + uv.x * mesh.normals[t[1]] +
                   uv.y * mesh.normals[t[2]];
    if (glm::dot(n, normal) < 0) normal = -normal;
  }
  const Vec3 to = light.position - from;
  const float distance2 = glm::dot(to, to);
  if (!(distance2 > 0)) return false;
  light.direction = to / std::sqrt(distance2);
  light.pdf = per_solid_angle(1 / area_, distance2, -glm::dot(normal, light.direction));
  light.radiance = radiance_;
  return light.pdf > 0;
}

float AreaLight::pdf(const Geometry& geometry, const Vec3& from, const Hit& hit) const {
  if (geometry.is_sphere(shape_)) {
    const Sphere& s = geometry.sphere(shape_);
    const float opening = cone_opening(s, from);
    if (opening > 0 && !s.flipped) return 1 / (2 * pi * opening);
  }
  const Vec3 to = hit.position - from;
  const float distance2 = glm::dot(to, to);
  if (!(distance2 > 0)) return 0;
  return per_solid_angle(1 / area_, distance2,
                         std::abs(glm::dot(hit.geometric_normal, to)) / std::sqrt(distance2));
}

bool PointLight::sample(const Vec3& from, LightSample& light) const {
  const Vec3 to = position - from;
  const float distance2 = glm::dot(to, to);
  if (!(distance2 > 0)) return false;
  light = {to / std::sqrt(distance2), position, intensity / distance2, 1, true};
  return true;
}

bool DirectionalLight::sample(const Geometry& geometry, const Vec3& from,
                              LightSample& light) const {
  const float far = 2 * geometry.radius() + glm::length(from - geometry.center()) + 1;
  light = {-propagation, from - far * propagation, irradiance, 1, true};
  return true;
}

bool ConstantLight::sample(const Geometry& geometry, const Vec3& from, const Vec2& u,
                           LightSample& light) const {
  const Vec3 d = square_to_sphere(u);
  const float far = 2 * geometry.radius() + glm::length(from - geometry.center()) + 1;
  light = {d, from + far * d, radiance, pdf(), false};
  return true;
}

}  // namespace renderer
