// SPDX-License-Identifier: MIT
// Iterations of the algorithms that trace paths from the lights too: each gives one sample of every
// pixel, to which light paths may contribute from anywhere.
#pragma once

#include <tbb/enumerable_thread_specific.h>

#include <atomic>
#include <cstdint>
#include <vector>

#include "../core/parallel.hpp"
#include "../film/exposure.hpp"
#include "../integrators/bidirectional.hpp"
#include "render_options.hpp"
#include "tiles.hpp"

namespace renderer {

template <class R, class M>
class BidirectionalPass {
 public:
  static constexpr bool needs_whole_iterations = true;

  BidirectionalPass(const Scene& scene, const RenderOptions& options, Film& film)
      : scene_(scene),
        techniques_(*Techniques::named(scene.integrator.name)),
        stores_polarization_(options.stores_polarization),
        seed_(options.seed),
        is_sobol_(options.sampler == SamplerKind::sobol),
        film_(film),
        tiles_(scene.film),
        layers_(techniques_.merge ? 1 : film.batches()),
        exposure_(scene.film, layers_),
        paths_per_pixel_(light_paths_per_pixel()),
        integrators_([this] { return Worker(scene_, techniques_, stores_polarization_); }) {}

  /// Iterations [first, last). False if it was stopped before its end; whole iterations stay done.
  template <class Stopped>
  bool run(std::uint64_t first, std::uint64_t last, Stopped&& stopped) {
    for (std::uint64_t i = first; i < last; i += layers_) {
      const auto layers = static_cast<std::size_t>(std::min<std::uint64_t>(layers_, last - i));
      exposure_.clear();
      const std::size_t parts = this->parts();
      for (std::size_t part = 0; part < parts; ++part)
        if (!run_part(i, layers, tiles_.count() * part / parts, tiles_.count() * (part + 1) / parts,
                      stopped))
          return false;
      for (std::size_t layer = 0; layer < layers; ++layer)
        develop(layer, static_cast<std::size_t>((i + layer) % film_.batches()));
    }
    return true;
  }

  /// After run() was stopped before it had completed any iteration: adds what there is of the
  /// first, which is short of some light.
  void salvage() {
    exposure_.add(splats_);
    develop(0, 0);
  }

  /// Of a run() that is stopped nothing is kept.
  std::vector<std::uint8_t> finished() const { return {}; }
  bool resume(const std::vector<std::uint8_t>& finished) { return finished.empty(); }

  /// Up to which iteration the next run() goes, which is as short as may be: what is stopped within
  /// is lost.
  std::uint64_t next(std::uint64_t done, std::uint64_t) const { return done + layers_; }

  Counters counters() const {
    Counters sum;
    for (const auto& worker : integrators_) sum += worker.integrator.counters();
    sum.non_finite += overflown_;
    return sum;
  }

  LightVertexMemory light_vertices() const {
    if (techniques_.lens_alone) return {};
    LightVertexMemory memory{
        sizeof(LightVertex<R, M>),
        techniques_.merge ? PhotonMap<R>::bytes_per_photon(R::polarized && stores_polarization_)
                          : 0,
        peak_bytes_};
    for (const auto& worker : integrators_) memory.peak += bytes(worker.paths);
    return memory;
  }

 private:
  static constexpr std::size_t tiles_at_once = (1 << 20) / (Tiles::size * Tiles::size);

  /// What a thread keeps.
  struct Worker {
    Worker(const Scene& scene, const Techniques& techniques, bool stores_polarization)
        : integrator(scene, techniques, stores_polarization) {}
    BidirectionalIntegrator<R, M> integrator;
    LightPaths<R, M> paths;  // of the sample at hand, where no more are needed
  };

  static std::size_t bytes(const LightPaths<R, M>& p) {
    return p.vertices.capacity() * sizeof(LightVertex<R, M>) +
           p.ends.capacity() * sizeof(p.ends[0]);
  }

