// SPDX-License-Identifier: MIT
#include "scene_file.hpp"

#include <fstream>
#include <iterator>
#include <set>

#include "io/input_error.hpp"
#include "scene/build.hpp"
#include "scene/requirements.hpp"
#include "scene/xml_reader.hpp"

namespace convergence {

namespace {

std::string read_text(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw renderer::InputError(path.string() + ": cannot be read");
  return {std::istreambuf_iterator<char>(in), {}};
}

/// FNV-1a.
void add_to_hash(const std::string& bytes, std::uint64_t& hash) {
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
}

/// A file with all files that it names between quotes, which is how scenes name meshes, textures
/// and other files.
void add_file(const std::filesystem::path& path, std::set<std::filesystem::path>& seen,
              std::uint64_t& hash) {
  if (!seen.insert(path).second) return;
  const std::string text = read_text(path);
  add_to_hash(text, hash);
  if (path.extension() != ".xml") return;
  for (std::size_t open = text.find('"'); open != std::string::npos;) {
    const std::size_t close = text.find('"', open + 1);
    if (close == std::string::npos) return;
    const std::string quoted = text.substr(open + 1, close - open - 1);
    std::error_code error;
    if (quoted.size() < 256 && quoted.find('.') != std::string::npos) {
      const auto file = path.parent_path() / quoted;
      if (std::filesystem::is_regular_file(file, error)) add_file(file, seen, hash);
    }
    open = text.find('"', close + 1);
  }
}

bool has_parameter(const std::string& text, const std::string& name) {
  return text.find("<default name=\"" + name + "\"") != std::string::npos;
}

}  // namespace

SceneFile find_scene(const std::filesystem::path& folder, const std::string& name, int resolution) {
  SceneFile file{name, folder / (name + ".xml"), {}, 0xcbf29ce484222325ull};
  const std::string text = read_text(file.path);
  const bool wide = has_parameter(text, "width");
  if (has_parameter(text, "resolution"))
    file.definitions["resolution"] = std::to_string(resolution);
  if (wide) file.definitions["width"] = std::to_string(resolution);
  // The pictures keep about the shape that the files give them: 3:2 and 8:5.
  if (has_parameter(text, "height"))
    file.definitions["height"] = std::to_string(wide ? resolution * 2 / 3 : resolution * 5 / 8);
  std::set<std::filesystem::path> seen;
  add_file(file.path, seen, file.hash);
  for (const auto& [key, value] : file.definitions) add_to_hash(key + "=" + value + ";", file.hash);
  return file;
}

renderer::Scene load(const SceneFile& file, const std::string& algorithm, double radius_factor) {
  renderer::Scene scene = renderer::build_scene(*renderer::read_scene(file.path, file.definitions));
  renderer::set_integrator(scene.integrator, algorithm);
  scene.integrator.initial_radius *= static_cast<float>(radius_factor);
  scene.integrator.initial_media_radius *= static_cast<float>(radius_factor);
  renderer::check_requirements(scene, file.path.string());
  return scene;
}

}  // namespace convergence
