// SPDX-License-Identifier: MIT
// Camera paths that know nothing of each other: samples of pixels in any order.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <utility>
#include <vector>

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
        taken_(film.batches()),
        integrators_([&scene] { return PathIntegrator<R, M>(scene); }) {}

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
    for (std::size_t batch = 0; batch < taken_.size(); ++batch) {
      const auto [begin, end] = samples(batch, first, last);
      taken_[batch] += end - begin;
    }
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
  /// One batch's share of samples [first, last).
  std::pair<std::uint64_t, std::uint64_t> samples(std::size_t batch, std::uint64_t first,
                                                  std::uint64_t last) const {
    const std::uint64_t count = last - first, batches = film_.batches();
    return {first + count * batch / batches, first + count * (batch + 1) / batches};
  }

  /// A batch has a sequence of its own, without gaps, so that batches are independent.
  Sampler sampler(std::size_t pixel, std::size_t batch, std::uint64_t sample,
                  std::uint64_t index) const {
    return is_sobol_ ? Sampler::sobol(seed_, pixel * film_.batches() + batch, index)
                     : Sampler(seed_, pixel, sample);
  }

  /// One batch's samples of one tile.
  void render_task(std::size_t task, std::uint64_t first, std::uint64_t last) {
    const std::size_t batches = film_.batches(), batch = task % batches;
    const auto [begin, end] = samples(batch, first, last);
    auto& integrator = integrators_.local();
    tiles_.each_pixel(
        task / batches, [&, begin = begin, end = end](int x, int y, std::size_t pixel) {
          for (std::uint64_t i = begin; i < end; ++i) {
            Sampler random = sampler(pixel, batch, i, taken_[batch] + (i - begin));
            const Ray ray = camera_ray(scene_.film, *scene_.sensor, x, y, random.next_2d());
            const auto reading = integrator.measure(ray, random);
            if (is_finite(reading))
              film_.at(pixel, batch).add(reading);
            else
              integrator.drop();
          }
        });
  }

  const Scene& scene_;
  std::uint64_t seed_;
  bool is_sobol_;
  Film& film_;
  Tiles tiles_;
  std::vector<std::uint64_t> taken_;  // samples of every pixel, by batch
  tbb::enumerable_thread_specific<PathIntegrator<R, M>> integrators_;
};

}  // namespace renderer
