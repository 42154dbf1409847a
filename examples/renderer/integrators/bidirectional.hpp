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

#include "lens.hpp"
#include "photon_map.hpp"
#include "roulette.hpp"
#include "techniques.hpp"

namespace renderer {

/// What the paths of one iteration share.
template <class R>
struct Iteration {
  float light_paths = 1;          ///< in the whole picture
  float merge_normalization = 0;  ///< 1/(π r² n), n paths being in the photon map
  MisFactors factors;
  const PhotonMap<R>* photons = nullptr;
};

/// Keep one a thread.
template <class R>
class BidirectionalIntegrator {
 public:
  BidirectionalIntegrator(const Scene& scene, const Techniques& techniques)
      : scene_(scene),
        techniques_(techniques),
        visibility_(scene, counters_),
        lens_(scene, visibility_, counters_),
        subpath_(scene, counters_) {}

  /// Traces a light path, connects its vertices to the lens and appends them to `paths`.
  void trace_light_path(const Iteration<R>& iteration, Sampler& sampler, LightPaths<R>& paths,
                        std::vector<Splat>& splats) {
    const MisFactors& f = iteration.factors;
    if (techniques_.lens_alone) ++counters_.samples;
    // The one technique that the heuristic leaves out: camera paths find every light themselves.
    if (techniques_.lens_alone || selects({1, 1}))
      lens_.connect_light(sampler, iteration.light_paths, splats);
    subpath_.trace(sampler, f, [&](const LightVertex<R>& v) {
      const auto weigh = [&](float camera_pdf, const BsdfValue& value) {
        if (techniques_.lens_alone) return 1.0f;
        const float light_side =
            camera_pdf / iteration.light_paths * v.mis.connected(value.pdf_incident, f);
        return weight({v.vertex, 1}, mis_weight(light_side, 0));
      };
      if (techniques_.connect || techniques_.lens_alone)
        lens_.connect(v, iteration.light_paths, weigh, splats);
      if (!techniques_.lens_alone) paths.vertices.push_back(v);
    });
    paths.ends.push_back(paths.vertices.size());
  }

  /// What the sensor reads along one camera ray, of a path from there and the vertices of one light
  /// path.
  malus::Measurement<Rgb> measure(const Iteration<R>& iteration, const Ray& ray, Sampler& sampler,
                                  std::span<const LightVertex<R>> light_path) {
    ++counters_.samples;
    iteration_ = &iteration;
    light_path_ = light_path;
    path_.begin();
    walk(ray, sampler);
    const auto importance = R::importance(Rgb(1.0f), scene_.sensor->frame(ray.direction));
    return R::measure(importance, path_.result());
  }

  /// The last reading was not finite, and is not used.
  void drop() { ++counters_.non_finite; }
  const Counters& counters() const { return counters_; }

 private:
  /// A vertex of the camera path: light is to leave it towards `exitant`.
  struct Vertex {
    Hit hit;
    Vec3 exitant;
    const Bsdf* bsdf;
    SubpathMis mis;
    int edges;   ///< from the lens to here; with sheets, where those count
    int number;  ///< on the path, the lens being 1
  };

