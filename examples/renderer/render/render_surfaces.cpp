// SPDX-License-Identifier: MIT
// Rendering by intensities of scenes of surfaces alone: no code of media is in it.
#include "render_passes.hpp"

namespace renderer {

template std::unique_ptr<Passes> make_passes_of<malus::Unpolarized<Rgb>, NoMedia>(
    const Scene&, const RenderOptions&, Film&);

}  // namespace renderer
