// SPDX-License-Identifier: MIT
// Pictures on disk for the tests of textures and environments.
#pragma once

#include <string>

#include "io/exr.hpp"
#include "render_scenes.hpp"

namespace render_test {

using scene_test::Folder;

/// Writes an OpenEXR file of color(x, y), row 0 the top one, and returns its name.
template <class Color>
std::string picture(const Folder& folder, const std::string& name, int width, int height,
                    const Color& color) {
  renderer::Image image(width, height, {"R", "G", "B"});
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const glm::vec3 c = color(x, y);
      const auto i = static_cast<std::size_t>(y * width + x);
      image.plane("R")[i] = c.x;
      image.plane("G")[i] = c.y;
      image.plane("B")[i] = c.z;
    }
  const std::string path = folder.path() / name;
  renderer::write_exr(path, image);
  return path;
}

inline std::string file(const std::string& path) {
  return "<string name=\"filename\" value=\"" + path + "\"/>";
}

inline std::string text_value(const std::string& name, const std::string& value) {
  return "<string name=\"" + name + "\" value=\"" + value + "\"/>";
}

inline std::string bitmap(const std::string& parameter, const std::string& path,
                          const std::string& more = "") {
  return "<texture type=\"bitmap\" name=\"" + parameter + "\">" + file(path) + more + "</texture>";
}

}  // namespace render_test
