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

Rgb Scene::emitted(const Hit& hit, const Vec3& exitant) const {
  const int i = shapes[hit.shape].light;
  if (i < 0) return Rgb(0.0f);
  return std::get<AreaLight>(lights[static_cast<std::size_t>(i)]).radiance(hit, exitant);
}

Rgb Scene::environment_radiance() const {
  if (environment < 0) return Rgb(0.0f);
  return std::get<ConstantLight>(lights[static_cast<std::size_t>(environment)]).radiance;
}

float Scene::light_pdf(const Vec3& from, const Hit& hit) const {
  const int i = shapes[hit.shape].light;
  if (i < 0) return 0;
  return light_choice() *
         std::get<AreaLight>(lights[static_cast<std::size_t>(i)]).pdf(geometry, from, hit);
}

}  // namespace renderer
