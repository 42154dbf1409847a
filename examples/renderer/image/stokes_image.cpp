// SPDX-License-Identifier: MIT
#include "stokes_image.hpp"

#include <algorithm>
#include <span>

#include "../io/input_error.hpp"

namespace renderer {
namespace {

const std::vector<std::string> rgb = {"R", "G", "B"};

std::string channel_name(std::size_t component, const std::string& color) {
  const std::string name = "S" + std::to_string(component);
  return color.empty() ? name : name + "." + color;
}

/// Files keep channels in alphabetical order; people count red, green, blue.
std::vector<std::string> in_rgb_order(std::vector<std::string> colors) {
  std::vector<std::string> sorted = colors;
  std::sort(sorted.begin(), sorted.end());
  return sorted == std::vector<std::string>{"B", "G", "R"} ? rgb : colors;
}

std::vector<std::string> stokes_colors(const Image& image) {
  std::vector<std::string> colors;
  for (const std::string& channel : image.channels) {
    if (channel == "S0") colors.emplace_back();
    if (channel.starts_with("S0.")) colors.push_back(channel.substr(3));
  }
  return in_rgb_order(std::move(colors));
}

std::vector<std::string> intensity_colors(const Image& image, const std::string& name) {
  if (image.has("R") && image.has("G") && image.has("B")) return rgb;
  if (image.has("Y")) return {"Y"};
  std::string found;
  for (const std::string& channel : image.channels) found += " " + channel;
  throw InputError(
      Location{name, 0},
      "has neither Stokes channels (S0.R ... S3.B) nor R G B nor Y; its channels are:" + found);
}

void append(std::vector<float>& planes, std::span<const float> plane) {
  planes.insert(planes.end(), plane.begin(), plane.end());
}

bool frame_is_up(const Image& image, const std::string& name) {
  const auto frame = image.metadata.find(stokes_frame_attribute);
  // Files of other programs don't say; Mitsuba's are horizontal.
  if (frame == image.metadata.end() || frame->second == horizontal_frame) return false;
  if (frame->second == up_frame) return true;
  throw InputError(Location{name, 0}, std::string("the header's ") + stokes_frame_attribute +
                                          " is \"" + frame->second +
                                          "\"; known are \"horizontal\" and \"up\"");
}

void negate(std::vector<float>& values) {
  for (float& value : values) value = -value;
}

void read_stokes(const Image& image, StokesImage& stokes) {
  for (std::size_t component = 0; component < 4; ++component) {
    for (const std::string& color : stokes.colors) {
      const std::string channel = channel_name(component, color);
      if (!image.has(channel)) {
        throw InputError(Location{stokes.name, 0},
                         "has " + channel_name(0, color) + " but no channel " + channel);
      }
      append(stokes.components[component], image.plane(channel));
    }
  }
  if (frame_is_up(image, stokes.name)) {
    // The two frames are a quarter turn apart, and Stokes components turn by twice the angle.
    negate(stokes.components[1]);
    negate(stokes.components[2]);
  }
  stokes.metadata[stokes_frame_attribute] = horizontal_frame;
}

}  // namespace

StokesPixel StokesImage::at(std::size_t color, std::size_t pixel) const {
  const std::size_t i = color * pixels() + pixel;
  if (!polarized) return {components[0][i], 0, 0, 0};
  return {components[0][i], components[1][i], components[2][i], components[3][i]};
}

void StokesImage::set(std::size_t color, std::size_t pixel, const StokesPixel& value) {
  const std::size_t i = color * pixels() + pixel;
  for (std::size_t component = 0; component < 4; ++component) {
    components[component][i] = value[component];
  }
}

StokesPixel StokesImage::mean(std::size_t pixel) const {
  StokesPixel sum;
  for (std::size_t color = 0; color < colors.size(); ++color) sum += at(color, pixel);
  return (1.0F / static_cast<float>(colors.size())) * sum;
}

void StokesImage::require_polarization() const {
  if (polarized) return;
  throw InputError(Location{name, 0},
                   "there is no polarisation in this file: it has no Stokes channels (S0.R ... "
                   "S3.B), only intensities");
}

StokesImage stokes_image(const Image& image, const std::string& name) {
  StokesImage stokes;
  stokes.name = name;
  stokes.width = image.width;
  stokes.height = image.height;
  stokes.metadata = image.metadata;
  stokes.colors = stokes_colors(image);
  stokes.polarized = !stokes.colors.empty();
  if (stokes.polarized) {
    read_stokes(image, stokes);
  } else {
    stokes.colors = intensity_colors(image, name);
    for (const std::string& color : stokes.colors) {
      append(stokes.components[0], image.plane(color));
    }
  }
  return stokes;
}

Image to_image(const StokesImage& stokes) {
  std::vector<std::string> channels;
  const bool plain = stokes.has_rgb() || !stokes.polarized;
  if (plain) channels = stokes.colors;
  for (std::size_t component = 0; stokes.polarized && component < 4; ++component) {
    for (const std::string& color : stokes.colors) {
      channels.push_back(channel_name(component, color));
    }
  }
  Image image;
  image.width = stokes.width;
  image.height = stokes.height;
  image.channels = std::move(channels);
  image.metadata = stokes.metadata;
  if (plain) append(image.data, stokes.components[0]);
  for (std::size_t component = 0; stokes.polarized && component < 4; ++component) {
    append(image.data, stokes.components[component]);
  }
  return image;
}

}  // namespace renderer
