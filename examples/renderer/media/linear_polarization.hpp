// SPDX-License-Identifier: MIT
// How what a path carries is polarised: light, or the row of importance that intensity is read by.
// Scattering by particles turns it into more light in some directions about the path than in
// others.
#pragma once

#include <malus/malus.hpp>

#include "../core/vector.hpp"

namespace renderer {

struct LinearPolarization {
  bool is_none = true;
  Vec3 x{}, y{};       ///< of the frame
  float q = 0, u = 0;  ///< S1/S0 and S2/S0, all channels together

  LinearPolarization() = default;
  /// Of light (a Stokes) or of a row (an Analyzer).
  template <class Q>
  explicit LinearPolarization(const Q& carried) {
    if (carried.form() != malus::StokesForm::full) return;
    const float intensity = sum(carried[0]);
    if (!(intensity > 0)) return;
    is_none = false;
    x = carried.frame().x();
    y = carried.frame().y();
    q = sum(carried[1]) / intensity;
    u = sum(carried[2]) / intensity;
  }

  /// S1/S0 in the frame of a plane through the direction of propagation; `across` is a vector of
  /// that plane perpendicular to the direction. The axes' length doesn't matter.
  float along(const Vec3& across) const {
    const float c = glm::dot(across, x), s = glm::dot(across, y);
    return ((c * c - s * s) * q + 2 * c * s * u) / (c * c + s * s);
  }

 private:
  static float sum(const Rgb& a) { return a[0] + a[1] + a[2]; }
};

}  // namespace renderer
