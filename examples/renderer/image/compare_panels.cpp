// SPDX-License-Identifier: MIT
#include "compare_panels.hpp"

#include <cmath>
#include <cstddef>

#include "compare.hpp"
#include "false_color.hpp"

namespace renderer {
namespace {

constexpr int panel_gap = 8;
constexpr int quadrant_gap = 2;
constexpr Color gap_color = {1, 1, 1};

/// Draws four quadrants with their top left corner at (left, 0); the colour of a value depends on
/// its component.
template <typename ValueOf, typename ColorOf>
void draw_panel(Picture& picture, int left, const StokesImage& size, const ValueOf& value_of,
                const ColorOf& color_of) {
  constexpr std::size_t quadrants[2][2] = {{3, 1}, {2, 0}};
  std::size_t pixel = 0;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x, ++pixel) {
      const StokesPixel values = value_of(pixel);
      for (int row = 0; row < 2; ++row) {
        for (int column = 0; column < 2; ++column) {
          const std::size_t component = quadrants[row][column];
          picture.set(left + column * (size.width + quadrant_gap) + x,
                      row * (size.height + quadrant_gap) + y,
                      color_of(component, values[component]));
        }
      }
    }
  }
}

}  // namespace

Picture comparison_panels(const StokesImage& a, const StokesImage& b, const Tone& tone,
                          float difference_scale) {
  require_comparable(a, b);
  const int panel_width = 2 * a.width + quadrant_gap;
  Picture picture(3 * panel_width + 2 * panel_gap, 2 * a.height + quadrant_gap, gap_color);
  const float gain = std::exp2(tone.exposure);
  const auto value_color = [&](std::size_t component, float value) {
    return component == 0 ? grey(gain * value) : signed_color(gain * tone.scale * value);
  };
  const auto difference_color = [&](std::size_t, float value) {
    return signed_color(gain * difference_scale * value);
  };
  const auto difference = [&](std::size_t pixel) { return b.mean(pixel) + -1.0F * a.mean(pixel); };
  const int step = panel_width + panel_gap;
  draw_panel(
      picture, 0, a, [&](std::size_t pixel) { return a.mean(pixel); }, value_color);
  draw_panel(picture, step, a, difference, difference_color);
  draw_panel(
      picture, 2 * step, a, [&](std::size_t pixel) { return b.mean(pixel); }, value_color);
  return picture;
}

}  // namespace renderer
