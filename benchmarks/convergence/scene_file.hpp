// SPDX-License-Identifier: MIT
// A scene of the benchmark: its file, what its parameters are set to, and a hash of all that.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "scene/scene.hpp"

namespace convergence {

struct SceneFile {
  std::string name;
  std::filesystem::path path;
  std::map<std::string, std::string> definitions;
  std::uint64_t hash = 0;
};

/// A scene of a folder with pictures about `resolution` wide, if it has a parameter for that.
/// Throws renderer::InputError if there is none.
SceneFile find_scene(const std::filesystem::path& folder, const std::string& name, int resolution);

/// The scene with an algorithm; merges' radii are multiplied by `radius_factor`.
renderer::Scene load(const SceneFile& file, const std::string& algorithm, double radius_factor = 1);

}  // namespace convergence
