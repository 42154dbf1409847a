// SPDX-License-Identifier: MIT
// Renderings of one scene by several variants that take turns in one process.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "ratio.hpp"
#include "render/passes.hpp"

namespace variants {

/// What takes turns: a rendering that can go on for as long as one likes, onto a film.
struct Contender {
  std::string name;
  std::function<std::unique_ptr<renderer::Passes>(renderer::Film&)> make;
};

struct Row {
  std::string scene, algorithm, variant;
  std::uint64_t iterations = 0;  ///< samples of every pixel
  /// That they took: of the processor where there is one thread, which doesn't count what others
  /// take from it; else on the clock.
  double seconds = 0;
  double paths_per_second = 0;
  double rays_per_path = 0;  ///< shadow rays too
  double merges_per_path = 0;
  Ratio ratio;  ///< of paths a second, to the first variant's
  std::size_t bytes_per_light_vertex = 0;
};

/// In every round each contender renders the same iterations, and so the same paths. A turn takes
/// `turn` seconds or one iteration, the longer of the two; rounds go on until they have taken
/// `seconds` on the clock for each contender, and until there are least_pairs of them. What a
/// rendering keeps from one iteration to the next is set up before. Times are the processor's if
/// that is asked for, which is of use with one thread alone.
std::vector<Row> measure(const renderer::Scene& scene, const std::vector<Contender>& contenders,
                         double seconds, double turn, bool of_processor);

}  // namespace variants
