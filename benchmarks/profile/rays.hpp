// SPDX-License-Identifier: MIT
// The rays that a rendering traces, and how long Embree takes for them alone: calls of Embree are
// wrapped when the program is linked, so that what is recorded is what the renderer asked for.
#pragma once

#include <string>

#include "../variants/ratio.hpp"
#include "render/passes.hpp"

namespace profile {

struct RayTimes {
  std::string mode;
  double nearest_per_path = 0, shadow_per_path = 0;
  double path = 0;     ///< ns, of all that a path takes
  double nearest = 0;  ///< ns of a ray that asks for the nearest hit, alone
  double shadow = 0;   ///< ns of one that asks whether something is in the way; 0: there are none
  variants::Ratio share;  ///< of a path's time, that its rays take alone
};

/// By turns on one thread: the same iteration of the picture, and its rays alone, in their order.
RayTimes time_rays(const renderer::Scene& scene, renderer::Mode mode, double seconds);

}  // namespace profile
