// SPDX-License-Identifier: MIT
// Paths from the lights, written once for both families of radiometry. What a vertex holds is a
// Stokes vector, a quarter of the matrix that a camera vertex would have to hold: light vertices
// are stored, camera vertices are not.
#pragma once

#include <algorithm>
#include <malus/radiometry.hpp>
#include <span>
#include <vector>

#include "counters.hpp"
#include "mis.hpp"
#include "roulette.hpp"
#include "way.hpp"

namespace renderer {

/// A surface's share of a BSDF with another normal than its own: light's density on it is that
/// across the real surface (Veach 1997, section 5.3.2).
template <class M>
float incident_correction(const Scatterer<M>& s, const SurfacePoint& p, const Vec3& incident) {
  return s.is_medium() ? 1.0f : s.cosine(p, incident) / s.geometric_cosine(p, incident);
}

/// Light that has arrived at a surface, or at a point in a medium, and has not been scattered
/// there.
template <class R, class M>
struct LightVertex {
  LightVertex() = default;
  LightVertex(const SurfacePoint& p, const Vec3& i, const Scatterer<M>& s,
              const typename R::Light& l, const SubpathMis& m, int e, int v)
      : point(p), incident(i), scatterer(s), light(l), mis(m), edges(e), vertex(v) {}

  SurfacePoint point;
  Vec3 incident;            ///< to where the light comes from
  Scatterer<M> scatterer;   ///< of the side it comes to; not a delta distribution
  typename R::Light light;  ///< as it left the vertex before: the path's power
  SubpathMis mis;
  int edges = 0;   ///< of the path so far; with sheets, where those count
  int vertex = 0;  ///< its number on the path, the light itself being 1

  /// The share of a scattering here of power by area, as light paths carry it.
  float correction() const { return incident_correction(scatterer, point, incident); }
};

/// The vertices of several paths, one path's after the other's.
template <class R, class M>
struct LightPaths {
  std::vector<LightVertex<R, M>> vertices;
  std::vector<std::size_t> ends;  ///< by path, one past its last vertex

  std::span<const LightVertex<R, M>> path(std::size_t i) const {
    const std::size_t begin = i > 0 ? ends[i - 1] : 0;
    return {vertices.data() + begin, ends[i] - begin};
  }
  void clear() {
    vertices.clear();
    ends.clear();
  }
};

/// Keep one a thread.
template <class R, class M>
class LightSubpath {
 public:
  LightSubpath(const Scene& scene, Counters& counters)
      : scene_(scene), counters_(counters), way_(scene) {}

  /// Walks one path from a light and appends every vertex that something can be connected to, and
  /// shows it there. Where it isn't connected to camera paths, which find the light of media by
  /// themselves, it may start in a medium.
  template <class Visit>
  void trace(Sampler& sampler, const MisFactors& factors, std::vector<LightVertex<R, M>>& vertices,
             Visit&& visit) {
    EmissionSample emission;
    if (!scene_.emit(sampler, factors.connection == 0, emission)) return;
    typename R::Light light = R::unpolarized(emission.power);
    SubpathMis mis;
    mis.vc = factors.connection * emission.cosine_over_pdf;
    way_.begin(Way<M>::of(emission));
    Ray ray = start(emission);
    Last last{emission.position, {}};
    Rgb share(1.0f);  // of the power, that unpolarised light would have kept
    const IntegratorSettings& settings = scene_.integrator;

    for (int edges = 1, vertex = 2;; ++edges) {
      // Whatever the path is connected to or merged with adds an edge at least.
      if (settings.max_depth >= 0 && edges >= settings.max_depth) return;
      Hit hit;
      ++counters_.rays;
      const End end = way_.advance(ray, hit, LightSide<R>{light, share}, sampler);
      if (end == End::nothing) return;
      const Vec3 incident = -ray.direction;
      Scatterer<M> scatterer = way_.scatterer(end);
      if (end == End::surface) {
        way_.meet(hit);
        const bool passes = scene_.lets_pass(hit, sampler);
        const Bsdf& bsdf = scene_.shapes[hit.shape].material.facing(hit, incident);
        if (passes || bsdf.is_sheet()) {
          if (!passes) light = R::scatter(bsdf.template transmit<R>(hit, ray.direction), light);
          way_.pass(ray.direction);
          ray = hit.leave(ray.direction);
          if (!settings.sheets_count) --edges;
          continue;
        }
        scatterer = Scatterer<M>(bsdf);
      }
      if (!scatterer.sides_agree(hit, incident)) return;
      arrive(mis, emission, last, hit, scatterer, ray.direction, vertex == 2);
      if (!scatterer.is_delta()) {
        ++counters_.light_vertices;
        visit(vertices.emplace_back(hit, incident, scatterer, light, mis, edges, vertex));
      }

      BsdfSampleOf<R> sample;
      const auto polarization = carried_polarization<R, M>(light, scene_);
      if (!scatterer.sample(hit, incident, Tracing::from_light, polarization, sampler, sample))
        return;
      const Vec3& exitant = sample.direction;
      if (!scatterer.sides_agree(hit, exitant)) return;
      const float cosine = scatterer.geometric_cosine(hit, exitant);
      const float correction =
          incident_correction(scatterer, hit, incident) * cosine / scatterer.cosine(hit, exitant);
      share *= sample.weight * correction;
      const float survival = survival_chance(
          settings, edges, [&] { return share; }, scatterer.is_medium());
      if (survival < 1 && !(sampler.next_1d() < survival)) return;
      share *= Rgb(1 / survival);
      light = scatter<R>(scatterer, hit, incident, Tracing::from_light, sample,
                         correction / survival, light);
      if constexpr (M::present && R::polarized)
        if (scene_.draws_by_polarization)
          share = malus::map_channels([](float s0, float p) { return p > 0 ? s0 / p : 0.0f; },
                                      light.intensity(), emission.power);
      mis.scatter(sample, cosine, factors, factors.merge(scatterer.is_medium()));
      last.position = by_components(hit.position);
      last.scatterer = scatterer;
      way_.scatter(exitant);
      ray = hit.leave(exitant);
      ++vertex;
    }
  }

 private:
  /// The vertex before.
  struct Last {
    Vec3 position;
    Scatterer<M> scatterer;
  };

  static Ray start(const EmissionSample& e) {
    if (e.normal == Vec3(0.0f)) return {e.position, e.direction};
    SurfacePoint surface;
    surface.position = e.position;
    surface.geometric_normal = e.normal;
    surface.reach = e.reach;
    return surface.leave(e.direction);
  }

  void arrive(SubpathMis& mis, const EmissionSample& emission, const Last& last, const Hit& hit,
              const Scatterer<M>& scatterer, const Vec3& direction, bool is_first) const {
    const float cosine = scatterer.geometric_cosine(hit, direction);
    const float arrival = arrival_density(scatterer, hit.position, way_.transmittance());
    if (is_first) {
      // Instead of the light's point, its emission, the first vertex might have been connected to.
      mis.vcm = 1 / scene_.emission_ratio(emission, hit.position);
      mis.arrive(cosine, arrival, arrival_chance(way_.transmittance()));
    } else {
      const Vec3 way = hit.position - last.position;
      mis.arrive(glm::dot(way, way), cosine, arrival,
                 arrival_density(last.scatterer, last.position, way_.transmittance()));
    }
  }

  const Scene& scene_;
  Counters& counters_;
  Way<M> way_;
};

}  // namespace renderer
