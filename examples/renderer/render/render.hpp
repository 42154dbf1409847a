// SPDX-License-Identifier: MIT
// Renders a scene: distributes samples over threads so that the picture depends on the seed alone,
// and stops when the samples are taken, the time is up, or the user says so.
#pragma once

#include <atomic>
#include <functional>

#include "../scene/scene.hpp"
#include "passes.hpp"
#include "render_options.hpp"

namespace renderer {

/// The sampler that was found to help the scene's algorithm.
SamplerKind suited_sampler(const Scene& scene);

/// `report` is called between passes, from the calling thread.
Rendering render(const Scene& scene, const RenderOptions& options, const std::atomic<bool>& stop,
                 const std::function<void(const Progress&)>& report);

/// The same by passes that aren't the renderer's own, such as a family of radiometry of the
/// caller's.
Rendering render(const Scene& scene, const RenderOptions& options, const PassesMaker& make,
                 const std::atomic<bool>& stop, const std::function<void(const Progress&)>& report);

}  // namespace renderer
