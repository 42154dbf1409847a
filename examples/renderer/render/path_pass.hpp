// SPDX-License-Identifier: MIT
// Camera paths that know nothing of each other: samples of pixels in any order.
#pragma once

#include <tbb/enumerable_thread_specific.h>

#include <atomic>
#include <cstdint>
#include <utility>
#include <vector>

#include "../core/parallel.hpp"
#include "../integrators/path.hpp"
#include "render_options.hpp"
#include "tiles.hpp"

namespace renderer {

template <class R, class M>
class PathPass {
 public:
  static constexpr bool needs_whole_iterations = false;

  PathPass(const Scene& scene, const RenderOptions& options, Film& film)
      : scene_(scene),
        seed_(options.seed),
        is_sobol_(options.sampler == SamplerKind::sobol),
        film_(film),
        tiles_(scene.film),
        integrators_([&scene] { return PathIntegrator<R, M>(scene); }) {}

  /// Sample numbers [first, last) of every pixel. False if it was stopped before its end; what is
  /// done stays done.
  template <class Stopped>
  bool run(std::uint64_t first, std::uint64_t last, Stopped&& stopped) {
    std::atomic<bool> complete{true};
    finished_.resize(tiles_.count() * film_.batches());
    parallel_for(finished_.size(), 1, [&](std::size_t from, std::size_t to) {
      for (std::size_t task = from; task != to; ++task) {
        if (finished_[task] != 0) continue;
        if (stopped()) {
          complete = false;
          return;
        }
        render_task(task, first, last);
        finished_[task] = 1;
      }
    });
    if (complete) finished_.clear();
    return complete;
  }

  /// Which tasks of a run() that was stopped are on the film; empty after one that was not.
  const std::vector<std::uint8_t>& finished() const { return finished_; }
  /// The next run() is to go on where that one was stopped. False if no run() of this picture had
  /// these tasks.
  bool resume(std::vector<std::uint8_t> finished) {
    if (!finished.empty() && finished.size() != tiles_.count() * film_.batches()) return false;
    finished_ = std::move(finished);
    return true;
  }

  /// What is done is on the film already.
  void salvage() {}

  /// Up to which sample the next run() goes.
  std::uint64_t next(std::uint64_t done, std::uint64_t step) const { return done + step; }

  Counters counters() const {
    Counters sum;
    for (const auto& integrator : integrators_) sum += integrator.counters();
    return sum;
  }
  LightVertexMemory light_vertices() const { return {}; }

 private:
  /// A batch has a sequence of its own, without gaps, so that batches are independent.
  Sampler sampler(std::size_t pixel, std::size_t batch, std::uint64_t sample) const {
    const std::uint64_t batches = film_.batches();
    return is_sobol_ ? Sampler::sobol(seed_, pixel * batches + batch, sample / batches)
                     : Sampler(seed_, pixel, sample);
  }

  /// One batch's samples of one tile: of every so many numbers one, whatever runs there are.
  void render_task(std::size_t task, std::uint64_t first, std::uint64_t last) {
    const std::size_t batches = film_.batches(), batch = task % batches;
    const std::uint64_t begin = first + (batch + batches - first % batches) % batches;
    auto& integrator = integrators_.local();
    tiles_.each_pixel(task / batches, [&](int x, int y, std::size_t pixel) {
      for (std::uint64_t i = begin; i < last; i += batches) {
        Sampler random = sampler(pixel, batch, i);
        const Ray ray = camera_ray(scene_.film, *scene_.sensor, x, y, random.next_2d());
        const auto reading = integrator.measure(ray, random);
        if (integrator.admit(reading)) film_.at(pixel, batch).add(reading);
      }
    });
  }

  const Scene& scene_;
  std::uint64_t seed_;
  bool is_sobol_;
  Film& film_;
  Tiles tiles_;
  std::vector<std::uint8_t> finished_;  // tasks of a run that was stopped, not bits: threads write
  tbb::enumerable_thread_specific<PathIntegrator<R, M>> integrators_;
};

}  // namespace renderer
