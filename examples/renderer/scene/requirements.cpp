// SPDX-License-Identifier: MIT
#include "requirements.hpp"

#include <algorithm>

#include "../core/warp.hpp"
#include "../film/film.hpp"
#include "../io/input_error.hpp"
#include "../io/memory.hpp"

namespace renderer {

namespace {

/// Whether the lens is inside a closed body of smooth glass: most rays in all directions then meet
/// a dielectric from within first.
bool camera_is_inside_glass(const Scene& scene) {
  constexpr int rays = 64;
  int inside = 0;
  for (int i = 0; i < rays; ++i) {
    // Fibonacci's spiral covers the sphere evenly.
    const float turn = static_cast<float>(i) * 0.618034f;
    const Vec3 d =
        square_to_sphere({(static_cast<float>(i) + 0.5f) / rays, turn - std::floor(turn)});
    Hit hit;
    if (!scene.intersect({scene.sensor->origin(), d}, hit)) continue;
    const Bsdf* bsdf = scene.shapes[hit.shape].material.front;
    if (bsdf->is_delta() && !bsdf->is_sheet() && glm::dot(hit.geometric_normal, d) > 0) ++inside;
  }
  return inside > rays * 3 / 4;
}

/// What the surfaces around something say which medium it is in: those that bound media have sides.
class Surroundings {
 public:
  explicit Surroundings(const Scene& scene) : scene_(scene) {}

  /// As far as the first boundary: on this side of it is the medium that the ray starts in.
  void look(Ray ray) {
    constexpr int most_surfaces = 64;
    Hit hit;
    for (int i = 0; i < most_surfaces && scene_.intersect(ray, hit); ++i) {
      const Shape& shape = scene_.shapes[hit.shape];
      if (shape.is_boundary)
        return note(shape.beyond(glm::dot(hit.geometric_normal, ray.direction) < 0, nullptr));
      ray = hit.leave(ray.direction);
    }
  }

  /// All boundaries agree, and on another medium than this.
  bool contradict(const Medium* declared) const {
    return found_any_ && agrees_ && medium_ != declared;
  }
  const Medium* medium() const { return medium_; }

 private:
  void note(const Medium* medium) {
    if (!found_any_) medium_ = medium;
    agrees_ &= medium == medium_;
    found_any_ = true;
  }

  const Scene& scene_;
  const Medium* medium_ = nullptr;
  bool found_any_ = false, agrees_ = true;
};

Surroundings around_sensor(const Scene& scene, Sampler& sampler) {
  Surroundings surroundings(scene);
  for (int i = 0; i < 64; ++i)
    surroundings.look({scene.sensor->origin(), square_to_sphere(sampler.next_2d())});
  return surroundings;
}

Surroundings around_light(const Scene& scene, std::size_t light, Sampler& sampler) {
  Surroundings surroundings(scene);
  for (int i = 0; i < 64; ++i) {
    const Vec2 place = sampler.next_2d(), u = sampler.next_2d();
    EmissionSample e;
    if (const auto* area = std::get_if<AreaLight>(&scene.lights[light]))
      area->emit(scene.geometry, place, u, e);
    else if (const auto* point = std::get_if<PointLight>(&scene.lights[light]))
      point->emit(u, e);
    else
      return surroundings;
    surroundings.look({e.position + e.reach * e.normal, e.direction});
  }
  return surroundings;
}

/// Media are declared for shapes' sides, the sensor and lights: where these contradict each other,
/// something has hardly been meant.
void check_declared_media(Scene& scene, const std::string& file) {
  Sampler sampler(0, 0, 0);
  const auto name = [&](const Medium* m) { return m ? scene.medium_names.at(m) : "vacuum"; };
  const auto check = [&](const Surroundings& around, const Medium* declared,
                         const std::string& what, const std::string& element) {
    if (around.contradict(declared))
      scene.warnings.push_back(file + ": " + what + " is in " + name(declared) + " by what its " +
                               element + " says, but in " + name(around.medium()) +
                               " by what all surfaces say that bound media around it");
  };
  check(around_sensor(scene, sampler), scene.sensor_medium, "the sensor", "<sensor>");
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const Location& place = scene.light_places[i];
    check(around_light(scene, i, sampler), scene.light_media[i],
          "the light of " + place.file + ":" + std::to_string(place.line), "<emitter>");
  }
}

void check_film_fits(const FilmSettings& film, const std::string& file) {
  const double pixels = static_cast<double>(film.crop_width) * film.crop_height;
  const double needed = pixels * (sizeof(PixelSum) + 12 * sizeof(float));
  if (fits_into_memory(needed)) return;
  throw InputError(film.where.file.empty() ? Location{file, 0} : film.where,
                   "a film of " + std::to_string(film.crop_width) + " x " +
                       std::to_string(film.crop_height) + " pixels takes " + in_gigabytes(needed) +
                       " of memory" + allowed_memory());
}

/// Where light paths alone bring light, they have to start in the media that emit.
void check_glows(const Scene& scene, const std::string& file) {
  for (const Medium& medium : scene.media) {
    const auto is_it = [&](const Glow& glow) { return glow.medium == &medium; };
    if (medium.emits() && std::none_of(scene.glows.begin(), scene.glows.end(), is_it))
      throw InputError(file + ": the medium " + scene.medium_names.at(&medium) +
                       " emits light and is no shape's interior: it has no end, and no light path "
                       "of \"" +
                       scene.integrator.name +
                       "\" could start there; use \"path\", \"bdpt\" or \"vcm\"");
  }
}

}  // namespace

void check_requirements(Scene& scene, const std::string& file) {
  const std::string& name = scene.integrator.name;
  check_film_fits(scene.film, file);
  if (scene.lights.empty() && scene.glows.empty()) {
    const std::string lack =
        file + ": the scene has no light: no <emitter>, of its own or of a <shape>";
    if (name == "path")
      scene.warnings.push_back(lack + "; the picture is black");
    else
      throw InputError(lack + ", from which the integrator \"" + name + "\" could trace paths");
  }
  if (scene.has_media()) check_declared_media(scene, file);
  if (scene.integrator.strategy && name != "bdpt")
    throw InputError("--strategy is for the integrator \"bdpt\", not for \"" + name + "\"");
  const auto techniques = Techniques::named(name);
  if (techniques && !techniques->connect) check_glows(scene, file);
  if (!techniques || !techniques->lens_alone) return;
  const std::string others = "; use \"path\", \"bdpt\" or \"vcm\"";
  if (scene.sensor->kind() == Sensor::Kind::radiancemeter)
    throw InputError(file +
                     ": the sensor is a single ray (radiancemeter), which no light path of " +
                     "\"ptracer\" ever meets" + others);
  if (camera_is_inside_glass(scene))
    throw InputError(file + ": the camera is inside glass, through whose smooth surface no light " +
                     "path of \"ptracer\" can be connected to it" + others);
}

}  // namespace renderer
