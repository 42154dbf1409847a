// SPDX-License-Identifier: MIT
// The scenes that benchmarks render, by name.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "scene/build.hpp"
#include "scene/requirements.hpp"
#include "scene/xml_reader.hpp"

namespace benchmarks {

/// NAME.xml in a folder, for an integrator, as a square picture; with a resolution of 0, in its own
/// size. Throws InputError.
inline renderer::Scene load_scene(const std::string& folder, const std::string& name,
                                  const std::string& algorithm, int resolution) {
  const auto file = std::filesystem::path(folder) / (name + ".xml");
  const std::string size = std::to_string(resolution);
  std::map<std::string, std::string> definitions{{"resolution", size}};
  if (name.starts_with("bathroom")) definitions = {{"width", size}, {"height", size}};
  if (resolution == 0) definitions.clear();
  renderer::Scene scene = renderer::build_scene(*renderer::read_scene(file, definitions));
  renderer::set_integrator(scene.integrator, algorithm);
  renderer::check_requirements(scene, file.string());
  return scene;
}

}  // namespace benchmarks
