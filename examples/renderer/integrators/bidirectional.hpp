// SPDX-License-Identifier: MIT
// Light tracing (Arvo 1986), bidirectional path tracing (Veach & Guibas 1994, Lafortune & Willems
// 1993), bidirectional photon mapping (Vorba 2011), progressive photon mapping (Hachisuka et al.
// 2008, Knaus & Zwicker 2011) and vertex connection and merging (Georgiev et al. 2012, Hachisuka et
// al. 2012), which has them all as parts. Written once for both families of radiometry (paper,
// sections 5.2 and 5.3):
//
//   light paths are traced first; their vertices hold Stokes vectors;
//   the camera path deposits what reaches each of its vertices by connection or merge,
//     f_z · G f_y · G L   or   f_z · G L,
//   and is swept from its far end to the lens. No matrix is ever multiplied with a matrix.
#pragma once

#include <span>

#include "connection_roulette.hpp"
#include "lens.hpp"
#include "photon_map.hpp"
#include "reading.hpp"
#include "roulette.hpp"
#include "techniques.hpp"

namespace renderer {

/// What the paths of one iteration share.
template <class R>
struct Iteration {
  float light_paths = 1;  ///< in the whole picture
  MisFactors factors;
  float merged_power = 1;  ///< what merged light is multiplied by is this over the factors' η
  const PhotonMap<R>* photons = nullptr;
  const PhotonMap<R>* media_photons = nullptr;
};

/// Keep one a thread.
template <class R, class M>
class BidirectionalIntegrator {
 public:
  /// Unless it `stores_polarization`, light at the vertices of light paths counts by its intensity
  /// alone.
  BidirectionalIntegrator(const Scene& scene, const Techniques& techniques,
                          bool stores_polarization = true)
      : scene_(scene),
        techniques_(techniques),
        stores_polarization_(stores_polarization),
        way_(scene),
        visibility_(scene, counters_),
        lens_(scene, visibility_, counters_),
        subpath_(scene, counters_),
        path_(counters_) {}

  /// Traces a light path, connects its vertices to the lens and appends them to `paths`.
  void trace_light_path(const Iteration<R>& iteration, Sampler& sampler, LightPaths<R, M>& paths,
                        std::vector<Splat>& splats) {
    const MisFactors& f = iteration.factors;
    if (techniques_.lens_alone) ++counters_.samples;
    // The one technique that the heuristic leaves out: camera paths find every light themselves.
    if (techniques_.lens_alone || selects({1, 1}))
      lens_.connect_light(sampler, iteration.light_paths, splats);
    if constexpr (M::present)
      if (techniques_.lens_alone) lens_.connect_glow(sampler, iteration.light_paths, splats);
    subpath_.trace(sampler, f, paths.vertices, [&](LightVertex<R, M>& v) {
      const auto weigh = [&](float camera_pdf, const auto& value) {
        if (techniques_.lens_alone) return 1.0f;
        const float merge = f.merge(v.scatterer.is_medium());
        const float light_side =
            camera_pdf / iteration.light_paths * v.mis.connected(value.pdf_incident, merge);
        return weight({v.vertex, 1}, mis_weight(light_side, 0));
      };
      if ((techniques_.connect && selects_or_all({v.vertex, 1})) || techniques_.lens_alone)
        lens_.connect(v, iteration.light_paths, weigh, sampler, splats);
      if (techniques_.lens_alone) return;
      if constexpr (R::polarized)
        if (!stores_polarization_) v.light = R::unpolarized(R::intensity(v.light));
      counters_.count_stored(v.light);
    });
    paths.ends.push_back(paths.vertices.size());
  }

  /// What the sensor reads along one camera ray, of a path from there and the vertices of one light
  /// path.
  malus::Measurement<Rgb> measure(const Iteration<R>& iteration, const Ray& ray, Sampler& sampler,
                                  std::span<const LightVertex<R, M>> light_path) {
    ++counters_.samples;
    iteration_ = &iteration;
    light_path_ = light_path;
    path_.begin(scene_.draws_by_polarization);
    roulette_.begin();
    walk(ray, sampler);
    counters_.count_path(path_);
    return read<R>(*scene_.sensor, ray.direction, path_.result(), counters_);
  }

