// SPDX-License-Identifier: MIT
// A film cut into tiles, which threads take one after the other.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "../film/film_settings.hpp"
#include "../sensors/sensor.hpp"

namespace renderer {

class Tiles {
 public:
  static constexpr int size = 16;

  explicit Tiles(const FilmSettings& film)
      : width_(film.crop_width),
        height_(film.crop_height),
        across_((width_ + size - 1) / size),
        down_((height_ + size - 1) / size) {}

  std::size_t count() const {
    return static_cast<std::size_t>(across_) * static_cast<std::size_t>(down_);
  }

  /// How many pixels a tile has.
  std::uint64_t pixels(std::size_t tile) const {
    const int t = static_cast<int>(tile), x0 = t % across_ * size, y0 = t / across_ * size;
    return static_cast<std::uint64_t>(std::min(size, width_ - x0)) *
           static_cast<std::uint64_t>(std::min(size, height_ - y0));
  }

  /// Shows every pixel of a tile: its x, y and number.
  template <class Visit>
  void each_pixel(std::size_t tile, Visit&& visit) const {
    const int t = static_cast<int>(tile);
    const int x0 = t % across_ * size, y0 = t / across_ * size;
    for (int y = y0; y < std::min(y0 + size, height_); ++y)
      for (int x = x0; x < std::min(x0 + size, width_); ++x)
        visit(x, y,
              static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                  static_cast<std::size_t>(x));
  }

 private:
  int width_, height_, across_, down_;
};

/// The ray of a random point of a pixel's filter.
inline Ray camera_ray(const FilmSettings& f, const Sensor& sensor, int x, int y, const Vec2& u) {
  const Vec2 place = Vec2(f.crop_x + x, f.crop_y + y) + 0.5f + f.filter.sample(u);
  return sensor.ray(place / Vec2(f.width, f.height));
}

}  // namespace renderer