  /// A picture of few pixels needs more photons than pixels.
  std::uint64_t light_paths_per_pixel() const {
    constexpr std::uint64_t least_photon_paths = 1 << 12;
    const auto pixels =
        static_cast<std::uint64_t>(film_.width()) * static_cast<std::uint64_t>(film_.height());
    return techniques_.merge ? (least_photon_paths + pixels - 1) / pixels : 1;
  }

  /// A large picture is done in parts of about the same size, each with its own light paths: memory
  /// stays bounded.
  std::size_t parts() const { return (tiles_.count() + tiles_at_once - 1) / tiles_at_once; }

  /// One part of the picture in iterations [first, first + layers).
  template <class Stopped>
  bool run_part(std::uint64_t first, std::size_t layers, std::size_t first_tile,
                std::size_t last_tile, Stopped&& stopped) {
    const std::size_t tasks = (last_tile - first_tile) * layers;
    const Iteration<R> iteration = begin(first, first_tile, last_tile);
    splats_.resize(tasks);
    for (SplatList& list : splats_) list.splats.clear();
    paths_.resize(techniques_.merge ? tasks : 0);
    const auto each_task = [&](auto&& work) {
      std::atomic<bool> complete{true};
      parallel_for(tasks, 1, [&](std::size_t from, std::size_t to) {
        for (std::size_t i = from; i != to; ++i) {
          if (stopped()) complete = false;
          if (!complete) return;
          work(Task{i, first_tile + i / layers, i % layers, first + i % layers},
               integrators_.local());
        }
      });
      return complete.load();
    };

    if (techniques_.merge) {
      if (!each_task([&](const Task& t, Worker& w) { trace_photons(iteration, t, w); }))
        return false;
      const std::span<const LightPaths<R, M>> paths(paths_);
      photons_.build(paths, false, scene_.geometry.center(), radius(first));
      if constexpr (M::present)
        media_photons_.build(paths, true, scene_.geometry.center(), media_radius(first));
      note_memory();
    }
    if (!each_task([&](const Task& t, Worker& w) { render_tile(iteration, t, w); })) return false;
    exposure_.add(splats_);
    return true;
  }

  /// One tile in one iteration.
  struct Task {
    std::size_t number, tile, layer;
    std::uint64_t iteration;
  };

  Iteration<R> begin(std::uint64_t first, std::size_t first_tile, std::size_t last_tile) const {
    Iteration<R> it;
    const auto pixels =
        static_cast<std::uint64_t>(film_.width()) * static_cast<std::uint64_t>(film_.height());
    it.light_paths = static_cast<float>(pixels * paths_per_pixel_);
    it.factors.connection = techniques_.connect ? 1 : 0;
    if (!techniques_.merge) return it;
    std::uint64_t photon_paths = 0;
    for (std::size_t tile = first_tile; tile < last_tile; ++tile)
      photon_paths += tiles_.pixels(tile) * paths_per_pixel_;
    // One part's light paths bring light to another's pixels, so that all parts must weigh alike:
    // as if each had the mean's photons.
    const float n = it.light_paths / static_cast<float>(parts());
    const float r = radius(first), r_media = media_radius(first);
    it.factors.surface_merge = pi * r * r * n;
    it.factors.media_merge = 4 / 3.0f * pi * r_media * r_media * r_media * n;
    it.merged_power = n / static_cast<float>(photon_paths);
    it.photons = &photons_;
    it.media_photons = &media_photons_;
    return it;
  }

  /// Knaus & Zwicker 2011: radii that shrink slowly enough for the variance to vanish too, of disks
  /// on surfaces and of balls in media.
  float radius(std::uint64_t iteration) const {
    const IntegratorSettings& s = scene_.integrator;
    return s.initial_radius * scene_.geometry.radius() * shrunk(iteration, 2);
  }
  float media_radius(std::uint64_t iteration) const {
    const IntegratorSettings& s = scene_.integrator;
    return s.initial_media_radius * scene_.geometry.radius() * shrunk(iteration, 3);
  }
  float shrunk(std::uint64_t iteration, int dimensions) const {
    const float power = (scene_.integrator.radius_alpha - 1) / static_cast<float>(dimensions);
    return std::pow(static_cast<float>(iteration + 1), power);
  }

