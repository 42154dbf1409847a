// SPDX-License-Identifier: MIT
// A picture as a function of (u, v): u runs along its rows, v from its top row down, and the whole
// of it is the unit square, with texel (0, 0)'s centre half a texel inside of it. Values are
// linear.
#pragma once

#include <cstddef>
#include <vector>

#include "../core/vector.hpp"

namespace renderer {

/// The luminance of linear sRGB.
inline float luminance(const Rgb& c) {
  return 0.212671f * c[0] + 0.715160f * c[1] + 0.072169f * c[2];
}

/// Texels by rows, from the top left one; there is one at least.
struct Texels {
  int width = 0, height = 0;
  std::vector<Rgb> values;

  const Rgb& at(int x, int y) const {
    return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(x)];
  }
};

class Bitmap {
 public:
  enum class Filter { bilinear, nearest };
  /// What is outside of the unit square: the same again, its mirror image, or the nearest edge.
  enum class Wrap { repeat, mirror, clamp };

  Bitmap(Texels texels, Filter filter, Wrap wrap)
      : texels_(std::move(texels)), filter_(filter), wrap_(wrap) {}

  const Texels& texels() const { return texels_; }
  Filter filter() const { return filter_; }
  Rgb value(const Vec2& uv) const;
  /// (∂/∂u, ∂/∂v) of the bilinear luminance.
  Vec2 luminance_gradient(const Vec2& uv) const;

 private:
  /// The four texels around a point, and how far it is from the first of them to the last.
  struct Cell {
    Rgb corner[2][2];  // [row][column]
    Vec2 fraction;
  };
  Cell cell(const Vec2& uv) const;
  int wrapped(float place, int size) const;

  Texels texels_;
  Filter filter_;
  Wrap wrap_;
};

}  // namespace renderer
