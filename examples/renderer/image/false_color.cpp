// SPDX-License-Identifier: MIT
#include "false_color.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace renderer {
namespace {

float positive(float value) { return value > 0 ? value : 0.0F; }

/// One channel of the fully saturated colour of a hue in degrees, 0 <= hue < 360.
float hue_channel(float hue, float center) {
  const float distance = std::fabs(std::remainder(hue - center, 360.0F));
  return std::clamp(2.0F - distance / 60.0F, 0.0F, 1.0F);
}

}  // namespace

float encode_srgb(float linear) {
  if (!(linear > 0)) return 0;
  if (linear >= 1) return 1;
  if (linear <= 0.0031308F) return 12.92F * linear;
  return 1.055F * std::pow(linear, 1.0F / 2.4F) - 0.055F;
}

Color grey(float intensity) {
  const float value = encode_srgb(intensity);
  return {value, value, value};
}

Color degree_color(float degree) { return {encode_srgb(degree), 0, 0}; }

Color signed_color(float value) {
  return {encode_srgb(positive(-value)), encode_srgb(positive(value)), 0};
}

Color chirality_color(float value) {
  const float left = encode_srgb(positive(-value));
  return {left, left, encode_srgb(positive(value))};
}

Color angle_color(float radians, float weight) {
  const float hue = 2 * radians * 180.0F / std::numbers::pi_v<float>;
  const float brightness = encode_srgb(weight);
  return {brightness * hue_channel(hue, 0), brightness * hue_channel(hue, 120),
          brightness * hue_channel(hue, 240)};
}

Color overlay_color(float intensity, float degree) {
  // Clamped first: an overexposed pixel would otherwise hide its polarisation.
  const float light = std::clamp(intensity, 0.0F, 1.0F);
  const float rest = encode_srgb(light * (1 - std::clamp(degree, 0.0F, 1.0F)));
  return {encode_srgb(light), rest, rest};
}

}  // namespace renderer
