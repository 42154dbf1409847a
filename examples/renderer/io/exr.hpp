// SPDX-License-Identifier: MIT
// OpenEXR files. Written: scan lines, 32-bit float, ZIP, the metadata as string attributes, whole
// or not at all. Read: any flat part (half, float or integer channels, scan lines or tiles, any
// data window), the first of several; a file that is not what it claims to be is an InputError that
// names it.
#pragma once

#include <functional>
#include <string>

#include "image.hpp"

namespace renderer {

void write_exr(const std::string& path, const Image& image);
/// Of a header's width, height and number of channels: throws where they are too much for the
/// reader's purpose, before memory is set aside.
using ExrSizeCheck = std::function<void(int, int, std::size_t)>;
Image read_exr(const std::string& path, const ExrSizeCheck& check = {});

}  // namespace renderer
