// SPDX-License-Identifier: MIT
// What a picture file holds, in words and numbers: size, channels, metadata, mean Stokes vector,
// and how many pixels are no light at all.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "../io/image.hpp"
#include "stokes_image.hpp"

namespace renderer {

struct Info {
  std::string name;
  int width = 0;
  int height = 0;
  std::vector<std::string> channels;            // as in the file
  std::map<std::string, std::string> metadata;  // as in the file
  bool polarized = false;
  std::vector<std::pair<std::string, StokesPixel>> mean;  // one a colour, of the finite pixels
  float max_dop = 0;                                      // of the finite pixels
  std::size_t not_finite = 0;  // pixels with an infinity or NaN in any colour
  std::size_t unphysical = 0;  // with a degree of polarisation above 1 in any colour
};

Info describe(const Image& file, const StokesImage& stokes);

std::string to_text(const Info& info);
nlohmann::json to_json(const Info& info);

}  // namespace renderer
