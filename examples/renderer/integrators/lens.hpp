// SPDX-License-Identifier: MIT
// Where paths from the lights meet the camera: the importance that the lens emits, and what it
// measures of them.
#pragma once

#include <vector>

#include "../film/exposure.hpp"
#include "light_subpath.hpp"
#include "visibility.hpp"

namespace renderer {

/// Keep one a thread.
template <class R>
class Lens {
 public:
  Lens(const Scene& scene, Visibility<R>& visibility, Counters& counters)
      : scene_(scene), visibility_(visibility), counters_(counters) {}

  /// The density by solid angle of camera rays, one to each pixel's area; 0 of a single ray, which
  /// nothing can be connected to.
  float pdf(const Vec3& ray_direction) const {
    if (scene_.sensor->kind() == Sensor::Kind::radiancemeter) return 0;
    const auto pixels = static_cast<float>(scene_.film.width * scene_.film.height);
    return scene_.sensor->pdf(ray_direction, pixels);
  }

  /// Connects a vertex of one of `paths` light paths. `weigh` makes a weight of the density, by
  /// area at the vertex, of the camera's rays, and of the BSDF's value; where it is 0, nothing is
  /// traced.
  template <class Weigh>
  void connect(const LightVertex<R>& v, float paths, Weigh&& weigh, std::vector<Splat>& splats) {
    Sensor::Projection seen;
    if (!scene_.sensor->project(v.point.position, seen) || !on_film(seen.film)) return;
    if (seen.distance < seen.near || seen.distance > seen.far) return;
    const Vec3 exitant = -seen.direction;
    if (!v.point.sides_agree(exitant)) return;
    const BsdfValue value = v.bsdf->value(v.point, v.incident, exitant);
    if (malus::max_channel(value.m00) <= 0) return;

    const float cosine = std::abs(glm::dot(v.point.geometric_normal, exitant));
    const float camera_pdf = pdf(seen.direction) * cosine / (seen.distance * seen.distance);
    const float weight = weigh(camera_pdf, value);
    if (!(weight > 0) || !open(seen, sheets_left(v.edges))) return;

    const float w = weight * incident_correction(v.point, v.incident) * camera_pdf / paths;
    const auto f = v.bsdf->template scattering<R>(v.point, v.incident, exitant, value);
    splat(seen, w, R::scatter(f, v.light), splats);
  }

  /// Connects a light itself: what a camera ray that meets it would see.
  void connect_light(Sampler& sampler, float paths, std::vector<Splat>& splats) {
    // What is hidden is what nothing that counts is in front of.
    const bool hides = scene_.integrator.hide_emitters;
    if (hides && !(scene_.has_passages() && scene_.integrator.sheets_count)) return;
    LightSample light;
    const Vec3& origin = scene_.sensor->origin();
    if (!scene_.sample_light(origin, sampler, light) || light.is_delta) return;
    Sensor::Projection seen;
    if (!scene_.sensor->project(light.position, seen) || !on_film(seen.film)) return;
    if (seen.distance < seen.near || (seen.distance > seen.far && !light.is_at_infinity)) return;
    if (!open(seen, sheets_left(0)) || (hides && visibility_.passed() == 0)) return;
    splat(seen, pdf(seen.direction) / (light.pdf * paths), R::unpolarized(light.radiance), splats);
  }

 private:
  bool on_film(const Vec2& film) const {
    const FilmSettings& f = scene_.film;
    const float r = f.filter.radius();
    const Vec2 p = film * Vec2(f.width, f.height) - Vec2(f.crop_x, f.crop_y);
    return p.x > -r && p.y > -r && p.x < static_cast<float>(f.crop_width) + r &&
           p.y < static_cast<float>(f.crop_height) + r;
  }

  /// After `edges` of a path and the one to the lens.
  int sheets_left(int edges) const {
    const IntegratorSettings& s = scene_.integrator;
    if (s.max_depth < 0 || !s.sheets_count) return std::numeric_limits<int>::max();
    return s.max_depth - edges - 1;
  }

  bool open(const Sensor::Projection& seen, int most_sheets) {
    const Vec3 origin = scene_.sensor->origin() + seen.near * seen.direction;
    const Vec3 target = scene_.sensor->origin() + seen.distance * seen.direction;
    const float length = (std::min(seen.distance, seen.far) - seen.near) * (1 - 2e-4f);
    return visibility_.open({origin, seen.direction, length}, target, most_sheets);
  }

  /// W_e · L: the importance that the lens emits along the ray, and the light that comes along it.
  void splat(const Sensor::Projection& seen, float w, const typename R::Light& light,
             std::vector<Splat>& splats) {
    const auto importance = R::importance(Rgb(w), scene_.sensor->frame(seen.direction));
    const auto reading = R::measure(importance, visibility_.through(light));
    if (is_finite(reading))
      splats.push_back({seen.film * Vec2(scene_.film.width, scene_.film.height), reading});
    else
      ++counters_.non_finite;
  }

  const Scene& scene_;
  Visibility<R>& visibility_;
  Counters& counters_;
};

}  // namespace renderer
