// SPDX-License-Identifier: MIT
#include "texture.hpp"

#include <algorithm>
#include <cmath>

namespace renderer {

namespace {

void widen(const Rgb& c, Rgb& lowest, Rgb& highest) {
  for (std::size_t i = 0; i < 3; ++i) {
    lowest.set(i, std::min(lowest[i], c[i]));
    highest.set(i, std::max(highest[i], c[i]));
  }
}

/// In double precision: a large picture's sum outgrows a float's digits.
Rgb mean_of(const std::vector<Rgb>& values) {
  glm::dvec3 sum(0);
  for (const Rgb& c : values) sum += glm::dvec3(c[0], c[1], c[2]);
  return to_rgb(sum / static_cast<double>(values.size()));
}

}  // namespace

Texture::Texture(Kind kind, const Placement& to_uv) : kind_(std::move(kind)), to_uv_(to_uv) {
  if (const auto* bitmap = std::get_if<Bitmap>(&kind_)) {
    const auto& values = bitmap->texels().values;
    mean_ = mean_of(values);
    lowest_ = highest_ = values.front();
    for (const Rgb& c : values) widen(c, lowest_, highest_);
    return;
  }
  const auto& checkers = std::get<Checkerboard>(kind_);
  mean_ = (checkers.even + checkers.odd) * 0.5f;
  lowest_ = highest_ = checkers.even;
  widen(checkers.odd, lowest_, highest_);
}

Rgb Texture::checker(const Vec2& uv) const {
  const auto& checkers = std::get<Checkerboard>(kind_);
  const bool right = uv.x - std::floor(uv.x) > 0.5f, lower = uv.y - std::floor(uv.y) > 0.5f;
  return right == lower ? checkers.even : checkers.odd;
}

Vec2 Texture::luminance_gradient(const Vec2& uv) const {
  const auto* bitmap = std::get_if<Bitmap>(&kind_);
  if (!bitmap || bitmap->filter() == Bitmap::Filter::nearest) return Vec2(0.0f);
  return glm::transpose(to_uv_.a) * bitmap->luminance_gradient(to_uv_.a * uv + to_uv_.offset);
}

}  // namespace renderer
