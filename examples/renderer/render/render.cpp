// SPDX-License-Identifier: MIT
#include "render.hpp"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <optional>

#include "render_passes.hpp"

namespace renderer {

Rendering render(const Scene& scene, const RenderOptions& options, const std::atomic<bool>& stop,
                 const std::function<void(const Progress&)>& report) {
  // More threads than processors are refused, with a message, unless they are allowed.
  std::optional<tbb::global_control> allowed;
  if (options.threads > 0)
    allowed.emplace(tbb::global_control::max_allowed_parallelism,
                    static_cast<std::size_t>(options.threads));
  tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
  return arena.execute([&] {
    return scene.has_media() ? render_with<WithMedia>(scene, options, stop, report)
                             : render_with<NoMedia>(scene, options, stop, report);
  });
}

}  // namespace renderer