  /// Of a path in one iteration. A batch of iterations has a sequence of its own, so that batches
  /// are independent.
  Sampler sampler(std::uint64_t seed, std::uint64_t path, std::uint64_t iteration) const {
    const std::uint64_t batches = film_.batches();
    return is_sobol_
               ? Sampler::sobol(seed, path * batches + iteration % batches, iteration / batches)
               : Sampler(seed, path, iteration);
  }
  /// Other random numbers than the camera's paths have. A sequence for each path: one for all paths
  /// of an iteration would gain nothing where they meet the lens, and lose where they meet others.
  Sampler light_sampler(std::size_t pixel, std::uint64_t path, std::uint64_t iteration) const {
    return sampler(~seed_, pixel * paths_per_pixel_ + path, iteration);
  }

  void trace_photons(const Iteration<R>& iteration, const Task& task, Worker& worker) {
    LightPaths<R, M>& paths = paths_[task.number];
    paths.clear();
    SplatList& list = begin_list(task);
    tiles_.each_pixel(task.tile, [&](int, int, std::size_t pixel) {
      for (std::uint64_t i = 0; i < paths_per_pixel_; ++i) {
        Sampler random = light_sampler(pixel, i, task.iteration);
        worker.integrator.trace_light_path(iteration, random, paths, list.splats);
      }
    });
  }

  /// Camera paths; where light paths aren't needed all at once, each is traced here.
  void render_tile(const Iteration<R>& iteration, const Task& task, Worker& worker) {
    if (!techniques_.merge) begin_list(task);
    std::size_t path = 0;
    tiles_.each_pixel(task.tile, [&](int x, int y, std::size_t pixel) {
      std::span<const LightVertex<R, M>> light_path;
      if (techniques_.merge) {
        light_path = paths_[task.number].path(path);
        path += paths_per_pixel_;
      } else {
        worker.paths.clear();
        Sampler random = light_sampler(pixel, 0, task.iteration);
        worker.integrator.trace_light_path(iteration, random, worker.paths,
                                           splats_[task.number].splats);
        light_path = worker.paths.path(0);
      }
      if (techniques_.lens_alone) return;
      Sampler random = sampler(seed_, pixel, task.iteration);
      const Ray ray = camera_ray(scene_.film, *scene_.sensor, x, y, random.next_2d());
      const auto reading = worker.integrator.measure(iteration, ray, random, light_path);
      if (worker.integrator.admit(reading)) exposure_.add(pixel, task.layer, reading);
    });
  }

  SplatList& begin_list(const Task& task) {
    SplatList& list = splats_[task.number];
    list.layer = task.layer;
    list.splats.clear();
    return list;
  }

  void develop(std::size_t layer, std::size_t batch) {
    overflown_ += exposure_.develop(layer, batch, film_);
  }

  void note_memory() {
    std::size_t sum = photons_.bytes() + media_photons_.bytes();
    for (const auto& paths : paths_) sum += bytes(paths);
    peak_bytes_ = std::max(peak_bytes_, sum);
  }

  const Scene& scene_;
  const Techniques techniques_;
  const bool stores_polarization_;
  std::uint64_t seed_;
  bool is_sobol_;
  Film& film_;
  Tiles tiles_;
  std::size_t layers_;
  Exposure exposure_;
  std::uint64_t paths_per_pixel_;
  std::vector<SplatList> splats_;         // by task
  std::vector<LightPaths<R, M>> paths_;   // by task, where all are needed at once
  PhotonMap<R> photons_, media_photons_;  // on surfaces, and in media
  std::size_t peak_bytes_ = 0;
  std::uint64_t overflown_ = 0;  // pixels' samples that were finite by parts but not in sum
  tbb::enumerable_thread_specific<Worker> integrators_;
};

}  // namespace renderer
