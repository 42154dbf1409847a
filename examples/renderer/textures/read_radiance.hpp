// SPDX-License-Identifier: MIT
// Pictures in Radiance's RGBE format (.hdr): three mantissas and one exponent a pixel, plain or
// run-length encoded by scan line.
#pragma once

#include <functional>
#include <string_view>

#include "bitmap.hpp"

namespace renderer {

bool is_radiance(std::string_view bytes);

/// Throws std::runtime_error, with what is wrong with the file, or what `check` throws of its
/// header's width and height.
Texels read_radiance(std::string_view bytes, const std::function<void(int, int)>& check);

}  // namespace renderer
