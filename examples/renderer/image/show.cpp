// SPDX-License-Identifier: MIT
#include "show.hpp"

#include <algorithm>
#include <cmath>

#include "../io/input_error.hpp"
#include "false_color.hpp"

namespace renderer {
namespace {

Color intensity_color(const StokesImage& image, std::size_t pixel, float gain) {
  if (!image.has_rgb()) return grey(gain * image.mean(pixel)[0]);
  Color color{};
  for (std::size_t c = 0; c < 3; ++c) color[c] = encode_srgb(gain * image.at(c, pixel)[0]);
  return color;
}

Color polarization_color(const StokesPixel& s, Show what, float gain, float scale) {
  switch (what) {
    case Show::intensity:
      return grey(gain * s[0]);
    case Show::s1:
      return signed_color(gain * scale * s[1]);
    case Show::s2:
      return signed_color(gain * scale * s[2]);
    case Show::s3:
      return signed_color(gain * scale * s[3]);
    case Show::dop:
      return degree_color(scale * degree_of_polarization(s));
    case Show::dolp:
      return degree_color(scale * degree_of_linear_polarization(s));
    case Show::docp:
      return chirality_color(scale * degree_of_circular_polarization(s));
    case Show::aolp:
      return angle_color(angle_of_linear_polarization(s), scale * degree_of_linear_polarization(s));
    case Show::overlay:
      return overlay_color(gain * s[0], scale * degree_of_polarization(s));
  }
  return {};
}

bool pixel_is_finite(const StokesImage& image, std::size_t pixel) {
  for (std::size_t color = 0; color < image.colors.size(); ++color) {
    if (!is_finite(image.at(color, pixel))) return false;
  }
  return true;
}

}  // namespace

const std::vector<std::string>& show_names() {
  static const std::vector<std::string> names = {"intensity", "s1",   "s2",   "s3",     "dop",
                                                 "dolp",      "aolp", "docp", "overlay"};
  return names;
}

Show parse_show(const std::string& name) {
  const auto& names = show_names();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<Show>(found - names.begin());
  std::string allowed;
  for (const std::string& one : names) allowed += (allowed.empty() ? "" : ", ") + one;
  throw InputError("--show " + name + ": unknown; allowed are " + allowed);
}

Picture show(const StokesImage& image, Show what, const Tone& tone) {
  if (what != Show::intensity) image.require_polarization();
  const float gain = std::exp2(tone.exposure);
  Picture picture(image.width, image.height);
  std::size_t pixel = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x, ++pixel) {
      if (!pixel_is_finite(image, pixel)) continue;
      picture.set(x, y,
                  what == Show::intensity
                      ? intensity_color(image, pixel, gain)
                      : polarization_color(image.mean(pixel), what, gain, tone.scale));
    }
  }
  return picture;
}

std::size_t count_not_finite(const StokesImage& image) {
  std::size_t count = 0;
  for (std::size_t pixel = 0; pixel < image.pixels(); ++pixel) {
    if (!pixel_is_finite(image, pixel)) ++count;
  }
  return count;
}

}  // namespace renderer
