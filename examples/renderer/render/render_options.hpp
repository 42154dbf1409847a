// SPDX-License-Identifier: MIT
// What a user asks of a rendering, and what comes of it.
#pragma once

#include <cstdint>

#include "../core/sampler.hpp"
#include "../film/film.hpp"
#include "../integrators/counters.hpp"

namespace renderer {

enum class Mode { unpolarized, optimized };

class Checkpoint;

struct RenderOptions {
  Mode mode = Mode::optimized;
  std::uint64_t samples_per_pixel = 4;  ///< with a time limit, without end
  double seconds = 0;                   ///< 0: no time limit
  std::uint64_t seed = 0;
  /// Light that waits at a vertex for a connection or merge may count by more than its intensity.
  bool stores_polarization = true;
  SamplerKind sampler = SamplerKind::independent;  ///< the command line chooses by the scene
  int threads = 0;                                 ///< 0: all there are
  std::uint64_t first_sample = 0;                  ///< the number of the first of them
  Checkpoint* checkpoint = nullptr;                ///< to go on from and to keep, if any
  std::size_t batches = 0;  ///< independent estimates of every pixel; 0: as many as threads need
};

struct Progress {
  double fraction;  ///< done, of samples or of time
  double seconds;   ///< since the start
  std::uint64_t samples_per_pixel;
  double noise;  ///< relative standard error of S0
};

/// What the storage of light paths took.
struct LightVertexMemory {
  std::size_t bytes_per_vertex = 0;  ///< 0 where none is stored
  std::size_t bytes_per_photon = 0;
  std::size_t peak = 0;  ///< bytes of all at once, with the grid that finds photons
};

struct Rendering {
  Film film;
  Counters counters{};
  double seconds = 0;
  std::uint64_t samples_per_pixel = 0;  ///< of whole passes
  std::uint64_t resumed_from = 0;       ///< how many of them a checkpoint had
  bool interrupted = false;
  LightVertexMemory light_vertices{};
};

}  // namespace renderer
