// SPDX-License-Identifier: MIT
// Russian roulette (Arvo & Kirk 1990), by what is left of unpolarised light.
#pragma once

#include <algorithm>

#include "../scene/scene.hpp"

namespace renderer {

/// The chance with which a path of so many edges goes on, `share` of its light being left.
inline float survival_chance(const IntegratorSettings& settings, int edges, const Rgb& share) {
  return edges >= settings.rr_depth ? std::min(malus::max_channel(share), 0.95f) : 1.0f;
}

}  // namespace renderer
