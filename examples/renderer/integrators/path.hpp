// SPDX-License-Identifier: MIT
// Path tracing with next-event estimation and multiple importance sampling (Veach 1997), written
// once for both families of radiometry, with media and without: a camera path is an accumulator
// that light is deposited in and scattered along. Directions, roulette and MIS weights know m00
// alone; a Mueller matrix is made of what is not shadowed.
#pragma once

#include <algorithm>
#include <malus/radiometry.hpp>

#include "reading.hpp"
#include "roulette.hpp"
#include "visibility.hpp"

namespace renderer {

/// Keep one a thread.
template <class R, class M>
class PathIntegrator {
 public:
  explicit PathIntegrator(const Scene& scene)
      : scene_(scene), path_(counters_), way_(scene), visibility_(scene, counters_) {}

  /// What the sensor reads of light that arrives along one camera ray.
  malus::Measurement<Rgb> measure(const Ray& ray, Sampler& sampler) {
    ++counters_.samples;
    path_.begin(scene_.draws_by_polarization);
    walk(ray, sampler);
    counters_.count_path(path_);
    return read<R>(*scene_.sensor, ray.direction, path_.result(), counters_);
  }

  /// Whether the reading may be added up; counts it if it may not.
  bool admit(const malus::Measurement<Rgb>& reading) { return counters_.admit(reading); }
  const Counters& counters() const { return counters_; }

 private:
  /// The last vertex that light can be connected to, for MIS: where it is, and how likely the
  /// direction from it was drawn. Sheets are passed by both strategies and change neither.
  struct LastVertex {
    Vec3 position;
    float pdf = 0;
    bool is_delta = true;
  };

  void walk(Ray ray, Sampler& sampler) {
    LastVertex last{ray.origin};
    float eta = 1;  // product of relative indices: roulette must not take refraction for absorption
    const int max_depth = scene_.integrator.max_depth;
    way_.begin(Way<M>::of_sensor(scene_));
    for (int depth = 0;;) {
      Hit own_hit;
      Hit& hit = path_.place(own_hit);
      ++counters_.rays;
      const End end = way_.advance(ray, hit, CameraSide<R, M>{path_}, sampler);
      if (end == End::nothing) return deposit_environment(ray.direction, last, depth);
      const Vec3 exitant = -ray.direction;
      Scatterer<M> scatterer = way_.scatterer(end);
      bool is_passage = false;
      const Bsdf* sheet = nullptr;
      if (end == End::surface) {
        deposit_emission(hit, exitant, last, depth);
        way_.meet(hit);
        const bool passes = scene_.lets_pass(hit, sampler);
        const Bsdf& bsdf = scene_.shapes[hit.shape].material.facing(hit, exitant);
        scatterer = Scatterer<M>(bsdf);
        is_passage = passes || bsdf.is_sheet();
        if (!passes && !bsdf.is_nothing()) sheet = &bsdf;
      }
      const bool counts = scene_.integrator.sheets_count || !is_passage;
      if (counts && depth + 1 == max_depth) return;
      if (is_passage) {
        if (sheet) path_.pass(sheet->template transmit<R>(hit, exitant));
        if (counts) ++depth;
        way_.pass(ray.direction);
        ray = hit.leave(ray.direction);
        continue;
      }
      if (!scatterer.sides_agree(hit, exitant)) return;
      if (!scatterer.is_delta()) deposit_direct_light(hit, exitant, scatterer, depth, sampler);

      BsdfSampleOf<R> own_sample;
      BsdfSampleOf<R>& sample = path_.place(own_sample);
      if (!scatterer.sample(hit, exitant, Tracing::from_camera, path_.polarization(), sampler,
                            sample))
        return;
      if (!scatterer.sides_agree(hit, sample.direction)) return;
      eta *= sample.eta;
      const float survival = survival_chance(
          scene_.integrator, depth + 1,
          [&] { return path_.throughput() * sample.weight * (eta * eta); }, scatterer.is_medium());
      if (survival < 1 && !(sampler.next_1d() < survival)) return;
      path_.scatter(hit, exitant, scatterer, sample, survival < 1 ? 1 / survival : 1.0f);
      last.position = by_components(hit.position);
      last.pdf = sample.pdf;
      last.is_delta = sample.is_delta;
      ++depth;
      way_.scatter(sample.direction);
      ray = hit.leave(sample.direction);
    }
  }

  /// The balance heuristic's weight of a direction drawn by the BSDF that next-event estimation
  /// draws with density `light_pdf`.
  float bsdf_share(const LastVertex& last, float light_pdf) const {
    if (last.is_delta) return 1;
    const float pdf = last.pdf * arrival_chance(way_.transmittance());
    return pdf / (pdf + light_pdf);
  }

  void deposit_environment(const Vec3& direction, const LastVertex& last, int depth) {
    if (scene_.environment < 0 || (depth == 0 && scene_.integrator.hide_emitters)) return;
    const float share = bsdf_share(last, scene_.environment_pdf(direction));
    path_.deposit(R::unpolarized(scene_.environment_radiance(direction) * share));
  }

  void deposit_emission(const Hit& hit, const Vec3& exitant, const LastVertex& last, int depth) {
    if (scene_.shapes[hit.shape].light < 0 || (depth == 0 && scene_.integrator.hide_emitters))
      return;
    const Rgb radiance = scene_.emitted(hit, exitant);
    if (malus::max_channel(radiance) <= 0) return;
    const float share =
        last.is_delta ? 1.0f : bsdf_share(last, scene_.light_pdf(last.position, hit));
    path_.deposit(R::unpolarized(radiance * share));
  }

  MALUS_INLINE void deposit_direct_light(const Hit& hit, const Vec3& exitant,
                                         const Scatterer<M>& scatterer, int depth,
                                         Sampler& sampler) {
    LightSample light;
    if (!scene_.sample_light(hit.position, sampler, light)) return;
    if (!scatterer.sides_agree(hit, light.direction)) return;
    const auto value = scatterer.template value<R>(hit, light.direction, exitant);
    if (malus::max_channel(value.m00) <= 0) return;
    if (!visibility_.open(hit.leave_for(light.position, light.direction), hit.position,
                          light.position, sheets_left(depth), way_.towards(light.direction),
                          sampler))
      return;

    // The balance heuristic's share over the light's density.
    const float found = value.pdf_incident * arrival_chance(visibility_.transmittance());
    const float share = 1 / (light.pdf + (light.is_delta ? 0.0f : found));
    const float cosine = scatterer.cosine(hit, light.direction);
    visibility_.emitted(light.radiance * (cosine * share), [&](const auto& arriving) {
      path_.deposit(hit, light.direction, exitant, scatterer, value, arriving);
    });
  }

  /// As many sheets as a path that finds the light by itself would be allowed.
  int sheets_left(int depth) const {
    const IntegratorSettings& s = scene_.integrator;
    if (s.max_depth < 0 || !s.sheets_count) return std::numeric_limits<int>::max();
    return s.max_depth - (depth + 2);
  }

  const Scene& scene_;
  Counters counters_;
  CameraPath<R, M> path_;
  Way<M> way_;
  Visibility<R, M> visibility_;
};

}  // namespace renderer
