// SPDX-License-Identifier: MIT
#include "view.hpp"

#include <algorithm>

namespace renderer {

namespace {

using glm::dvec3;

/// Where a ray of the film meets a plane across the optical axis, from the lens.
dvec3 on_film(const Sensor& sensor, double x, double y) {
  const Ray ray = sensor.ray({static_cast<float>(x), static_cast<float>(y)});
  return dvec3(ray.direction) * static_cast<double>(ray.length);
}

}  // namespace

View::View(const Scene& scene) : kind_(scene.sensor->kind()), origin_(scene.sensor->origin()) {
  const Sensor& sensor = *scene.sensor;
  if (kind_ == Sensor::Kind::radiancemeter) {
    direction_ = sensor.ray(Vec2(0.5f)).direction;
    return;
  }
  // Filters reach beyond the film, from the middle of its last pixels; a little more is for
  // rounding.
  const FilmSettings& f = scene.film;
  const double w = f.width, h = f.height;
  const double margin = std::max(static_cast<double>(f.filter.radius()) - 0.5, 0.0) + 1e-3;
  const double left = (f.crop_x - margin) / w, right = (f.crop_x + f.crop_width + margin) / w;
  const double top = (f.crop_y - margin) / h, bottom = (f.crop_y + f.crop_height + margin) / h;
  const dvec3 corners[4] = {on_film(sensor, left, top), on_film(sensor, right, top),
                            on_film(sensor, right, bottom), on_film(sensor, left, bottom)};
  const dvec3 middle = corners[0] + corners[2];
  const auto add = [&](const dvec3& normal) {
    inwards_.push_back(glm::normalize(glm::dot(normal, middle) < 0 ? -normal : normal));
  };
  for (int i = 0; i < 4; ++i) add(glm::cross(corners[i], corners[(i + 1) % 4]));
  // Each of the others has points on its inner side that are behind the lens.
  add(glm::cross(corners[1] - corners[0], corners[3] - corners[0]));
}

bool View::may_see(const Facet& facet) const {
  if (!facet.sends_to(origin_)) return false;
  if (kind_ == Sensor::Kind::radiancemeter) return facet.may_be_met(origin_, direction_);
  const double rounding = 1e-6 * glm::length(origin_);
  return std::all_of(inwards_.begin(), inwards_.end(), [&](const dvec3& n) {
    return facet.farthest_along(n) - glm::dot(n, origin_) > -rounding;
  });
}

bool View::may_see(const Extent& extent) const {
  return extent.is_everywhere || std::any_of(extent.facets.begin(), extent.facets.end(),
                                             [&](const Facet& f) { return may_see(f); });
}

}  // namespace renderer