  /// Whether the reading may be added up; counts it if it may not.
  bool admit(const malus::Measurement<Rgb>& reading) { return counters_.admit(reading); }
  const Counters& counters() const { return counters_; }

 private:
  /// A vertex of the camera path: light is to leave it towards `exitant`.
  struct Vertex {
    Hit& hit;
    int edges;   ///< from the lens to here; with sheets, where those count
    int number;  ///< on the path, the lens being 1
    SubpathMis mis;
    bool is_specular;  ///< the path to here has passed delta distributions alone
    Vec3 exitant{};
    Scatterer<M> scatterer{};
    float merge = 0;  ///< η of merges here
  };
  /// The vertex before.
  struct Last {
    Vec3 position;
    Scatterer<M> scatterer;
    bool is_lens;
  };

  void walk(Ray ray, Sampler& sampler) {
    const IntegratorSettings& settings = scene_.integrator;
    CameraSide<R, M> side{path_};
    SubpathMis mis;
    const float lens_pdf = lens_.pdf(ray.direction);
    if (lens_pdf > 0) mis.vcm = iteration_->light_paths / lens_pdf;
    Last last{scene_.sensor->origin(), {}, true};
    bool is_specular = true;  // the path so far has passed delta distributions alone
    float eta = 1;
    way_.begin(Way<M>::of_sensor(scene_));
    for (int edges = 1, number = 2;; ++edges) {
      Hit own_hit;
      Vertex v{path_.place(own_hit), edges, number, mis, is_specular};
      ++counters_.rays;
      side.finds_emission = finds_light(is_specular) && !settings.strategy;
      const End end = way_.advance(ray, v.hit, side, sampler);
      if (end == End::nothing) return deposit_environment(v, ray.direction, mis, last);
      v.exitant = -ray.direction;
      v.scatterer = way_.scatterer(end);
      arrive(v, last);
      if (end == End::surface) {
        deposit_emission(v, last);  // from the front, whichever side has a BSDF
        way_.meet(v.hit);
        const bool passes = scene_.lets_pass(v.hit, sampler);
        const Bsdf& bsdf = scene_.shapes[v.hit.shape].material.facing(v.hit, v.exitant);
        if (passes || bsdf.is_sheet()) {
          if (settings.sheets_count && edges == settings.max_depth) return;
          if (!passes && !bsdf.is_nothing())
            path_.pass(bsdf.template transmit<R>(v.hit, v.exitant));
          way_.pass(ray.direction);
          ray = v.hit.leave(ray.direction);
          if (!settings.sheets_count) --edges;
          continue;
        }
        v.scatterer = Scatterer<M>(bsdf);
      }
      if (edges == settings.max_depth || !v.scatterer.sides_agree(v.hit, v.exitant)) return;
      v.merge = iteration_->factors.merge(v.scatterer.is_medium());
      if (!v.scatterer.is_delta()) {
        if (techniques_.connect) {
          connect_to_light(v, sampler);
          for (const LightVertex<R, M>& light_vertex : light_path_)
            connect(v, light_vertex, sampler);
        }
        if (techniques_.merge) merge(v);
      }

      BsdfSampleOf<R> own_sample;
      BsdfSampleOf<R>& sample = path_.place(own_sample);
      if (!v.scatterer.sample(v.hit, v.exitant, Tracing::from_camera, path_.polarization(), sampler,
                              sample))
        return;
      if (techniques_.first_vertex && !sample.is_delta) return;
      if (!v.scatterer.sides_agree(v.hit, sample.direction)) return;
      eta *= sample.eta;
      const float survival = survival_chance(
          settings, edges, [&] { return path_.throughput() * sample.weight * (eta * eta); },
          v.scatterer.is_medium());
      if (survival < 1 && !(sampler.next_1d() < survival)) return;
      path_.scatter(v.hit, v.exitant, v.scatterer, sample, survival < 1 ? 1 / survival : 1.0f);
      mis = v.mis;
      mis.scatter(sample, v.scatterer.geometric_cosine(v.hit, sample.direction),
                  iteration_->factors, v.merge);
      is_specular = is_specular && sample.is_delta;
      last.position = by_components(v.hit.position);
      last.scatterer = v.scatterer;
      last.is_lens = false;
      way_.scatter(sample.direction);
      ray = v.hit.leave(sample.direction);
      ++number;
    }
  }

