// SPDX-License-Identifier: MIT
// Rendering of scenes with participating media.
#include "render_passes.hpp"

namespace renderer {

std::unique_ptr<Passes> make_media_passes(const Scene& scene, const RenderOptions& options,
                                          Film& film) {
  return make_passes_with<WithMedia>(scene, options, film);
}

}  // namespace renderer
