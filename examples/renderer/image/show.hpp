// SPDX-License-Identifier: MIT
// Pictures of what an image's Stokes vectors say: intensity, components, degrees, angle, overlay.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "../io/picture.hpp"
#include "stokes_image.hpp"

namespace renderer {

enum class Show { intensity, s1, s2, s3, dop, dolp, aolp, docp, overlay };

/// The names of the command line, in the order of the enumeration.
const std::vector<std::string>& show_names();
/// Throws InputError for a name that isn't one of them.
Show parse_show(const std::string& name);

struct Tone {
  float exposure = 0;  // stops: intensities, S1, S2 and S3 are multiplied by two to this power
  float scale =
      1;  // what a polarisation (a component, a degree) is multiplied by before it is coloured
};

/// Colours the mean of the colour channels; only the intensity is shown in its own colours. Pixels
/// that are infinite or not a number are black. Throws InputError if polarisation is asked of a
/// file that has none.
Picture show(const StokesImage& image, Show what, const Tone& tone);

std::size_t count_not_finite(const StokesImage& image);

}  // namespace renderer