  void arrive(Vertex& v, const Last& last) const {
    const Vec3 way = v.hit.position - last.position;
    v.mis.arrive(glm::dot(way, way), v.scatterer.geometric_cosine(v.hit, v.exitant),
                 arrival_density(v.scatterer, v.hit.position, way_.transmittance()),
                 reverse_arrival(last));
  }
  float reverse_arrival(const Last& last) const {
    const auto& t = way_.transmittance();
    return last.is_lens ? arrival_chance(t) : arrival_density(last.scatterer, last.position, t);
  }

  /// The path has found a light by itself (s = 0).
  void deposit_emission(const Vertex& v, const Last& last) {
    if (scene_.shapes[v.hit.shape].light < 0) return;
    if (v.edges == 1 && scene_.integrator.hide_emitters) return;
    const Rgb radiance = scene_.emitted(v.hit, v.exitant);
    if (malus::max_channel(radiance) <= 0) return;
    float camera_side = 0;
    if (v.number > 2 && techniques_.connect) {
      const Vec3 way = v.hit.position - last.position;
      const float cosine = glm::dot(v.hit.geometric_normal, v.exitant);
      const float direct = scene_.light_pdf(last.position, v.hit) * cosine / glm::dot(way, way);
      camera_side = direct * v.mis.vcm + scene_.emission_pdf(v.hit, v.exitant) * v.mis.vc;
    }
    deposit_found(radiance, camera_side, v);
  }

  /// `v` tells of the path alone: there is nothing at its end.
  void deposit_environment(const Vertex& v, const Vec3& direction, SubpathMis mis,
                           const Last& last) {
    if (scene_.environment < 0 || (v.edges == 1 && scene_.integrator.hide_emitters)) return;
    float camera_side = 0;
    if (v.number > 2 && techniques_.connect) {
      mis.arrive(1, arrival_chance(way_.transmittance()), reverse_arrival(last));
      camera_side = scene_.environment_pdf(direction) * mis.vcm +
                    scene_.environment_emission_pdf(direction) * mis.vc;
    }
    deposit_found(scene_.environment_radiance(direction), camera_side, v);
  }

  /// Where photons alone are gathered, they have brought all light but what is seen in mirrors.
  bool finds_light(bool is_specular) const { return techniques_.connect || is_specular; }

  void deposit_found(const Rgb& radiance, float camera_side, const Vertex& v) {
    if (!finds_light(v.is_specular)) return;
    const float w = weight({0, v.number}, mis_weight(0, camera_side));
    if (w > 0) path_.deposit(R::unpolarized(radiance * w));
  }

