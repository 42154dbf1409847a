// SPDX-License-Identifier: MIT
// A scene ready to render: everything that an integrator asks of it.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "../bsdfs/material.hpp"
#include "../emitters/emitter.hpp"
#include "../film/film_settings.hpp"
#include "../geometry/geometry.hpp"
#include "../integrators/techniques.hpp"
#include "../sensors/sensor.hpp"

namespace renderer {

struct IntegratorSettings {
  std::string name = "path";
  int max_depth = -1;  ///< longest path: 1 is light seen directly, −1 no limit
  int rr_depth = 5;    ///< bounces before Russian roulette
  /// Sheets are vertices of a path, as in Mitsuba's "path"; in its "volpath" they are not.
  bool sheets_count = true;
  bool hide_emitters = false;
  float initial_radius = 0.003f;  ///< of merging, as a part of the scene's radius
  float radius_alpha = 0.75f;     ///< its square shrinks with the iterations' number to this − 1
  std::optional<Strategy> strategy;  ///< of bdpt: this one alone, unweighted
};

struct Shape {
  Material material;
  int light = -1;  ///< its area light's number, −1 if it has none
};

struct Scene {
  Geometry geometry;
  std::vector<Shape> shapes;  ///< by the geometry's numbers
  std::deque<Bsdf> bsdfs;     ///< addresses stay, as those of what follows
  std::deque<Perturbation> perturbations;
  std::deque<Texture> textures;
  std::vector<Emitter> lights;
  int environment = -1;  ///< the number of the light all around, −1 if there is none
  std::optional<Sensor> sensor;
  FilmSettings film;
  IntegratorSettings integrator;
  int samples_per_pixel = 4;
  std::uint64_t seed = 0;
  bool has_sheets = false;  ///< shadow rays may have to pass through something
  bool has_masks = false;   ///< rays may have to go on where they meet a surface
  bool polarizes = false;   ///< something can polarise light
  std::vector<std::string> warnings;

  bool intersect(const Ray& ray, Hit& hit) const {
    if (!geometry.intersect(ray, hit)) return false;
    const HitNeeds needs = shapes[hit.shape].material.needs;
    if (needs.any()) geometry.complete(needs, hit);
    return true;
  }

  /// Something may be in the way of light that doesn't stop it.
  bool has_passages() const { return has_sheets || has_masks; }
  /// Whether a ray goes on as if the surface that it has met were not there, by the chance that its
  /// mask says.
  bool lets_pass(const Hit& hit, Sampler& sampler) const {
    if (!has_masks) return false;
    const Material& material = shapes[hit.shape].material;
    return material.is_masked() && !(sampler.next_1d() < material.opacity(hit));
  }

  /// The chance that a given light is the one sampled.
  float light_choice() const { return 1 / static_cast<float>(lights.size()); }

  /// A point of a light as seen from `from`; the pdf has the choice of the light in it.
  bool sample_light(const Vec3& from, Sampler& sampler, LightSample& light) const;

  /// The start of a path from a light; power and pdf have the choice of the light in them.
  bool emit(Sampler& sampler, EmissionSample& e) const;
  /// LightSample's, of a path that emit() started and that has reached `to`.
  float emission_ratio(const EmissionSample& e, const Vec3& to) const;

  /// The radiance that leaves a hit towards `exitant` of the light's own.
  Rgb emitted(const Hit& hit, const Vec3& exitant) const;
  /// What comes from infinity in a direction that points there.
  Rgb environment_radiance(const Vec3& direction) const;
  /// The density, by solid angle from `from`, with which sample_light() finds a hit (the
  /// environment).
  float light_pdf(const Vec3& from, const Hit& hit) const;
  float environment_pdf(const Vec3& direction) const;
  /// The density, by area and solid angle, with which emit() starts from a hit of a light (comes
  /// along a direction from the environment).
  float emission_pdf(const Hit& hit, const Vec3& exitant) const;
  float environment_emission_pdf(const Vec3& direction) const {
    return environment_pdf(direction) * disk_pdf(geometry);
  }
};

}  // namespace renderer
