// SPDX-License-Identifier: MIT
// Mitsuba's files of grid volumes: "VOL", a byte 3, then little-endian 32-bit numbers: the integers
// 1 (values are floats), cells along x, y and z, channels; six floats of a bounding box, least x,
// y, z and greatest; and the values, a cell's channels together, x fastest, then y.
#pragma once

#include <filesystem>

#include "../io/input_error.hpp"
#include "density_grid.hpp"

namespace renderer {

struct GridVolume {
  GridValues grid;
  glm::dvec3 lowest{0}, highest{1};  ///< of its bounding box, whatever the file says
};

/// What is wrong with a file is an InputError that names it; `asker` is the place that asks for it.
GridVolume read_grid_volume(const std::filesystem::path& path, const Location& asker = {});

}  // namespace renderer
