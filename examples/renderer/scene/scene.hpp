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
#include "../emitters/glow.hpp"
#include "../film/film_settings.hpp"
#include "../geometry/geometry.hpp"
#include "../integrators/techniques.hpp"
#include "../io/input_error.hpp"
#include "../media/medium.hpp"
#include "../sensors/sensor.hpp"

namespace renderer {

struct IntegratorSettings {
  std::string name = "path";
  int max_depth = -1;  ///< longest path: 1 is light seen directly, −1 no limit
  int rr_depth = 5;    ///< bounces before Russian roulette
  /// Sheets are vertices of a path, as in Mitsuba's "path"; in its "volpath" they are not.
  bool sheets_count = true;
  bool hide_emitters = false;
  float initial_radius = 0.003f;       ///< of merging, as a part of the scene's radius
  float initial_media_radius = 0.01f;  ///< the same of merging in media
  float radius_alpha =
      0.75f;  ///< its square (cube) shrinks with the iterations' number to this − 1
  /// Connections that bring less than this part of a path's indirect light are left to chance.
  float connection_threshold = 0.125f;
  std::optional<Strategy> strategy;  ///< of bdpt: this one alone, unweighted
};

struct Shape {
  Material material;
  int light = -1;  ///< its area light's number, −1 if it has none
  /// Something else is behind the surface than before it. Else what is around goes on.
  bool is_boundary = false;
  const Medium* interior = nullptr;  ///< null: vacuum
  const Medium* exterior = nullptr;  ///< where the geometric normal points to

  /// The medium on one side, `around` being what is there if the surface bounds nothing.
  const Medium* beyond(bool outside, const Medium* around) const {
    return !is_boundary ? around : outside ? exterior : interior;
  }
};

/// What a scene file calls something, and where; for messages.
struct Origin {
  std::string type, id;
  Location where;
};

struct Scene {
  Geometry geometry;
  std::vector<Shape> shapes;  ///< by the geometry's numbers
  std::deque<Bsdf> bsdfs;     ///< addresses stay, as those of what follows
  std::deque<Perturbation> perturbations;
  std::deque<Texture> textures;
  std::deque<Medium> media;
  std::vector<Emitter> lights;
  std::vector<Glow> glows;  ///< the media that emit
  int environment = -1;     ///< the number of the light all around, −1 if there is none
  std::optional<Sensor> sensor;
  const Medium* sensor_medium = nullptr;              ///< that the sensor is in; null in vacuum
  std::vector<const Medium*> light_media;             ///< that the lights send their light into
  std::map<const Medium*, std::string> medium_names;  ///< for messages
  std::vector<Location> light_places;                 ///< where the file has the lights
  std::vector<Origin> shape_origins;                  ///< by the geometry's numbers
  std::map<const Bsdf*, Origin> bsdf_origins;         ///< but of those that stand for no <bsdf>
  FilmSettings film;
  IntegratorSettings integrator;
  int samples_per_pixel = 4;
  std::uint64_t seed = 0;
  bool has_sheets = false;  ///< shadow rays may have to pass through something
  bool has_masks = false;   ///< rays may have to go on where they meet a surface
  bool polarizes = false;   ///< something can polarise light
  /// Media that polarise what they scatter draw directions by the polarisation of what a path
  /// carries, too.
  bool draws_by_polarization = false;
  std::vector<std::string> warnings;

  bool intersect(const Ray& ray, Hit& hit) const {
    return geometry.intersect(ray, hit) && complete(hit);
  }
  /// The same of the surfaces alone that may let light pass.
  bool intersect_passages(const Ray& ray, Hit& hit) const {
    return geometry.intersect_passages(ray, hit) && complete(hit);
  }

  bool has_media() const { return !media.empty(); }
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

  /// The start of a path from a light, or from within a medium that emits if light paths have to
  /// bring that light too; power and pdf have the choice of the light in them.
  bool emit(Sampler& sampler, bool from_media, EmissionSample& e) const;
  /// A point of a medium that emits: radiance by length is `emission`, already divided by the
  /// point's density by volume.
  bool sample_glow(Sampler& sampler, Vec3& position, Rgb& emission) const;
  /// The medium around a point, which the next boundary's side tells; null in vacuum.
  const Medium* medium_around(const Vec3& point) const;
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

 private:
  bool emit_light(const Emitter& light, const Vec2& place, const Vec2& u, EmissionSample& e) const;
  bool emit_glow(const Glow& glow, const Vec3& place, const Vec2& direction,
                 EmissionSample& e) const;
  bool complete(Hit& hit) const {
    const HitNeeds needs = shapes[hit.shape].material.needs;
    if (needs.any()) geometry.complete(needs, hit);
    return true;
  }
};

}  // namespace renderer
