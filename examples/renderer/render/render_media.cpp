// SPDX-License-Identifier: MIT
// Rendering by intensities of scenes with participating media.
#include "render_passes.hpp"

namespace renderer {

template std::unique_ptr<Passes> make_passes_of<malus::Unpolarized<Rgb>, WithMedia>(
    const Scene&, const RenderOptions&, Film&);

}  // namespace renderer