  void walk(Ray ray, Sampler& sampler) {
    const IntegratorSettings& settings = scene_.integrator;
    SubpathMis mis;
    const float lens_pdf = lens_.pdf(ray.direction);
    if (lens_pdf > 0) mis.vcm = iteration_->light_paths / lens_pdf;
    Vec3 last = scene_.sensor->origin();
    bool is_specular = true;  // the path so far has passed delta distributions alone
    float eta = 1;
    Vertex v;
    v.number = 2;
    for (v.edges = 1;; ++v.edges) {
      ++counters_.rays;
      if (!scene_.intersect(ray, v.hit))
        return deposit_environment(ray.direction, mis, v.edges, v.number, is_specular);
      v.exitant = -ray.direction;
      v.mis = mis;
      const Vec3 way = v.hit.position - last;
      v.mis.arrive(glm::dot(way, way), std::abs(glm::dot(v.hit.geometric_normal, ray.direction)));
      deposit_emission(v, last, is_specular);  // from the front, whichever side has a BSDF
      const bool passes = scene_.lets_pass(v.hit, sampler);
      v.bsdf = &scene_.shapes[v.hit.shape].material.facing(v.hit, v.exitant);
      if (passes || v.bsdf->is_sheet()) {
        if (settings.sheets_count && v.edges == settings.max_depth) return;
        if (!passes) scatter(v.bsdf->template transmit<R>(v.hit, v.exitant), 1);
        ray = v.hit.leave(ray.direction);
        if (!settings.sheets_count) --v.edges;
        continue;
      }
      if (v.edges == settings.max_depth || !v.hit.sides_agree(v.exitant)) return;
      if (!v.bsdf->is_delta()) {
        if (techniques_.connect) {
          connect_to_light(v, sampler);
          for (const LightVertex<R>& light_vertex : light_path_) connect(v, light_vertex);
        }
        if (techniques_.merge) merge(v);
      }

      BsdfSample sample;
      if (!v.bsdf->sample(v.hit, v.exitant, Tracing::from_camera, sampler, sample)) return;
      if (techniques_.first_vertex && !sample.is_delta) return;
      if (!v.hit.sides_agree(sample.direction)) return;
      eta *= sample.eta;
      const float survival =
          survival_chance(settings, v.edges, path_.throughput() * sample.weight * (eta * eta));
      if (survival < 1 && !(sampler.next_1d() < survival)) return;
      scatter(v.bsdf->template weight<R>(v.hit, v.exitant, Tracing::from_camera, sample), survival);
      mis = v.mis;
      mis.scatter(sample, std::abs(glm::dot(v.hit.geometric_normal, sample.direction)),
                  iteration_->factors);
      is_specular = is_specular && sample.is_delta;
      last = v.hit.position;
      ray = v.hit.leave(sample.direction);
      ++v.number;
    }
  }

  void scatter(const typename R::Scattering& weight, float survival) {
    if constexpr (R::polarized) ++counters_.forms[static_cast<std::size_t>(weight.form())];
    if (survival < 1)
      path_.scatter(weight * (1 / survival));
    else
      path_.scatter(weight);
  }

  /// The path has found a light by itself (s = 0).
  void deposit_emission(const Vertex& v, const Vec3& last, bool is_specular) {
    if (scene_.shapes[v.hit.shape].light < 0) return;
    if (v.edges == 1 && scene_.integrator.hide_emitters) return;
    const Rgb radiance = scene_.emitted(v.hit, v.exitant);
    if (malus::max_channel(radiance) <= 0) return;
    float camera_side = 0;
    if (v.number > 2 && techniques_.connect) {
      const Vec3 way = v.hit.position - last;
      const float cosine = glm::dot(v.hit.geometric_normal, v.exitant);
      const float direct = scene_.light_pdf(last, v.hit) * cosine / glm::dot(way, way);
      camera_side = direct * v.mis.vcm + scene_.emission_pdf(v.hit, v.exitant) * v.mis.vc;
    }
    deposit_found(radiance, camera_side, v.number, is_specular);
  }

  void deposit_environment(const Vec3& direction, const SubpathMis& mis, int edges, int number,
                           bool is_specular) {
    if (scene_.environment < 0 || (edges == 1 && scene_.integrator.hide_emitters)) return;
    float camera_side = 0;
    if (number > 2 && techniques_.connect)
      camera_side = scene_.environment_pdf(direction) * mis.vcm +
                    scene_.environment_emission_pdf(direction) * mis.vc;
    deposit_found(scene_.environment_radiance(direction), camera_side, number, is_specular);
  }

  void deposit_found(const Rgb& radiance, float camera_side, int number, bool is_specular) {
    // Where photons alone are gathered, they have brought all other light.
    if (!techniques_.connect && !is_specular) return;
    const float w = weight({0, number}, mis_weight(0, camera_side));
    if (w > 0) path_.deposit(R::unpolarized(radiance * w));
  }

  /// Next-event estimation: the vertex is connected to a point of a light (s = 1).
  void connect_to_light(const Vertex& v, Sampler& sampler) {
    LightSample light;
    if (!scene_.sample_light(v.hit.position, sampler, light)) return;
    if (!selects_or_all({1, v.number}) || !v.hit.sides_agree(light.direction)) return;
    const BsdfValue value = v.bsdf->value(v.hit, light.direction, v.exitant);
    if (malus::max_channel(value.m00) <= 0) return;

    const float light_side = light.is_delta ? 0.0f : value.pdf_incident / light.pdf;
    const float camera_side = light.emission_ratio *
                              std::abs(glm::dot(v.hit.geometric_normal, light.direction)) *
                              v.mis.connected(value.pdf_exitant, iteration_->factors);
    const float w = weight({1, v.number}, mis_weight(light_side, camera_side)) / light.pdf;
    if (!visibility_.open(v.hit.leave_for(light.position, light.direction), light.position,
                          sheets_left(v.edges + 1)))
      return;
    const float cosine = std::abs(glm::dot(v.hit.normal, light.direction));
    const auto f = v.bsdf->template scattering<R>(v.hit, light.direction, v.exitant, value);
    const auto arriving = visibility_.through(R::unpolarized(light.radiance));
    path_.deposit(R::scatter(f, arriving) * (cosine * w));
  }

