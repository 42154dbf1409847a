// SPDX-License-Identifier: MIT
// Rendering of scenes of surfaces alone: no code of media is in it.
#include "render_passes.hpp"

namespace renderer {

std::unique_ptr<Passes> make_surface_passes(const Scene& scene, const RenderOptions& options,
                                            Film& film) {
  return make_passes_with<NoMedia>(scene, options, film);
}

}  // namespace renderer
