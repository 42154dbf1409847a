// SPDX-License-Identifier: MIT
// Russian roulette (Arvo & Kirk 1990), by what is left of unpolarised light.
#pragma once

#include <algorithm>
#include <concepts>

#include "../scene/scene.hpp"

namespace renderer {

/// The chance with which a path of so many edges goes on, `share()` of its light being left.
/// Between surfaces it must end some day, however white they are. In a medium that absorbs little
/// it is scattered so often that it must hardly ever end by chance.
template <std::invocable Share>
MALUS_INLINE float survival_chance(const IntegratorSettings& settings, int edges, Share&& share,
                                   bool in_medium = false) {
  if (edges < settings.rr_depth) return 1;
  const Rgb left = share();
  return std::min(malus::max_channel(left), in_medium ? 0.999f : 0.95f);
}

}  // namespace renderer
