// SPDX-License-Identifier: MIT
// The passes of a rendering: an algorithm by a family of radiometry, with media or without, seen
// from outside as whole passes over the picture.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "../scene/scene.hpp"
#include "render_options.hpp"

namespace renderer {

class Passes {
 public:
  virtual ~Passes() = default;
  /// Samples [first, last) of every pixel, onto the film. False if it was stopped before its end.
  virtual bool run(std::uint64_t first, std::uint64_t last,
                   const std::function<bool()>& stopped) = 0;
  /// After the first run() was stopped: adds what there is of it.
  virtual void salvage() = 0;
  /// What of a run() that was stopped is on the film, by tasks; empty if nothing is.
  virtual std::vector<std::uint8_t> finished() const = 0;
  /// The next run(), of the same samples, is to leave these out. False if they are none of its.
  virtual bool resume(std::vector<std::uint8_t> finished) = 0;
  /// Up to which sample the next run() is to go, if it may be `step` of them.
  virtual std::uint64_t next(std::uint64_t done, std::uint64_t step) const = 0;
  /// There is nothing to show before the end of the first pass.
  virtual bool needs_whole_iterations() const = 0;
  virtual Counters counters() const = 0;
  virtual LightVertexMemory light_vertices() const = 0;
};

/// The scene's algorithm by the family of the options' mode, with the code of media where there are
/// any. Scene and film outlive the passes.
std::unique_ptr<Passes> make_passes(const Scene& scene, const RenderOptions& options, Film& film);
using PassesMaker =
    std::function<std::unique_ptr<Passes>(const Scene&, const RenderOptions&, Film&)>;

/// The scene's algorithm by the family R, of surfaces alone or with media. Each has a translation
/// unit of its own.
template <class R, class M>
std::unique_ptr<Passes> make_passes_of(const Scene& scene, const RenderOptions& options,
                                       Film& film);

}  // namespace renderer
