// SPDX-License-Identifier: MIT
// Henyey & Greenstein's phase function (1941, "Diffuse radiation in the galaxy"), of mean cosine g.
// A depolarizer. See isotropic_phase.hpp for what a phase kind has.
#pragma once

#include <algorithm>
#include <cmath>

#include "../core/vector.hpp"

namespace renderer {

class HenyeyGreensteinPhase {
 public:
  static constexpr bool polarizes = false;

  /// −1 < g < 1; g > 0 scatters forward.
  explicit HenyeyGreensteinPhase(float g = 0)
      : mean_cosine_(g),
        asymmetry_(std::abs(g)),
        rest_(1 - asymmetry_),
        scale_(rest_ * (1 + asymmetry_) / (4 * pi)) {}

  float mean_cosine() const { return mean_cosine_; }

  Rgb value(float cosine) const { return Rgb(pdf(cosine)); }

  /// (1 − g²)/4π (1 + g² − 2g cos Θ)^(−3/2), where the sum is (1 − |g|)² + 2|g|(1 ∓ cos Θ): nothing
  /// cancels, however narrow the lobe.
  float pdf(float cosine) const {
    const float from_lobe = 1 - toward_lobe(cosine);
    const float d2 = rest_ * rest_ + 2 * asymmetry_ * from_lobe;
    return scale_ / (d2 * std::sqrt(d2));
  }

  /// The usual inversion, (1 + g² − ((1 − g²)/(1 + g − 2gu))²)/2g, multiplied out: g is no divisor
  /// any more, and 1 − cos Θ is a product of positive factors.
  float sample(float u) const {
    const float v = mean_cosine_ < 0 ? 1 - u : u;
    const float d = 1 + asymmetry_ - 2 * asymmetry_ * v, ratio = rest_ / d;
    const float from_lobe = 2 * v * ratio * ratio * (1 + asymmetry_ * (1 - v));
    return toward_lobe(std::max(1 - from_lobe, -1.0f));
  }

 private:
  /// The cosine with the direction that the lobe points to.
  float toward_lobe(float cosine) const { return mean_cosine_ < 0 ? -cosine : cosine; }

  float mean_cosine_, asymmetry_, rest_, scale_;
};

}  // namespace renderer
