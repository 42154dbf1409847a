// SPDX-License-Identifier: MIT
// Polarising filters held before a finished picture. A filter is a Mueller matrix in the picture's
// frame; several are passed in the order given, so that a retarder and a polarizer make any
// measurement of equation 1 of "Bi-Directional Polarised Light Transport", M = P(theta) Q(phi).
#pragma once

#include <malus/mueller.hpp>
#include <string>
#include <vector>

#include "stokes_image.hpp"
#include "stokes_pixel.hpp"

namespace renderer {

struct Filter {
  std::string name;  // as the user wrote it
  malus::Mueller<float, malus::incident, malus::exitant, PictureFrame> matrix;
};

/// What parse_filter accepts, for help and messages.
inline constexpr const char* filter_grammar =
    "linear:ANGLE, circular:left, circular:right, elliptical:AZIMUTH,ELLIPTICITY or "
    "retarder:FAST_AXIS,RETARDANCE (degrees, counter-clockwise from horizontal; ellipticity -45, "
    "left "
    "circular, to 45, right circular)";

/// Throws InputError for anything else.
Filter parse_filter(const std::string& text);

/// What arrives at the sensor of the light that arrives at the filter. An ideal polarizer passes
/// light of its own polarisation whole and half of what is unpolarised.
StokesPixel pass(const StokesPixel& light, const Filter& filter);

/// The picture behind the filters, the first being the one the light meets first. Throws InputError
/// if the picture has no polarisation.
StokesImage look_through(const std::vector<Filter>& filters, StokesImage image);

}  // namespace renderer
