// SPDX-License-Identifier: MIT
// The passes of a rendering, until its samples are taken, its time is up, or the user says so.
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>

#include "bidirectional_pass.hpp"
#include "path_pass.hpp"

namespace renderer {

inline double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

inline constexpr std::uint64_t samples_in_a_pass = 1 << 20;

/// Small films are split into batches of samples, so that every thread has work and the batches'
/// spread gives an error.
inline std::size_t batches_of(std::size_t pixels) {
  return std::clamp<std::size_t>(4096 / pixels, 1, 64);
}

template <class Pass>
Rendering render_passes(const Scene& scene, const RenderOptions& options,
                        const std::atomic<bool>& stop,
                        const std::function<void(const Progress&)>& report) {
  const int width = scene.film.crop_width, height = scene.film.crop_height;
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  const std::size_t batches = options.batches > 0 ? options.batches : batches_of(pixels);
  Rendering result{Film(width, height, batches), {}, 0, 0, false, {}};
  Pass pass(scene, options, result.film);

  const std::uint64_t step = std::max<std::uint64_t>(1, samples_in_a_pass / pixels);
  const bool timed = options.seconds > 0;
  const auto start = std::chrono::steady_clock::now();
  std::uint64_t done = 0;
  const auto time_is_up = [&] { return timed && seconds_since(start) > options.seconds; };
  const auto stopped = [&] {
    // Some algorithms have nothing to show before their first iteration's end.
    return stop.load(std::memory_order_relaxed) ||
           ((done > 0 || !Pass::needs_whole_iterations) && time_is_up());
  };
  while (!stopped() && (timed || done < options.samples_per_pixel)) {
    const std::uint64_t next = pass.next(done, step);
    const std::uint64_t last = timed ? next : std::min(next, options.samples_per_pixel);
    if (!pass.run(done, last, stopped)) {
      if (done == 0) pass.salvage();
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
  result.counters = pass.counters();
  result.light_vertices = pass.light_vertices();
  result.interrupted = stop;
  return result;
}

/// What is rendered in a scene with or without media.
template <class M>
Rendering render_with(const Scene& scene, const RenderOptions& options,
                      const std::atomic<bool>& stop,
                      const std::function<void(const Progress&)>& report) {
  const auto render_as = [&]<class R>() {
    return Techniques::named(scene.integrator.name)
               ? render_passes<BidirectionalPass<R, M>>(scene, options, stop, report)
               : render_passes<PathPass<R, M>>(scene, options, stop, report);
  };
  return options.mode == Mode::unpolarized
             ? render_as.template operator()<malus::Unpolarized<Rgb>>()
             : render_as.template operator()<malus::Polarized<Rgb>>();
}

// compiled once each, side by side
extern template Rendering render_with<NoMedia>(const Scene&, const RenderOptions&,
                                               const std::atomic<bool>&,
                                               const std::function<void(const Progress&)>&);
extern template Rendering render_with<WithMedia>(const Scene&, const RenderOptions&,
                                                 const std::atomic<bool>&,
                                                 const std::function<void(const Progress&)>&);

}  // namespace renderer
