// SPDX-License-Identifier: MIT
// The colours for polarisation of Wilkie & Weidlich, "A standardised polarisation visualisation for
// images" (2010): a degree is red on black, a signed component green where positive and red where
// negative, handedness blue (right) and yellow (left), and an overlay tints a grey picture. The
// angle of linear polarisation is a hue, as polarisation cameras show it. Every brightness goes
// through the sRGB curve, so that a value of one half looks half as bright as one.
#pragma once

#include "../io/picture.hpp"
#include "stokes_pixel.hpp"

namespace renderer {

/// A linear brightness as the screen takes it (IEC 61966-2-1), clamped to 0 ... 1.
float encode_srgb(float linear);

Color grey(float intensity);

/// Red on black.
Color degree_color(float degree);

/// Green for positive values, red for negative ones.
Color signed_color(float value);

/// Blue for right circular light (positive), yellow for left.
Color chirality_color(float value);

/// Twice the angle is the hue: horizontal light is red (0 degrees), 45 degrees yellow-green (90),
/// vertical cyan (180), 135 degrees violet (270). The weight, a degree of polarisation, is the
/// brightness.
Color angle_color(float radians, float weight);

/// Grey intensity, tinted red by a degree of polarisation: at 1 only red remains, at the
/// intensity's brightness.
Color overlay_color(float intensity, float degree);

}  // namespace renderer
