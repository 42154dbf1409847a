// SPDX-License-Identifier: MIT
// Figure 2 of "Bi-Directional Polarised Light Transport": the first picture on the left, the second
// on the right, their difference in the middle, each as four quadrants S3 S1 over S2 S0.
#pragma once

#include "../io/picture.hpp"
#include "show.hpp"
#include "stokes_image.hpp"

namespace renderer {

/// S0 is grey, all else green where positive and red where negative. The difference is b - a, in
/// signed colours throughout, multiplied by `difference_scale`. Throws InputError unless the two
/// are comparable.
Picture comparison_panels(const StokesImage& a, const StokesImage& b, const Tone& tone,
                          float difference_scale);

}  // namespace renderer
