// SPDX-License-Identifier: MIT
// How far two pictures of one scene are apart, for every Stokes component and colour.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "stokes_image.hpp"

namespace renderer {

struct Difference {
  std::string component;  // "S0" ... "S3"
  std::string color;      // "R", ..., empty for plain S0
  double mean_a = 0;
  double mean_b = 0;
  double mean_difference = 0;  // of b - a
  double rmse = 0;
  std::optional<double> relative_error;  // RMSE over the mean S0 of a; none where that is 0
  double max_abs = 0;
  std::size_t skipped = 0;  // pixels that are infinite or not a number in either
};

/// Throws InputError unless the two have the same size and channels.
void require_comparable(const StokesImage& a, const StokesImage& b);

/// S0 of every colour, then S1 ...; S0 alone if the two have no polarisation.
std::vector<Difference> compare(const StokesImage& a, const StokesImage& b);

std::string to_text(const std::vector<Difference>& differences);
nlohmann::json to_json(const std::vector<Difference>& differences);

}  // namespace renderer
