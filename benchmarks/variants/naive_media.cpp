// SPDX-License-Identifier: MIT
#include "naive.hpp"
#include "naive_passes.hpp"
#include "render/render_passes.hpp"

namespace variants {

std::unique_ptr<renderer::Passes> make_naive_media_passes(const renderer::Scene& scene,
                                                          const renderer::RenderOptions& options,
                                                          renderer::Film& film) {
  return renderer::make_passes_of<Naive, renderer::WithMedia>(scene, options, film);
}

}  // namespace variants
