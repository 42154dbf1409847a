// SPDX-License-Identifier: MIT
// Rendering of scenes of surfaces alone: no code of media is in it.
#include "render_passes.hpp"

namespace renderer {

template Rendering render_with<NoMedia>(const Scene&, const RenderOptions&,
                                        const std::atomic<bool>&,
                                        const std::function<void(const Progress&)>&);

}  // namespace renderer
