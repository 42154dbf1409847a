// SPDX-License-Identifier: MIT
// Where paths from the lights meet the camera: the importance that the lens emits, and what it
// measures of them.
#pragma once

#include <vector>

#include "../film/exposure.hpp"
#include "light_subpath.hpp"
#include "reading.hpp"
#include "visibility.hpp"

namespace renderer {

/// Keep one a thread.
template <class R, class M>
class Lens {
 public:
  Lens(const Scene& scene, Visibility<R, M>& visibility, Counters& counters)
      : scene_(scene), visibility_(visibility), counters_(counters) {}

  /// The density by solid angle of camera rays, one to each pixel's area; 0 of a single ray, which
  /// nothing can be connected to.
  float pdf(const Vec3& ray_direction) const {
    if (scene_.sensor->kind() == Sensor::Kind::radiancemeter) return 0;
    const auto pixels = static_cast<float>(scene_.film.width * scene_.film.height);
    return scene_.sensor->pdf(ray_direction, pixels);
  }

  /// Connects a vertex of one of `paths` light paths. `weigh` makes a weight of the density, by
  /// area or volume at the vertex, of the camera's rays arriving there, and of the BSDF's value.
  template <class Weigh>
  void connect(const LightVertex<R, M>& v, float paths, Weigh&& weigh, Sampler& sampler,
               std::vector<Splat>& splats) {
    Sensor::Projection seen;
    if (!scene_.sensor->project(v.point.position, seen) || !on_film(seen.film)) return;
    if (seen.distance < seen.near || seen.distance > seen.far) return;
    const Vec3 exitant = -seen.direction;
    if (!v.scatterer.sides_agree(v.point, exitant)) return;
    const auto value = v.scatterer.template value<R>(v.point, v.incident, exitant);
    if (malus::max_channel(value.m00) <= 0) return;
    if (!open(seen, sheets_left(v.edges), sampler)) return;

    const float cosine = v.scatterer.geometric_cosine(v.point, exitant);
    const float camera_pdf = pdf(seen.direction) * cosine / (seen.distance * seen.distance);
    const float arrival =
        arrival_density(v.scatterer, v.point.position, visibility_.transmittance());
    const float weight = weigh(camera_pdf * arrival, value);
    if (!(weight > 0)) return;
    const float w = weight * v.correction() * camera_pdf / paths;
    splat(seen, w, scatter<R>(v.scatterer, v.point, v.incident, exitant, value, v.light), splats);
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
    if (!open(seen, sheets_left(0), sampler) || (hides && visibility_.passed() == 0)) return;
    splat(seen, pdf(seen.direction) / (light.pdf * paths), R::unpolarized(light.radiance), splats);
  }

  /// Connects a point of a medium that emits: what a camera ray through it would see of it there.
  void connect_glow(Sampler& sampler, float paths, std::vector<Splat>& splats) {
    Vec3 position;
    Rgb emission;
    if (!scene_.sample_glow(sampler, position, emission)) return;
    Sensor::Projection seen;
    if (!scene_.sensor->project(position, seen) || !on_film(seen.film)) return;
    if (seen.distance < seen.near || seen.distance > seen.far) return;
    if (!open(seen, sheets_left(0), sampler)) return;
    const float w = pdf(seen.direction) / (seen.distance * seen.distance * paths);
    splat(seen, w, R::unpolarized(emission), splats);
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

  bool open(const Sensor::Projection& seen, int most_sheets, Sampler& sampler) {
    const Vec3 origin = scene_.sensor->origin() + seen.near * seen.direction;
    const Vec3 target = scene_.sensor->origin() + seen.distance * seen.direction;
    const float length = (std::min(seen.distance, seen.far) - seen.near) * (1 - 2e-4f);
    return visibility_.open({by_components(origin), by_components(seen.direction), length}, origin,
                            target, most_sheets, Way<M>::of_sensor(scene_), sampler);
  }

  /// W_e · L: the importance that the lens emits along the ray, and the light that comes along it.
  void splat(const Sensor::Projection& seen, float w, const typename R::Light& light,
             std::vector<Splat>& splats) {
    const auto reading =
        read<R>(*scene_.sensor, seen.direction, visibility_.through(light), counters_, Rgb(w));
    if (counters_.admit(reading))
      splats.push_back({seen.film * Vec2(scene_.film.width, scene_.film.height), reading});
  }

  const Scene& scene_;
  Visibility<R, M>& visibility_;
  Counters& counters_;
};

}  // namespace renderer
