// SPDX-License-Identifier: MIT
// A picture for looking at: 8 bits for each of R, G, B, already encoded for the screen (sRGB), rows
// from top to bottom.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace renderer {

/// Red, green and blue as the screen takes them, 0 to 1.
using Color = std::array<float, 3>;

class Picture {
 public:
  Picture(int width, int height, const Color& background = {0, 0, 0})
      : width_(width),
        height_(height),
        bytes_(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) set(x, y, background);
    }
  }

  int width() const { return width_; }
  int height() const { return height_; }
  const std::vector<std::uint8_t>& bytes() const { return bytes_; }

  std::array<std::uint8_t, 3> at(int x, int y) const {
    const std::size_t i = index(x, y);
    return {bytes_[i], bytes_[i + 1], bytes_[i + 2]};
  }
  void set(int x, int y, const Color& color) {
    for (std::size_t c = 0; c < 3; ++c) bytes_[index(x, y) + c] = quantize(color[c]);
  }

 private:
  std::size_t index(int x, int y) const {
    const auto column = static_cast<std::size_t>(x);
    return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + column);
  }
  /// Written so that a NaN becomes 0: no comparison with it holds.
  static std::uint8_t quantize(float value) {
    if (value >= 1.0F) return 255;
    return value > 0.0F ? static_cast<std::uint8_t>(value * 255.0F + 0.5F) : std::uint8_t{0};
  }

  int width_;
  int height_;
  std::vector<std::uint8_t> bytes_;
};

}  // namespace renderer
