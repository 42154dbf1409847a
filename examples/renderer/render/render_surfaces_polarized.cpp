// SPDX-License-Identifier: MIT
// Rendering of polarised light of scenes of surfaces alone: no code of media is in it.
#include "render_passes.hpp"

namespace renderer {

template std::unique_ptr<Passes> make_passes_of<malus::Polarized<Rgb>, NoMedia>(
    const Scene&, const RenderOptions&, Film&);

}  // namespace renderer
