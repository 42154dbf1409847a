// SPDX-License-Identifier: MIT
// Path tracing with next-event estimation and multiple importance sampling (Veach 1997), written
// once for both families of radiometry: a camera path is an accumulator that light is deposited in
// and scattered along. Directions, roulette and MIS weights know m00 alone; a Mueller matrix is
// made of what is not shadowed.
#pragma once

#include <algorithm>
#include <malus/radiometry.hpp>

#include "../scene/scene.hpp"
#include "counters.hpp"

namespace renderer {

/// Keep one a thread.
template <class R>
class PathIntegrator {
 public:
  explicit PathIntegrator(const Scene& scene) : scene_(scene) {}

  /// What the sensor reads of light that arrives along one camera ray.
  malus::Measurement<Rgb> measure(const Ray& ray, Sampler& sampler) {
    path_.begin();
    walk(ray, sampler);
    return R::measure(path_.result(), scene_.sensor->frame(ray.direction));
  }

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
    for (int depth = 0;;) {
      Hit hit;
      ++counters_.rays;
      if (!scene_.intersect(ray, hit)) return deposit_environment(last, depth);
      const Vec3 exitant = -ray.direction;
      deposit_emission(hit, exitant, last, depth);

      const Bsdf& bsdf = scene_.shapes[hit.shape].material.facing(hit, exitant);
      const bool counts = scene_.integrator.sheets_count || !bsdf.is_sheet();
      if (counts && depth + 1 == max_depth) return;
      if (!hit.sides_agree(exitant)) return;
      if (!bsdf.is_delta()) deposit_direct_light(hit, exitant, bsdf, depth, sampler);

      BsdfSample sample;
      if (!bsdf.sample(hit, exitant, sampler, sample)) return;
      if (!hit.sides_agree(sample.incident)) return;
      eta *= sample.eta;
      float survival = 1;
      if (depth + 1 >= scene_.integrator.rr_depth) {
        survival =
            std::min(malus::max_channel(path_.throughput() * sample.weight) * eta * eta, 0.95f);
        if (!(sampler.next_1d() < survival)) return;
      }
      scatter(bsdf.template weight<R>(hit, exitant, sample), survival);
      if (!bsdf.is_sheet()) last = {hit.position, sample.pdf, sample.is_delta};
      if (counts) ++depth;
      ray = hit.leave(sample.incident);
    }
  }

  void scatter(const typename R::Scattering& weight, float survival) {
    if constexpr (R::polarized) ++counters_.forms[static_cast<std::size_t>(weight.form())];
    if (survival < 1)
      path_.scatter(weight * (1 / survival));
    else
      path_.scatter(weight);
  }

  /// The balance heuristic's weight of a direction drawn by the BSDF that next-event estimation
  /// draws with density `light_pdf`.
  static float bsdf_share(const LastVertex& last, float light_pdf) {
    return last.is_delta ? 1.0f : last.pdf / (last.pdf + light_pdf);
  }

  void deposit_environment(const LastVertex& last, int depth) {
    if (scene_.environment < 0 || (depth == 0 && scene_.integrator.hide_emitters)) return;
    const float share = bsdf_share(last, scene_.environment_pdf());
    path_.deposit(R::unpolarized(scene_.environment_radiance() * share));
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

  void deposit_direct_light(const Hit& hit, const Vec3& exitant, const Bsdf& bsdf, int depth,
                            Sampler& sampler) {
    LightSample light;
    if (!scene_.sample_light(hit.position, sampler, light)) return;
    if (!hit.sides_agree(light.direction)) return;
    if (malus::max_channel(bsdf.m00(hit, light.direction, exitant)) <= 0) return;
    typename R::Light arriving;
    if (!transmit(hit, light, depth, arriving)) return;

    const float bsdf_pdf = light.is_delta ? 0.0f : bsdf.pdf(hit, light.direction, exitant);
    const float share = light.pdf / (light.pdf + bsdf_pdf);
    const float cosine = std::abs(glm::dot(hit.normal, light.direction));
    const auto f = bsdf.template evaluate<R>(hit, light.direction, exitant);
    path_.deposit(R::scatter(f, arriving) * (cosine * share / light.pdf));
  }

  /// The light that arrives at a hit from a light's sample, unless something is in between. Sheets
  /// let it pass and act on it in the light's order: the one nearest to the light first, though a
  /// shadow ray meets it last.
  bool transmit(const Hit& from, const LightSample& light, int depth, typename R::Light& arriving) {
    const Vec3 light_goes = -light.direction;
    Ray ray = from.leave_for(light.position, light.direction);
    if (!scene_.has_sheets) {
      ++counters_.shadow_rays;
      arriving = R::unpolarized(light.radiance);
      return !scene_.geometry.occluded(ray);
    }
    shadow_.begin();
    for (int vertices = depth + 2;; vertices += scene_.integrator.sheets_count ? 1 : 0) {
      // As many vertices as a path that finds the light by itself would have.
      if (scene_.integrator.max_depth >= 0 && vertices > scene_.integrator.max_depth) return false;
      Hit hit;
      ++counters_.shadow_rays;
      if (!scene_.intersect(ray, hit)) break;
      const Bsdf& bsdf = scene_.shapes[hit.shape].material.facing(hit, light_goes);
      if (!bsdf.is_sheet()) return false;
      shadow_.scatter(bsdf.template transmit<R>(hit, light_goes));
      ray = hit.leave_for(light.position, light.direction);
    }
    shadow_.deposit(R::unpolarized(light.radiance));
    arriving = shadow_.result();
    return true;
  }

  const Scene& scene_;
  typename R::CameraPath path_, shadow_;
  Counters counters_;
};

}  // namespace renderer
