// SPDX-License-Identifier: MIT
// What the comparisons of integrators share: pieces of scenes, the algorithms with what is
// tolerated of each, and the check of them all against path tracing.
//
// Merging blurs light by its radius, and loses some at edges of surfaces: where photons are
// gathered, the radius is small and a part of S0, stated with each test, is tolerated.
#pragma once

#include <string>
#include <vector>

#include "stokes_agreement.hpp"

namespace agreement {

using namespace render_test;
using renderer::Hit;
using renderer::Scene;
using renderer::Vec2;
using renderer::Vec3;

inline std::string rgb(const std::string& name, const std::string& value) {
  return "<rgb name=\"" + name + "\" value=\"" + value + "\"/>";
}
inline std::string integer(const std::string& name, int value) {
  return "<integer name=\"" + name + "\" value=\"" + std::to_string(value) + "\"/>";
}
inline std::string ball(const glm::dvec3& center, double radius, const std::string& content) {
  return "<shape type=\"sphere\"><point name=\"center\" value=\"" + text(center) + "\"/>" +
         number("radius", radius) + content + "</shape>\n";
}
inline std::string camera(const std::string& film = "", const std::string& lens = number("fov", 40),
                          const glm::dvec3& target = {0, 0, 0.7}) {
  return "<sensor type=\"perspective\">" + lens + "<transform name=\"to_world\">" +
         look({0, -5, 2.5}, target, {0, 0, 1}) + "</transform><film type=\"hdrfilm\">" +
         integer("width", 64) + integer("height", 64) +
         (film.empty() ? "<rfilter type=\"box\"/>" : film) + "</film></sensor>\n";
}
inline std::string path_of(int max_depth, const std::string& more = "") {
  return "<integrator type=\"path\">" + integer("max_depth", max_depth) + integer("rr_depth", 4) +
         number("initial_radius", 0.01) + more + "</integrator>\n";
}

inline const std::string coat =
    bsdf("pplastic", rgb("diffuse_reflectance", "0.7, 0.5, 0.2") + number("alpha", 0.25));
inline const std::string metal =
    bsdf("roughconductor", "<string name=\"material\" value=\"Au\"/>" + number("alpha", 0.3));
inline const std::string grey = bsdf("diffuse", number("reflectance", 0.6));
inline const std::string black = bsdf("diffuse", number("reflectance", 0));
inline const std::string glass = bsdf("dielectric", number("int_ior", 1.5) + number("ext_ior", 1));

inline std::string emits(double radiance) {
  return "<emitter type=\"area\">" + number("radiance", radiance) + "</emitter>";
}
inline const std::string lamp = square({-0.5, -0.6, 3}, {0, 0, 0}, 0.8, black + emits(4));

/// A floor, a wall and a ball between them, which touch nowhere, so that no two points that see
/// each other are close.
inline const std::string floor_and_wall = square({0, 0, 0}, {0, 0, 1}, 2, coat, {0, 1, 0}) +
                                          square({0, 2.3, 1.9}, {0, 0, 1.6}, 1.5, metal, {0, 0, 1});
inline const std::string stage = floor_and_wall + ball({0.3, -0.3, 0.8}, 0.6, metal);

struct Algorithm {
  const char* name;
  agreement::Tolerance tolerance;
};
inline const Algorithm bdpt{"bdpt", {}}, vcm{"vcm", {.bias = 0.004}};
/// Light paths alone, and photons: most of a small cell's light may come from a few of them.
inline const Algorithm ptracer{"ptracer", {.cells = 4}}, bpm{"bpm", {.bias = 0.04, .cells = 4}},
    ppm{"ppm", {.bias = 0.04, .cells = 4}};
inline const std::vector<Algorithm> all{bdpt, ptracer, vcm, bpm, ppm}, unbiased{bdpt, ptracer, vcm},
    connecting{bdpt, vcm};

/// The pixels in which no camera ray's first surface is a delta distribution: what a light path can
/// be connected to.
inline std::vector<bool> rough_pixels(const Scene& scene) {
  constexpr int rays = 8;
  const int width = scene.film.width;
  std::vector<bool> rough;
  for (int y = 0; y < scene.film.height; ++y)
    for (int x = 0; x < width; ++x) {
      bool all_rough = true;
      for (int k = 0; k < rays * rays; ++k) {
        const Vec2 place = Vec2(x, y) + Vec2(k % rays, k / rays) / (rays - 1.0f);
        Hit hit;
        renderer::Ray ray = scene.sensor->ray(place / static_cast<float>(width));
        bool met = scene.intersect(ray, hit);
        for (; met && scene.shapes[hit.shape].material.front->is_sheet();
             met = scene.intersect(ray, hit))
          ray = hit.leave(ray.direction);
        all_rough = all_rough && !(met && scene.shapes[hit.shape].material.front->is_delta());
      }
      rough.push_back(all_rough);
    }
  return rough;
}

/// All these algorithms agree with path tracing.
inline void check_agree(Scene scene, const std::vector<Algorithm>& algorithms,
                        std::uint64_t samples, std::uint64_t path_samples = 64) {
  Picture reference = picture(scene, "path", path_samples, 1);
  std::uint64_t seed = 2;
  for (const auto& [name, tolerance] : algorithms) {
    CAPTURE(std::string(name));
    Picture other = picture(scene, name, samples, seed++);
    Picture compared = reference;
    if (name == std::string("ptracer")) {
      const auto rough = rough_pixels(scene);
      compared.use(rough);
      other.use(rough);
    }
    CHECK_AGREE_BUT_FOR(compared, other, tolerance);
  }
}

}  // namespace agreement
