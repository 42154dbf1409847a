// SPDX-License-Identifier: MIT
// What instantiates the integrators: the passes of each algorithm, by a family of radiometry, with
// media or without.
#pragma once

#include <utility>

#include "bidirectional_pass.hpp"
#include "passes.hpp"
#include "path_pass.hpp"

namespace renderer {

template <class Pass>
class PassesOf final : public Passes {
 public:
  PassesOf(const Scene& scene, const RenderOptions& options, Film& film)
      : pass_(scene, options, film) {}
  bool run(std::uint64_t first, std::uint64_t last, const std::function<bool()>& stopped) override {
    return pass_.run(first, last, stopped);
  }
  void salvage() override { pass_.salvage(); }
  std::vector<std::uint8_t> finished() const override { return pass_.finished(); }
  bool resume(std::vector<std::uint8_t> finished) override {
    return pass_.resume(std::move(finished));
  }
  std::uint64_t next(std::uint64_t done, std::uint64_t step) const override {
    return pass_.next(done, step);
  }
  bool needs_whole_iterations() const override { return Pass::needs_whole_iterations; }
  Counters counters() const override { return pass_.counters(); }
  LightVertexMemory light_vertices() const override { return pass_.light_vertices(); }

 private:
  Pass pass_;
};

template <class R, class M>
std::unique_ptr<Passes> make_passes_of(const Scene& scene, const RenderOptions& options,
                                       Film& film) {
  if (Techniques::named(scene.integrator.name))
    return std::make_unique<PassesOf<BidirectionalPass<R, M>>>(scene, options, film);
  return std::make_unique<PassesOf<PathPass<R, M>>>(scene, options, film);
}

}  // namespace renderer
