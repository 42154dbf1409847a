// SPDX-License-Identifier: MIT
// Whether a picture's pixels are light. Every sample's Stokes vector is, and sums of light are
// light, so that noise is no excuse: beyond rounding no pixel has a degree of polarisation above 1.
// Of algorithms whose samples may err each on its own, the standard errors tell whether the mean
// does.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "../io/image.hpp"
#include "stokes_image.hpp"

namespace renderer {

struct Realizability {
  /// How many standard errors an excess must have: by chance, one in some ten thousand of pixels
  /// that are wholly polarised.
  static constexpr double sigmas = 5;

  std::string name;
  std::size_t values = 0;                    ///< pixels by colours
  std::size_t not_finite = 0;                ///< of these
  std::size_t beyond_rounding = 0;           ///< with a degree of polarisation above 1
  std::optional<std::size_t> beyond_errors;  ///< and by more than `sigmas`; none without errors
  double worst = 0;                          ///< the largest excess, as a part of S0

  /// What is wrong: by errors where the picture has them.
  std::size_t unphysical() const { return not_finite + beyond_errors.value_or(beyond_rounding); }
};

/// `file` may have the channels SE0.R ... SE3.B of standard errors.
Realizability check_realizability(const Image& file, const StokesImage& stokes);

std::string to_text(const Realizability& result);
nlohmann::json to_json(const Realizability& result);

}  // namespace renderer
