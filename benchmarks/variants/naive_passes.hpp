// SPDX-License-Identifier: MIT
// The renderer's integrators by the naive family.
#pragma once

#include "render/passes.hpp"

namespace variants {

// compiled side by side
std::unique_ptr<renderer::Passes> make_naive_surface_passes(const renderer::Scene& scene,
                                                            const renderer::RenderOptions& options,
                                                            renderer::Film& film);
std::unique_ptr<renderer::Passes> make_naive_media_passes(const renderer::Scene& scene,
                                                          const renderer::RenderOptions& options,
                                                          renderer::Film& film);

}  // namespace variants