  /// Next-event estimation: the vertex is connected to a point of a light (s = 1).
  void connect_to_light(const Vertex& v, Sampler& sampler) {
    LightSample light;
    if (!scene_.sample_light(v.hit.position, sampler, light)) return;
    if (!selects_or_all({1, v.number})) return;
    if (!v.scatterer.sides_agree(v.hit, light.direction)) return;
    const auto value = v.scatterer.template value<R>(v.hit, light.direction, v.exitant);
    if (malus::max_channel(value.m00) <= 0) return;

    const float camera_density = light.emission_ratio *
                                 v.scatterer.geometric_cosine(v.hit, light.direction) *
                                 v.mis.connected(value.pdf_exitant, v.merge);
    const auto weigh = [&](const auto& t) {
      const float light_side =
          light.is_delta ? 0.0f : value.pdf_incident * arrival_chance(t) / light.pdf;
      const float camera_side = camera_density * arrival_density(v.scatterer, v.hit.position, t);
      return weight({1, v.number}, mis_weight(light_side, camera_side));
    };
    const float geometry = v.scatterer.cosine(v.hit, light.direction) / light.pdf;
    float w = weigh(Way<M>::clear()), chance = 1;
    Rgb expected;
    if (!v.is_specular) {
      expected = path_.throughput() * (value.m00 * light.radiance) * (geometry * w);
      chance = play(expected, sampler);
      if (!(chance > 0)) return;
    }
    if (!visibility_.open(v.hit.leave_for(light.position, light.direction), v.hit.position,
                          light.position, sheets_left(v.edges + 1), way_.towards(light.direction),
                          sampler))
      return;

    if (!v.is_specular) roulette_.find(expected * (1 / chance));
    if constexpr (M::present) w = weigh(visibility_.transmittance());
    visibility_.emitted(light.radiance * (geometry * w / chance), [&](const auto& arriving) {
      path_.deposit(v.hit, light.direction, v.exitant, v.scatterer, value, arriving);
    });
  }

  /// The chance by which a connection is made that would bring so much; 0 if it is not.
  MALUS_INLINE float play(const Rgb& expected, Sampler& sampler) {
    const float chance = roulette_.chance(expected, scene_.integrator.connection_threshold);
    if (chance >= 1 || sampler.next_choice() < chance) return chance;
    ++counters_.left_to_chance;
    return 0;
  }

  /// Connects two vertices, z of the camera's path and y of the light's.
  void connect(const Vertex& z, const LightVertex<R, M>& y, Sampler& sampler) {
    const int sheets = sheets_left(z.edges + 1 + y.edges);
    if (sheets < 0 || !selects_or_all({y.vertex, z.number})) return;
    const Vec3 way = y.point.position - z.hit.position;
    const float distance2 = glm::dot(way, way);
    if (!(distance2 > 0)) return;
    const Vec3 to_light = way / std::sqrt(distance2), to_camera = -to_light;
    if (!z.scatterer.sides_agree(z.hit, to_light)) return;
    if (!y.scatterer.sides_agree(y.point, to_camera)) return;
    const auto at_z = z.scatterer.template value<R>(z.hit, to_light, z.exitant);
    if (malus::max_channel(at_z.m00) <= 0) return;
    const auto at_y = y.scatterer.template value<R>(y.point, y.incident, to_camera);
    if (malus::max_channel(at_y.m00) <= 0) return;

    const MisFactors& f = iteration_->factors;
    const float per_area_y = y.scatterer.geometric_cosine(y.point, to_camera) / distance2;
    const float per_area_z = z.scatterer.geometric_cosine(z.hit, to_light) / distance2;
    const float light_density =
        at_z.pdf_incident * per_area_y *
        y.mis.connected(at_y.pdf_incident, f.merge(y.scatterer.is_medium()));
    const float camera_density =
        at_y.pdf_exitant * per_area_z * z.mis.connected(at_z.pdf_exitant, z.merge);
    const auto weigh = [&](const auto& t) {
      const float light_side = light_density * arrival_density(y.scatterer, y.point.position, t);
      const float camera_side = camera_density * arrival_density(z.scatterer, z.hit.position, t);
      return weight({y.vertex, z.number}, mis_weight(light_side, camera_side));
    };
    const float geometry = z.scatterer.cosine(z.hit, to_light) * per_area_y * y.correction();
    float w = weigh(Way<M>::clear());
    const Rgb expected =
        path_.throughput() * (at_z.m00 * at_y.m00) * (R::intensity(y.light) * (geometry * w));
    const float chance = play(expected, sampler);
    if (!(chance > 0)) return;
    if (!visibility_.open(z.hit.leave_for(y.point, to_light), z.hit.position, y.point.position,
                          sheets, way_.towards(to_light), sampler))
      return;

    roulette_.find(expected * (1 / chance));
    if constexpr (M::present) w = weigh(visibility_.transmittance());
    const bool reads_polarization = z.scatterer.polarizes() || visibility_.may_polarize();
    const auto leaving =
        scatter<R>(y.scatterer, y.point, y.incident, to_camera, at_y, y.light, reads_polarization);
    const auto arriving = visibility_.through(leaving, geometry * w / chance);
    path_.deposit(z.hit, to_light, z.exitant, z.scatterer, at_z, arriving);
  }

