// SPDX-License-Identifier: MIT
// Camera paths that know nothing of each other: samples of pixels in any order.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <atomic>

#include "../integrators/path.hpp"
#include "render_options.hpp"
#include "tiles.hpp"

namespace renderer {

template <class R, class M>
class PathPass {
 public:
  static constexpr bool needs_whole_iterations = false;

  PathPass(const Scene& scene, const RenderOptions& options, Film& film)
      : scene_(scene), seed_(options.seed), film_(film), tiles_(scene.film), integrators_([&scene] {
          return PathIntegrator<R, M>(scene);
        }) {}

  /// Sample numbers [first, last) of every pixel. False if it was stopped before its end; what is
  /// done stays done.
  template <class Stopped>
  bool run(std::uint64_t first, std::uint64_t last, Stopped&& stopped) {
    std::atomic<bool> complete{true};
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tiles_.count() * film_.batches(), 1),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                        for (std::size_t task = range.begin(); task != range.end(); ++task) {
                          if (stopped()) {
                            complete = false;
                            return;
                          }
                          render_task(task, first, last);
                        }
                      });
    return complete;
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
  /// One batch's samples of one tile.
  void render_task(std::size_t task, std::uint64_t first, std::uint64_t last) {
    const std::size_t batches = film_.batches(), batch = task % batches;
    const std::uint64_t count = last - first;
    const std::uint64_t begin = first + count * batch / batches;
    const std::uint64_t end = first + count * (batch + 1) / batches;
    auto& integrator = integrators_.local();
    tiles_.each_pixel(task / batches, [&](int x, int y, std::size_t pixel) {
      for (std::uint64_t sample = begin; sample < end; ++sample) {
        Sampler sampler(seed_, pixel, sample);
        const Ray ray = camera_ray(scene_.film, *scene_.sensor, x, y, sampler.next_2d());
        const auto reading = integrator.measure(ray, sampler);
        if (is_finite(reading))
          film_.at(pixel, batch).add(reading);
        else
          integrator.drop();
      }
    });
  }

  const Scene& scene_;
  std::uint64_t seed_;
  Film& film_;
  Tiles tiles_;
  tbb::enumerable_thread_specific<PathIntegrator<R, M>> integrators_;
};

}  // namespace renderer
