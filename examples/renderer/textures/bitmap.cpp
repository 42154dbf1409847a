// SPDX-License-Identifier: MIT
#include "bitmap.hpp"

#include <algorithm>
#include <cmath>

namespace renderer {

namespace {

Rgb mix(const Rgb& a, const Rgb& b, float t) { return a * (1 - t) + b * t; }

}  // namespace

/// Written so that no place, however far outside, and not even a NaN, is outside of the texels.
int Bitmap::wrapped(float place, int size) const {
  const auto n = static_cast<float>(size);
  if (!(place >= 0 && place < n)) {
    if (wrap_ == Wrap::repeat) {
      place -= n * std::floor(place / n);
    } else if (wrap_ == Wrap::mirror) {
      place -= 2 * n * std::floor(place / (2 * n));
      if (place >= n) place = 2 * n - 1 - place;
    }
  }
  return place > 0 ? static_cast<int>(std::min(place, n - 1)) : 0;
}

Bitmap::Cell Bitmap::cell(const Vec2& uv) const {
  const float x = uv.x * static_cast<float>(texels_.width) - 0.5f;
  const float y = uv.y * static_cast<float>(texels_.height) - 0.5f;
  const float left = std::floor(x), top = std::floor(y);
  const int columns[2] = {wrapped(left, texels_.width), wrapped(left + 1, texels_.width)};
  const int rows[2] = {wrapped(top, texels_.height), wrapped(top + 1, texels_.height)};
  Cell c;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) c.corner[i][j] = texels_.at(columns[j], rows[i]);
  c.fraction = {x - left, y - top};
  return c;
}

Rgb Bitmap::value(const Vec2& uv) const {
  if (filter_ == Filter::nearest) {
    const float x = std::floor(uv.x * static_cast<float>(texels_.width));
    const float y = std::floor(uv.y * static_cast<float>(texels_.height));
    return texels_.at(wrapped(x, texels_.width), wrapped(y, texels_.height));
  }
  const Cell c = cell(uv);
  return mix(mix(c.corner[0][0], c.corner[0][1], c.fraction.x),
             mix(c.corner[1][0], c.corner[1][1], c.fraction.x), c.fraction.y);
}

Vec2 Bitmap::luminance_gradient(const Vec2& uv) const {
  const Cell c = cell(uv);
  const Rgb du =
      mix(c.corner[0][1] - c.corner[0][0], c.corner[1][1] - c.corner[1][0], c.fraction.y);
  const Rgb dv =
      mix(c.corner[1][0] - c.corner[0][0], c.corner[1][1] - c.corner[0][1], c.fraction.x);
  return {luminance(du) * static_cast<float>(texels_.width),
          luminance(dv) * static_cast<float>(texels_.height)};
}

}  // namespace renderer
