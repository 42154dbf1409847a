// SPDX-License-Identifier: MIT
// The names of pictures that are written as OpenEXR, whatever their names say.
#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <string_view>

namespace renderer {

/// Why a picture in OpenEXR isn't written under this name: other programs would take it for what
/// the name says. Empty where nothing is wrong with it.
inline std::string problem_of_exr_name(const std::string& name) {
  constexpr std::array<std::string_view, 9> others{".png", ".jpg",  ".jpeg", ".hdr", ".pfm",
                                                   ".tif", ".tiff", ".bmp",  ".tga"};
  std::string extension = std::filesystem::path(name).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  if (std::find(others.begin(), others.end(), extension) == others.end()) return {};
  return "\"" + name + "\" is the name of another format; OpenEXR (.exr) is written, of which " +
         "malus-image makes PNGs";
}

}  // namespace renderer
