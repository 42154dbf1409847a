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
  parallelogram_ = parallelogram(geometry, shape);
}

std::optional<AreaLight::Parallelogram> AreaLight::parallelogram(const Geometry& geometry,
                                                                 std::uint32_t shape) {
  const TriangleMesh& mesh = geometry.mesh(shape);
  if (mesh.triangles.size() != 2 || !mesh.normals.empty()) return std::nullopt;
  const auto &t = mesh.triangles[0], &other = mesh.triangles[1];
  // (a, b, c) and (c, d, a), as a rectangle is made of.
  if (other[0] != t[2] || other[2] != t[0]) return std::nullopt;
  const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]],
             &d = mesh.positions[other[1]];
  if (glm::length(a + c - b - d) > 1e-6f * glm::length(c - a)) return std::nullopt;
  return Parallelogram{a, b - a, d - a, geometry.face_normal(shape, 0)};
}

bool AreaLight::sample_sphere(const Sphere& s, const Vec3& from, const Vec2& u,
                              LightSample& light) const {
  const float opening = cone_opening(s, from);
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
    light.emission_ratio = 2 * opening / area_;
    light.radiance = radiance_;
    return true;
  }
  const Vec3 outward = square_to_sphere(u);
  return connect({s.center + s.radius * outward, s.flipped ? -outward : outward}, from, light);
}

bool AreaLight::connect(const Point& point, const Vec3& from, LightSample& light) const {
  light.position = point.position;
  const Vec3 to = light.position - from;
  const float distance2 = glm::dot(to, to);
  if (!(distance2 > 0)) return false;
  const float inverse = 1 / std::sqrt(distance2);
  light.direction = to * inverse;
  const float cos_light = -glm::dot(point.normal, light.direction);
  if (!(cos_light > 0)) return false;
  light.pdf = distance2 / (cos_light * area_);
  light.emission_ratio = cos_light * (inverse * inverse / pi);
  light.radiance = radiance_;
  return true;
}

AreaLight::Point AreaLight::sample_point(const Geometry& geometry, const Vec2& u) const {
  if (geometry.is_sphere(shape_)) {
    const Sphere& s = geometry.sphere(shape_);
    const Vec3 outward = square_to_sphere(u);
    return {s.center + s.radius * outward, s.flipped ? -outward : outward};
  }
  if (const auto& p = parallelogram_) return {p->corner + u.x * p->u + u.y * p->v, p->normal};
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
  Vec3 normal = geometry.face_normal(shape_, i);
  if (!mesh.normals.empty()) {
    const Vec3 n = (1 - uv.x - uv.y) * mesh.normals[t[0]] + uv.x * mesh.normals[t[1]] +
                   uv.y * mesh.normals[t[2]];
    if (glm::dot(n, normal) < 0) normal = -normal;
  }
  return {a + uv.x * (b - a) + uv.y * (c - a), normal};
}

bool AreaLight::sample(const Geometry& geometry, const Vec3& from, const Vec2& u,
                       LightSample& light) const {
  if (geometry.is_sphere(shape_)) return sample_sphere(geometry.sphere(shape_), from, u, light);
  return connect(sample_point(geometry, u), from, light);
}

bool AreaLight::emit(const Geometry& geometry, const Vec2& place, const Vec2& u,
                     EmissionSample& e) const {
  const Point point = sample_point(geometry, place);
  const Vec3 d = square_to_cosine_hemisphere(u);
  if (d.z <= 0) return false;
  const Basis basis(point.normal);
  e.position = point.position;
  e.normal = point.normal;
  e.reach = geometry.reach(shape_, point.normal);
  e.direction = glm::normalize(d.x * basis.s + d.y * basis.t + d.z * point.normal);
  e.power = radiance_ * (pi * area_);
  e.cosine_over_pdf = pi * area_;
  return true;
}

float AreaLight::emission_ratio(const Geometry& geometry, const EmissionSample& e,
                                const Vec3& to) const {
  if (geometry.is_sphere(shape_)) {
    const Sphere& s = geometry.sphere(shape_);
    const float opening = cone_opening(s, to);
    if (opening > 0 && !s.flipped) return 2 * opening / area_;
  }
  const Vec3 way = to - e.position;
  return glm::dot(e.normal, e.direction) / (pi * glm::dot(way, way));
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
  light = {to / std::sqrt(distance2), position, intensity / distance2, 1, true,
           1 / (4 * pi * distance2),  false};
  return true;
}

bool PointLight::emit(const Vec2& u, EmissionSample& e) const {
  e.position = position;
  e.direction = square_to_sphere(u);
  e.power = intensity * (4 * pi);
  return true;
}

Vec3 disk_point(const Geometry& geometry, const Vec3& propagation, const Vec2& u) {
  const Vec2 d = geometry.radius() * square_to_disk(u);
  const Basis basis(propagation);
  return geometry.center() + d.x * basis.s + d.y * basis.t - geometry.radius() * propagation;
}

Vec3 far_point(const Geometry& geometry, const Vec3& from, const Vec3& direction) {
  const float far = 2 * geometry.radius() + glm::length(from - geometry.center()) + 1;
  return from + far * direction;
}

bool DirectionalLight::sample(const Geometry& geometry, const Vec3& from,
                              LightSample& light) const {
  light = {-propagation, far_point(geometry, from, -propagation),
           irradiance,   1,
           true,         disk_pdf(geometry),
           true};
  return true;
}

bool DirectionalLight::emit(const Geometry& geometry, const Vec2& place, EmissionSample& e) const {
  e.position = disk_point(geometry, propagation, place);
  e.direction = propagation;
  e.power = irradiance / disk_pdf(geometry);
  e.is_at_infinity = true;
  return true;
}

bool ConstantLight::sample(const Geometry& geometry, const Vec3& from, const Vec2& u,
                           LightSample& light) const {
  const Vec3 d = square_to_sphere(u);
  light = {d, far_point(geometry, from, d), radiance, pdf(), false, disk_pdf(geometry), true};
  return true;
}

bool ConstantLight::emit(const Geometry& geometry, const Vec2& place, const Vec2& u,
                         EmissionSample& e) const {
  e.direction = -square_to_sphere(u);
  e.position = disk_point(geometry, e.direction, place);
  e.cosine_over_pdf = 1 / (pdf() * disk_pdf(geometry));
  e.power = radiance * e.cosine_over_pdf;
  e.is_at_infinity = true;
  return true;
}

bool EnvironmentLight::sample(const Geometry& geometry, const Vec3& from, const Vec2& u,
                              LightSample& light) const {
  if (!map.sample(u, light.direction, light.pdf)) return false;
  light.position = far_point(geometry, from, light.direction);
  light.radiance = map.radiance(light.direction);
  light.is_delta = false;
  light.emission_ratio = disk_pdf(geometry);
  light.is_at_infinity = true;
  return true;
}

bool EnvironmentLight::emit(const Geometry& geometry, const Vec2& place, const Vec2& u,
                            EmissionSample& e) const {
  Vec3 direction;
  float pdf = 0;
  if (!map.sample(u, direction, pdf)) return false;
  e.direction = -direction;
  e.position = disk_point(geometry, e.direction, place);
  e.cosine_over_pdf = 1 / (pdf * disk_pdf(geometry));
  e.power = map.radiance(direction) * e.cosine_over_pdf;
  e.is_at_infinity = true;
  return true;
}

}  // namespace renderer
