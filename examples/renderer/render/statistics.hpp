// SPDX-License-Identifier: MIT
// What --stats writes.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "render.hpp"

namespace renderer {

/// Iterations, time, rates, forms met; of a film of one pixel, its four Stokes components and their
/// standard errors.
nlohmann::ordered_json statistics(const Scene& scene, const RenderOptions& options,
                                  const Rendering& rendering, StokesFrame frame, int threads);

}  // namespace renderer
