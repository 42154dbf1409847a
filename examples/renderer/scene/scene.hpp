// SPDX-License-Identifier: MIT
// A scene ready to render: everything that an integrator asks of it.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "../bsdfs/bsdf.hpp"
#include "../emitters/emitter.hpp"
#include "../film/reconstruction_filter.hpp"
#include "../geometry/geometry.hpp"
#include "../sensors/sensor.hpp"

namespace renderer {

struct FilmSettings {
  int width = 768, height = 576;  ///< of the whole film
  int crop_x = 0, crop_y = 0, crop_width = 768, crop_height = 576;
  ReconstructionFilter filter;
};

struct IntegratorSettings {
  std::string name = "path";
  int max_depth = -1;  ///< longest path: 1 is light seen directly, −1 no limit
  int rr_depth = 5;    ///< bounces before Russian roulette
  /// Sheets are vertices of a path, as in Mitsuba's "path"; in its "volpath" they are not.
  bool sheets_count = true;
  bool hide_emitters = false;
};

struct Shape {
  Material material;
  bool needs_tangent = false;
  int light = -1;  ///< its area light's number, −1 if it has none
};

struct Scene {
  Geometry geometry;
  std::vector<Shape> shapes;  ///< by the geometry's numbers
  std::deque<Bsdf> bsdfs;     ///< addresses stay
  std::vector<Emitter> lights;
  int environment = -1;  ///< the constant light's number, −1 if there is none
  std::optional<Sensor> sensor;
  FilmSettings film;
  IntegratorSettings integrator;
  int samples_per_pixel = 4;
  std::uint64_t seed = 0;
  bool has_sheets = false;  ///< shadow rays may have to pass through something
  bool polarizes = false;   ///< something can polarise light
  std::vector<std::string> warnings;

  bool intersect(const Ray& ray, Hit& hit) const {
    if (!geometry.intersect(ray, hit)) return false;
    if (shapes[hit.shape].needs_tangent) hit.tangent = geometry.tangent(hit);
    return true;
  }

  /// The chance that a given light is the one sampled.
  float light_choice() const { return 1 / static_cast<float>(lights.size()); }

  /// A point of a light as seen from `from`; the pdf has the choice of the light in it.
  bool sample_light(const Vec3& from, Sampler& sampler, LightSample& light) const;

  /// The radiance that leaves a hit towards `exitant` of the light's own.
  Rgb emitted(const Hit& hit, const Vec3& exitant) const;
  Rgb environment_radiance() const;
  /// The density, by solid angle from `from`, with which sample_light() finds a hit (the
  /// environment).
  float light_pdf(const Vec3& from, const Hit& hit) const;
  float environment_pdf() const { return light_choice() * ConstantLight::pdf(); }
};

}  // namespace renderer
