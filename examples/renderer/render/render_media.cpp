// SPDX-License-Identifier: MIT
// Rendering of scenes with participating media.
#include "render_passes.hpp"

namespace renderer {

template Rendering render_with<WithMedia>(const Scene&, const RenderOptions&,
                                          const std::atomic<bool>&,
                                          const std::function<void(const Progress&)>&);

}  // namespace renderer
