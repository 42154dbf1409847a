// SPDX-License-Identifier: MIT
// Which part of a picture is rendered, and how samples become pixels.
#pragma once

#include "../io/input_error.hpp"
#include "reconstruction_filter.hpp"

namespace renderer {

struct FilmSettings {
  int width = 768, height = 576;  ///< of the whole film
  int crop_x = 0, crop_y = 0, crop_width = 768, crop_height = 576;
  ReconstructionFilter filter;
  Location where{};  ///< for messages
};

}  // namespace renderer