  /// Density estimation: the photons near the vertex, each scattered from where it came.
  void merge(const Vertex& v) {
    const bool in_medium = v.scatterer.is_medium();
    const PhotonMap<R>& photons = in_medium ? *iteration_->media_photons : *iteration_->photons;
    const float normalization = iteration_->merged_power / (v.merge * opacity(v));
    const bool reads_polarization = v.scatterer.polarizes();
    photons.each_near(v.hit.position, [&](const Photon& photon, std::size_t i) {
      const int edges = static_cast<int>(photon.edges) + v.edges;
      if (scene_.integrator.max_depth >= 0 && edges > scene_.integrator.max_depth) return;
      // A photon on the other side, or on a wall across a corner, is not here.
      if (!in_medium && glm::dot(photon.geometric_normal, v.hit.geometric_normal) < 0.5f) return;
      if (!v.scatterer.sides_agree(v.hit, photon.incident)) return;
      const auto value = v.scatterer.template value<R>(v.hit, photon.incident, v.exitant);
      if (malus::max_channel(value.m00) <= 0) return;
      float w = normalization * incident_correction(v.scatterer, v.hit, photon.incident);
      if (!techniques_.first_vertex) {
        const MisFactors& f = iteration_->factors;
        w *= mis_weight(photon.mis.merged(value.pdf_incident, f, v.merge),
                        v.mis.merged(value.pdf_exitant, f, v.merge));
      }
      const auto light =
          reads_polarization ? photons.light(photon, i) : R::unpolarized(photon.intensity);
      counters_.count_merged(light);
      path_.deposit(v.hit, photon.incident, v.exitant, v.scatterer, value, light * w);
    });
  }

  /// The chance that a path stops at a mask: photons and the camera's path have both drawn it.
  float opacity(const Vertex& v) const {
    if (!scene_.has_masks || v.scatterer.is_medium()) return 1;
    const Material& material = scene_.shapes[v.hit.shape].material;
    return material.is_masked() ? material.opacity(v.hit) : 1.0f;
  }

  /// A connection's weight: the heuristic's, or, where one strategy is asked for alone, 1 or 0.
  float weight(const Strategy& strategy, float heuristic) const {
    if (!scene_.integrator.strategy) return heuristic;
    return selects(strategy) ? 1.0f : 0.0f;
  }
  bool selects(const Strategy& strategy) const { return scene_.integrator.strategy == strategy; }
  bool selects_or_all(const Strategy& strategy) const {
    return !scene_.integrator.strategy || selects(strategy);
  }

  /// How many sheets may count beside `edges`; negative if there are too many edges already.
  int sheets_left(int edges) const {
    const IntegratorSettings& s = scene_.integrator;
    if (s.max_depth < 0) return std::numeric_limits<int>::max();
    if (!s.sheets_count && edges <= s.max_depth) return std::numeric_limits<int>::max();
    return s.max_depth - edges;
  }

  const Scene& scene_;
  const Techniques techniques_;
  const bool stores_polarization_;
  Counters counters_;
  Way<M> way_;
  Visibility<R, M> visibility_;
  Lens<R, M> lens_;
  LightSubpath<R, M> subpath_;
  CameraPath<R, M> path_;
  ConnectionRoulette roulette_;
  const Iteration<R>* iteration_ = nullptr;
  std::span<const LightVertex<R, M>> light_path_;
};

}  // namespace renderer