  /// Connects two vertices, z of the camera's path and y of the light's.
  void connect(const Vertex& z, const LightVertex<R>& y) {
    const int sheets = sheets_left(z.edges + 1 + y.edges);
    if (sheets < 0 || !selects_or_all({y.vertex, z.number})) return;
    const Vec3 way = y.point.position - z.hit.position;
    const float distance2 = glm::dot(way, way);
    if (!(distance2 > 0)) return;
    const Vec3 to_light = way / std::sqrt(distance2), to_camera = -to_light;
    if (!z.hit.sides_agree(to_light) || !y.point.sides_agree(to_camera)) return;
    const BsdfValue at_z = z.bsdf->value(z.hit, to_light, z.exitant);
    if (malus::max_channel(at_z.m00) <= 0) return;
    const BsdfValue at_y = y.bsdf->value(y.point, y.incident, to_camera);
    if (malus::max_channel(at_y.m00) <= 0) return;

    const MisFactors& f = iteration_->factors;
    const float per_area_y = std::abs(glm::dot(y.point.geometric_normal, to_camera)) / distance2;
    const float per_area_z = std::abs(glm::dot(z.hit.geometric_normal, to_light)) / distance2;
    const float light_side = at_z.pdf_incident * per_area_y * y.mis.connected(at_y.pdf_incident, f);
    const float camera_side = at_y.pdf_exitant * per_area_z * z.mis.connected(at_z.pdf_exitant, f);
    const float w = weight({y.vertex, z.number}, mis_weight(light_side, camera_side));
    if (!visibility_.open(z.hit.leave_for(y.point, to_light), y.point.position, sheets)) return;

    const float geometry = std::abs(glm::dot(z.hit.normal, to_light)) * per_area_y *
                           incident_correction(y.point, y.incident);
    const auto f_y = y.bsdf->template scattering<R>(y.point, y.incident, to_camera, at_y);
    const auto f_z = z.bsdf->template scattering<R>(z.hit, to_light, z.exitant, at_z);
    const auto arriving = visibility_.through(R::scatter(f_y, y.light));
    path_.deposit(R::scatter(f_z, arriving) * (geometry * w));
  }

  /// Density estimation: the photons near the vertex, each scattered from where it came.
  void merge(const Vertex& v) {
    const IntegratorSettings& settings = scene_.integrator;
    const MisFactors& factors = iteration_->factors;
    const float normalization = iteration_->merge_normalization / opacity(v.hit);
    iteration_->photons->each_near(v.hit.position, [&](const Photon<R>& photon) {
      if (settings.max_depth >= 0 && photon.edges + v.edges > settings.max_depth) return;
      // A photon on the other side, or on a wall across a corner, is not here.
      if (glm::dot(photon.geometric_normal, v.hit.geometric_normal) < 0.5f) return;
      if (!v.hit.sides_agree(photon.incident)) return;
      const BsdfValue value = v.bsdf->value(v.hit, photon.incident, v.exitant);
      if (malus::max_channel(value.m00) <= 0) return;
      ++counters_.merges;
      float w = normalization * incident_correction(v.hit, photon.incident);
      if (!techniques_.first_vertex)
        w *= mis_weight(photon.vcm * factors.vc + photon.vm * value.pdf_incident,
                        v.mis.merged(value.pdf_exitant, factors));
      const auto f = v.bsdf->template scattering<R>(v.hit, photon.incident, v.exitant, value);
      path_.deposit(R::scatter(f, photon.light) * w);
    });
  }

  /// The chance that a path stops at a mask: photons and the camera's path have both drawn it.
  float opacity(const Hit& hit) const {
    if (!scene_.has_masks) return 1;
    const Material& material = scene_.shapes[hit.shape].material;
    return material.is_masked() ? material.opacity(hit) : 1.0f;
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
  Counters counters_;
  Visibility<R> visibility_;
  Lens<R> lens_;
  LightSubpath<R> subpath_;
  typename R::CameraPath path_;
  const Iteration<R>* iteration_ = nullptr;
  std::span<const LightVertex<R>> light_path_;
};

}  // namespace renderer
