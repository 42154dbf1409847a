// SPDX-License-Identifier: MIT
// Picture files as linear values: OpenEXR, Radiance HDR, PNG, JPEG, BMP, TGA.
#pragma once

#include <cstdint>
#include <filesystem>

#include "../io/input_error.hpp"
#include "bitmap.hpp"

namespace renderer {

/// Files of integers are sRGB and decoded, or, if `raw`, divided by their largest value; files of
/// floats are taken as they are. Grey is spread to all channels, alpha is left out. Every value is
/// finite. What is wrong with a file is an InputError that names it; `asker` is the place that asks
/// for it. A picture has 2^28 pixels at most, and what reading it takes has to fit into memory with
/// the `held` bytes that there are of others: a small file may hold a large picture.
Texels read_texels(const std::filesystem::path& path, bool raw, const Location& asker = {},
                   std::uint64_t held = 0);

}  // namespace renderer
