// SPDX-License-Identifier: MIT
#include "scene.hpp"

#include <algorithm>

#include "../core/warp.hpp"

namespace renderer {

bool Scene::sample_light(const Vec3& from, Sampler& sampler, LightSample& light) const {
  const float choice = sampler.next_1d();
  const Vec2 u = sampler.next_2d();
  if (lights.empty()) return false;
  const auto n = static_cast<float>(lights.size());
  const auto i = std::min(static_cast<std::size_t>(choice * n), lights.size() - 1);
  const bool found = std::visit(
      [&]<class L>(const L& l) {
        if constexpr (std::is_same_v<L, PointLight>)
          return l.sample(from, light);
        else if constexpr (std::is_same_v<L, DirectionalLight>)
          return l.sample(geometry, from, light);
        else
          return l.sample(geometry, from, u, light);
      },
      lights[i]);
  light.pdf *= light_choice();
  return found;
}

bool Scene::emit(Sampler& sampler, bool from_media, EmissionSample& e) const {
  const float choice = sampler.next_1d();
  const Vec2 place = sampler.next_2d(), u = sampler.next_2d();
  const std::size_t count = lights.size() + (from_media ? glows.size() : 0);
  if (count == 0) return false;
  const auto n = static_cast<float>(count);
  e.light = std::min(static_cast<std::size_t>(choice * n), count - 1);
  e.is_glow = e.light >= lights.size();
  if (e.is_glow) {
    const Glow& glow = glows[e.light - lights.size()];
    if (!emit_glow(glow, glow.point({place, sampler.next_1d()}), u, e)) return false;
  } else if (!emit_light(lights[e.light], place, u, e)) {
    return false;
  } else if (has_media()) {
    e.medium = light_media[e.light];
  }
  e.power *= Rgb(n);
  e.cosine_over_pdf *= n;
  return true;
}

bool Scene::emit_light(const Emitter& light, const Vec2& place, const Vec2& u,
                       EmissionSample& e) const {
  return std::visit(
      [&]<class L>(const L& l) {
        if constexpr (std::is_same_v<L, PointLight>)
          return l.emit(u, e);
        else if constexpr (std::is_same_v<L, DirectionalLight>)
          return l.emit(geometry, place, e);
        else
          return l.emit(geometry, place, u, e);
      },
      light);
}

bool Scene::emit_glow(const Glow& glow, const Vec3& place, const Vec2& direction,
                      EmissionSample& e) const {
  if (medium_around(place) != glow.medium) return false;
  e.position = place;
  e.direction = square_to_sphere(direction);
  e.power = glow.medium->emission(place) * (4 * pi * glow.volume());
  e.medium = glow.medium;
  return true;
}

bool Scene::sample_glow(Sampler& sampler, Vec3& position, Rgb& emission) const {
  const auto n = static_cast<float>(glows.size());
  const float choice = sampler.next_1d();
  const Vec2 u = sampler.next_2d();
  if (glows.empty()) return false;
  const Glow& glow = glows[std::min(static_cast<std::size_t>(choice * n), glows.size() - 1)];
  position = glow.point({u, sampler.next_1d()});
  if (medium_around(position) != glow.medium) return false;
  emission = glow.medium->emission(position) * (n * glow.volume());
  return true;
}

const Medium* Scene::medium_around(const Vec3& point) const {
  // No direction in particular, along none of the axes.
  Ray ray{point, Vec3(0.48f, 0.6f, 0.64f)};
  constexpr int most_surfaces = 256;
  Hit hit;
  for (int i = 0; i < most_surfaces && intersect(ray, hit); ++i) {
    const Shape& shape = shapes[hit.shape];
    if (shape.is_boundary)
      return shape.beyond(glm::dot(hit.geometric_normal, ray.direction) < 0, nullptr);
    ray = hit.leave(ray.direction);
  }
  return nullptr;
}

float Scene::emission_ratio(const EmissionSample& e, const Vec3& to) const {
  if (e.is_at_infinity) return disk_pdf(geometry);
  if (e.is_glow) return 1;  // nothing else starts there, to be compared with
  if (const auto* area = std::get_if<AreaLight>(&lights[e.light]))
    return area->emission_ratio(geometry, e, to);
  const Vec3 way = to - e.position;
  return 1 / (4 * pi * glm::dot(way, way));
}

Rgb Scene::emitted(const Hit& hit, const Vec3& exitant) const {
  const int i = shapes[hit.shape].light;
  if (i < 0) return Rgb(0.0f);
  return std::get<AreaLight>(lights[static_cast<std::size_t>(i)]).radiance(hit, exitant);
}

float Scene::emission_pdf(const Hit& hit, const Vec3& exitant) const {
  const auto& light =
      std::get<AreaLight>(lights[static_cast<std::size_t>(shapes[hit.shape].light)]);
  return light_choice() * light.emission_pdf(glm::dot(hit.geometric_normal, exitant));
}

Rgb Scene::environment_radiance(const Vec3& direction) const {
  if (environment < 0) return Rgb(0.0f);
  const Emitter& light = lights[static_cast<std::size_t>(environment)];
  if (const auto* picture = std::get_if<EnvironmentLight>(&light))
    return picture->map.radiance(direction);
  return std::get<ConstantLight>(light).radiance;
}

float Scene::environment_pdf(const Vec3& direction) const {
  const Emitter& light = lights[static_cast<std::size_t>(environment)];
  const auto* picture = std::get_if<EnvironmentLight>(&light);
  return light_choice() * (picture ? picture->map.pdf(direction) : ConstantLight::pdf());
}

float Scene::light_pdf(const Vec3& from, const Hit& hit) const {
  const int i = shapes[hit.shape].light;
  if (i < 0) return 0;
  return light_choice() *
         std::get<AreaLight>(lights[static_cast<std::size_t>(i)]).pdf(geometry, from, hit);
}

}  // namespace renderer
