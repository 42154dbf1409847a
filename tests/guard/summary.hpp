// SPDX-License-Identifier: MIT
// A small picture of a scene in a few numbers, whose distribution over seeds has no long tails: of
// each of its blocks and of the whole the mean Stokes vector, brought into bounds. A caustic that
// one seed in a hundred meets then counts as one bright block, not as the mean of all of them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace guard {

/// Of each block S0/(S0 + scale) and S1, S2, S3 over (S0 + scale), means of the channels; the last
/// block is the whole picture.
using Summary = std::vector<double>;

inline const std::vector<std::string>& integrators() {
  static const std::vector<std::string> names = {"path", "ptracer", "bdpt", "ppm", "bpm", "vcm"};
  return names;
}

/// Nothing for an integrator that the scene is refused for. `scale` is about the scene's S0; 0: it
/// is the picture's own, and set.
std::optional<Summary> summarize(const std::filesystem::path& scene, const std::string& integrator,
                                 unsigned seed, double& scale);

}  // namespace guard
