// SPDX-License-Identifier: MIT
// A small picture of a scene in a few numbers, whose distribution over seeds has no long tails:
// Stokes vectors of pixels, brought into bounds, and then their means over blocks and over the
// whole. A caustic that one seed in a hundred meets counts as one bright pixel, however bright.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace guard {

/// Of each block the means over pixels of S0/(S0 + scale) and of S1, S2, S3 over (S0 + scale), each
/// the mean of the channels before; the last block is the whole picture.
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
