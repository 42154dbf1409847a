// SPDX-License-Identifier: MIT
#include "render.hpp"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <optional>

#include "passes.hpp"

namespace renderer {

std::unique_ptr<Passes> make_passes(const Scene& scene, const RenderOptions& options, Film& film) {
  return scene.has_media() ? make_media_passes(scene, options, film)
                           : make_surface_passes(scene, options, film);
}

/// Sequences of a pixel help what its own paths find and connect. They do nothing for light that
/// comes to a pixel from all over the picture, nor for the long walks in media.
SamplerKind suited_sampler(const Scene& scene) {
  const std::string& integrator = scene.integrator.name;
  const bool connects = integrator == "path" || integrator == "bdpt" || integrator == "vcm";
  return connects && !scene.has_media() ? SamplerKind::sobol : SamplerKind::independent;
}

namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

constexpr std::uint64_t samples_in_a_pass = 1 << 20;

/// Small films are split into batches of samples, so that every thread has work and the batches'
/// spread gives an error.
std::size_t batches_of(std::size_t pixels) { return std::clamp<std::size_t>(4096 / pixels, 1, 64); }

/// Until the samples are taken, the time is up, or the user says so.
Rendering run_passes(const Scene& scene, const RenderOptions& options,
                     const std::atomic<bool>& stop,
                     const std::function<void(const Progress&)>& report) {
  const int width = scene.film.crop_width, height = scene.film.crop_height;
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  const std::size_t batches = options.batches > 0 ? options.batches : batches_of(pixels);
  Rendering result{Film(width, height, batches), {}, 0, 0, false, {}};
  const auto passes = make_passes(scene, options, result.film);

  const std::uint64_t step = std::max<std::uint64_t>(1, samples_in_a_pass / pixels);
  const bool timed = options.seconds > 0;
  const auto start = std::chrono::steady_clock::now();
  std::uint64_t done = 0;
  const auto time_is_up = [&] { return timed && seconds_since(start) > options.seconds; };
  const std::function<bool()> stopped = [&] {
    return stop.load(std::memory_order_relaxed) ||
           ((done > 0 || !passes->needs_whole_iterations()) && time_is_up());
  };
  while (!stopped() && (timed || done < options.samples_per_pixel)) {
    const std::uint64_t next = passes->next(done, step);
    const std::uint64_t last = timed ? next : std::min(next, options.samples_per_pixel);
    if (!passes->run(done, last, stopped)) {
      if (done == 0) passes->salvage();
      break;
    }
    done = last;
    if (!report) continue;
    const double seconds = seconds_since(start);
    const double fraction =
        timed ? seconds / options.seconds
              : static_cast<double>(done) / static_cast<double>(options.samples_per_pixel);
    report({std::min(fraction, 1.0), seconds, done, result.film.relative_noise()});
  }
  result.seconds = seconds_since(start);
  result.samples_per_pixel = done;
  result.counters = passes->counters();
  result.light_vertices = passes->light_vertices();
  result.interrupted = stop;
  return result;
}

}  // namespace

Rendering render(const Scene& scene, const RenderOptions& options, const std::atomic<bool>& stop,
                 const std::function<void(const Progress&)>& report) {
  // More threads than processors are refused, with a message, unless they are allowed.
  std::optional<tbb::global_control> allowed;
  if (options.threads > 0)
    allowed.emplace(tbb::global_control::max_allowed_parallelism,
                    static_cast<std::size_t>(options.threads));
  tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
  return arena.execute([&] { return run_passes(scene, options, stop, report); });
}

}  // namespace renderer
