// SPDX-License-Identifier: MIT
#include "scene.hpp"

#include <algorithm>

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

bool Scene::emit(Sampler& sampler, EmissionSample& e) const {
  const float choice = sampler.next_1d();
  const Vec2 place = sampler.next_2d(), u = sampler.next_2d();
  if (lights.empty()) return false;
  const auto n = static_cast<float>(lights.size());
  e.light = std::min(static_cast<std::size_t>(choice * n), lights.size() - 1);
  const bool emits = std::visit(
      [&]<class L>(const L& l) {
        if constexpr (std::is_same_v<L, PointLight>)
          return l.emit(u, e);
        else if constexpr (std::is_same_v<L, DirectionalLight>)
          return l.emit(geometry, place, e);
        else
          return l.emit(geometry, place, u, e);
      },
      lights[e.light]);
  e.power *= Rgb(n);
  e.cosine_over_pdf *= n;
  return emits;
}

float Scene::emission_ratio(const EmissionSample& e, const Vec3& to) const {
  if (e.is_at_infinity) return disk_pdf(geometry);
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
