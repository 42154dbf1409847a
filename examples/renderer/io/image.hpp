// SPDX-License-Identifier: MIT
// A picture of named floating-point channels, as an EXR file holds it. Invariant: data holds one
// plane of width x height values for every channel, in the order of `channels`, rows from top to
// bottom.
#pragma once

#include <algorithm>
#include <cstddef>
#include <map>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace renderer {

struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::string> channels;
  std::vector<float> data;
  std::map<std::string, std::string> metadata;

  Image() = default;
  /// A black image of these channels.
  Image(int width_, int height_, std::vector<std::string> channels_)
      : width(width_), height(height_), channels(std::move(channels_)) {
    data.resize(pixels() * channels.size());
  }

  std::size_t pixels() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  bool has(const std::string& name) const {
    return std::find(channels.begin(), channels.end(), name) != channels.end();
  }
  std::span<float> plane(const std::string& name) {
    return {data.data() + index_of(name) * pixels(), pixels()};
  }
  std::span<const float> plane(const std::string& name) const {
    return {data.data() + index_of(name) * pixels(), pixels()};
  }

 private:
  std::size_t index_of(const std::string& name) const {
    const auto found = std::find(channels.begin(), channels.end(), name);
    if (found == channels.end()) throw std::out_of_range("the image has no channel " + name);
    return static_cast<std::size_t>(found - channels.begin());
  }
};

}  // namespace renderer
