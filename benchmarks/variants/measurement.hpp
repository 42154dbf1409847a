// SPDX-License-Identifier: MIT
// Renderings of one scene by several variants that take turns, so that a drifting clock cancels.
#pragma once

#include <string>
#include <vector>

#include "render/render.hpp"

namespace variants {

struct Variant {
  std::string name;
  renderer::Mode mode;
};

struct Row {
  std::string scene, algorithm, variant;
  std::uint64_t iterations = 0;
  double seconds = 0;
  double paths_per_second = 0;
  double ratio = 1, ratio_low = 1, ratio_high = 1;  ///< to the first variant; 95 % interval
  std::size_t bytes_per_light_vertex = 0;
};

/// `rounds` rounds, in each of which every variant renders for `seconds`/`rounds` (and one whole
/// iteration at least). Ratios are of paths per second.
std::vector<Row> measure(const renderer::Scene& scene, const std::vector<Variant>& variants,
                         double seconds, int rounds, int threads);

}  // namespace variants
