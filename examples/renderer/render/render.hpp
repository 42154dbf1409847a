// SPDX-License-Identifier: MIT
// Renders a scene: distributes samples over threads so that the picture depends on the seed alone,
// and stops when the samples are taken, the time is up, or the user says so.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>

#include "../film/film.hpp"
#include "../integrators/counters.hpp"
#include "../scene/scene.hpp"

namespace renderer {

enum class Mode { unpolarized, optimized };

struct RenderOptions {
  Mode mode = Mode::optimized;
  std::uint64_t samples_per_pixel = 4;  ///< with a time limit, without end
  double seconds = 0;                   ///< 0: no time limit
  std::uint64_t seed = 0;
  int threads = 0;  ///< 0: all there are
};

struct Progress {
  double fraction;  ///< done, of samples or of time
  double seconds;   ///< since the start
  std::uint64_t samples_per_pixel;
  double noise;  ///< relative standard error of S0
};

struct Rendering {
  Film film;
  Counters counters;
  double seconds = 0;
  std::uint64_t samples_per_pixel = 0;  ///< of whole passes
  bool interrupted = false;
};

/// `report` is called between passes, from the calling thread.
Rendering render(const Scene& scene, const RenderOptions& options, const std::atomic<bool>& stop,
                 const std::function<void(const Progress&)>& report);

}  // namespace renderer
