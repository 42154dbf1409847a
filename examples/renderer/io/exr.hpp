// SPDX-License-Identifier: MIT
// OpenEXR files. Written: scan lines, 32-bit float, ZIP, the metadata as string attributes, whole
// or not at all. Read: any flat part (half, float or integer channels, scan lines or tiles, any
// data window), the first of several; a file that is not what it claims to be is an InputError that
// names it.
#pragma once

#include <string>

#include "image.hpp"

namespace renderer {

void write_exr(const std::string& path, const Image& image);
Image read_exr(const std::string& path);

}  // namespace renderer
