// SPDX-License-Identifier: MIT
// Writes an 8-bit RGB picture as a PNG marked sRGB, whole or not at all.
#pragma once

#include <string>

#include "picture.hpp"

namespace renderer {

void write_png(const std::string& path, const Picture& picture);

}  // namespace renderer
