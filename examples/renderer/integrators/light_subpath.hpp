// SPDX-License-Identifier: MIT
// Paths from the lights, written once for both families of radiometry. What a vertex holds is a
// Stokes vector, a quarter of the matrix that a camera vertex would have to hold: light vertices
// are stored, camera vertices are not.
#pragma once

#include <algorithm>
#include <malus/radiometry.hpp>
#include <span>
#include <vector>

#include "../scene/scene.hpp"
#include "counters.hpp"
#include "mis.hpp"
#include "roulette.hpp"

namespace renderer {

/// Light that has arrived at a surface, and has not been scattered there.
template <class R>
struct LightVertex {
  SurfacePoint point;
  Vec3 incident;            ///< to where the light comes from
  const Bsdf* bsdf;         ///< of the side it comes to; not a delta distribution
  typename R::Light light;  ///< as it left the vertex before: the path's power
  SubpathMis mis;
  int edges = 0;   ///< of the path so far; with sheets, where those count
  int vertex = 0;  ///< its number on the path, the light itself being 1
};

/// The vertices of several paths, one path's after the other's.
template <class R>
struct LightPaths {
  std::vector<LightVertex<R>> vertices;
  std::vector<std::size_t> ends;  ///< by path, one past its last vertex

  std::span<const LightVertex<R>> path(std::size_t i) const {
    const std::size_t begin = i > 0 ? ends[i - 1] : 0;
    return {vertices.data() + begin, ends[i] - begin};
  }
  void clear() {
    vertices.clear();
    ends.clear();
  }
};

/// A surface's share of a BSDF with another normal than its own: light's density on it is that
/// across the real surface (Veach 1997, section 5.3.2).
inline float incident_correction(const SurfacePoint& p, const Vec3& incident) {
  return std::abs(glm::dot(p.normal, incident) / glm::dot(p.geometric_normal, incident));
}

/// Keep one a thread.
template <class R>
class LightSubpath {
 public:
  LightSubpath(const Scene& scene, Counters& counters) : scene_(scene), counters_(counters) {}

  /// Walks one path from a light and shows every vertex that something can be connected to.
  template <class Visit>
  void trace(Sampler& sampler, const MisFactors& factors, Visit&& visit) {
    EmissionSample emission;
    if (!scene_.emit(sampler, emission)) return;
    typename R::Light light = R::unpolarized(emission.power);
    SubpathMis mis;
    mis.vc = emission.cosine_over_pdf;
    mis.vm = mis.vc * factors.vc;
    Ray ray = start(emission);
    Vec3 last = emission.position;
    Rgb share(1.0f);  // of the power, that unpolarised light would have kept
    const IntegratorSettings& settings = scene_.integrator;

    for (int edges = 1, vertex = 2;; ++edges) {
      // Whatever the path is connected to or merged with adds an edge at least.
      if (settings.max_depth >= 0 && edges >= settings.max_depth) return;
      Hit hit;
      ++counters_.rays;
      if (!scene_.intersect(ray, hit)) return;
      const Vec3 incident = -ray.direction;
      const bool passes = scene_.lets_pass(hit, sampler);
      const Bsdf& bsdf = scene_.shapes[hit.shape].material.facing(hit, incident);
      if (passes || bsdf.is_sheet()) {
        if (!passes) light = R::scatter(bsdf.template transmit<R>(hit, ray.direction), light);
        ray = hit.leave(ray.direction);
        if (!settings.sheets_count) --edges;
        continue;
      }
      if (!hit.sides_agree(incident)) return;
      arrive(mis, emission, last, hit, ray.direction, vertex == 2);
      if (!bsdf.is_delta()) {
        ++counters_.light_vertices;
        visit(LightVertex<R>{hit, incident, &bsdf, light, mis, edges, vertex});
      }

      BsdfSample sample;
      if (!bsdf.sample(hit, incident, Tracing::from_light, sampler, sample)) return;
      const Vec3& exitant = sample.direction;
      if (!hit.sides_agree(exitant)) return;
      const float cosine = std::abs(glm::dot(hit.geometric_normal, exitant));
      const float correction =
          incident_correction(hit, incident) * cosine / std::abs(glm::dot(hit.normal, exitant));
      share *= sample.weight * correction;
      const float survival = survival_chance(settings, edges, share);
      if (survival < 1 && !(sampler.next_1d() < survival)) return;
      share *= Rgb(1 / survival);
      const auto weight = bsdf.template weight<R>(hit, incident, Tracing::from_light, sample);
      light = R::scatter(weight, light) * (correction / survival);
      mis.scatter(sample, cosine, factors);
      last = hit.position;
      ray = hit.leave(exitant);
      ++vertex;
    }
  }

 private:
  static Ray start(const EmissionSample& e) {
    if (e.normal == Vec3(0.0f)) return {e.position, e.direction};
    SurfacePoint surface;
    surface.position = e.position;
    surface.geometric_normal = e.normal;
    surface.reach = e.reach;
    return surface.leave(e.direction);
  }

  void arrive(SubpathMis& mis, const EmissionSample& emission, const Vec3& last, const Hit& hit,
              const Vec3& direction, bool is_first) const {
    const float cosine = std::abs(glm::dot(hit.geometric_normal, direction));
    if (is_first) {
      // Instead of the light's point, its emission, the first vertex might have been connected to.
      mis.vcm = 1 / scene_.emission_ratio(emission, hit.position);
      mis.per_cosine(cosine);
    } else {
      const Vec3 way = hit.position - last;
      mis.arrive(glm::dot(way, way), cosine);
    }
  }

  const Scene& scene_;
  Counters& counters_;
};

}  // namespace renderer
