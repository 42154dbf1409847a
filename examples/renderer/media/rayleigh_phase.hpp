// SPDX-License-Identifier: MIT
// Rayleigh scattering with a depolarisation factor (malus/optics/rayleigh.hpp). See
// isotropic_phase.hpp for what a phase kind has.
#pragma once

#include <algorithm>
#include <cmath>
#include <malus/optics/rayleigh.hpp>

#include "../core/vector.hpp"

namespace renderer {

class RayleighPhase {
 public:
  static constexpr bool polarizes = true;

  /// 0 ≤ depolarization ≤ 6/7.
  explicit RayleighPhase(float depolarization = 0) : scattering_(depolarization) {}

  Rgb value(float cosine) const { return Rgb(pdf(cosine)); }
  float pdf(float cosine) const { return by_solid_angle * scattering_.value(cosine); }

  /// The cumulative distribution is a cubic, a c³ + b c = y with a = D/4, b = 1 − a, y = 1 − 2u.
  /// Its only real root by Cardano, for y ≥ 0 and with the two cube roots' difference multiplied
  /// out: nothing cancels, and a may be 0.
  float sample(float u) const {
    const float a = scattering_.dipoles() / 4, b = 1 - a, y = 1 - 2 * u, third = b / 3;
    const float half = std::sqrt(a) * std::abs(y) / 2;
    const float root = std::cbrt(half + std::sqrt(half * half + third * third * third));
    const float other = third / root;
    return std::clamp(y / (root * root + third + other * other), -1.0f, 1.0f);
  }

  malus::ScatteringElements<Rgb> elements(float cosine) const {
    const auto e = scattering_.elements(cosine);
    const auto grey = [](float x) { return Rgb(by_solid_angle * x); };
    return {grey(e.a1), grey(e.a2), grey(e.a3), grey(e.a4), grey(e.b1), grey(e.b2)};
  }

 private:
  static constexpr float by_solid_angle = 1 / (4 * pi);

  malus::RayleighScattering<float> scattering_;
};

}  // namespace renderer
