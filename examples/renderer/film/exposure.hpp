// SPDX-License-Identifier: MIT
// One iteration's picture, or several iterations' side by side, before it is added to the film as
// one sample of every pixel: camera paths contribute to their own pixel, light paths to any.
#pragma once

#include <memory_resource>
#include <span>
#include <vector>

#include "../core/huge_pages.hpp"
#include "film.hpp"
#include "film_settings.hpp"

namespace renderer {

/// A reading that belongs to a point of the whole film, in pixels, and to every pixel whose filter
/// covers it.
struct Splat {
  Vec2 place;
  malus::Measurement<Rgb> reading;
};

/// What one task's light paths have brought to one layer.
struct SplatList {
  std::size_t layer = 0;
  std::vector<Splat> splats;
};

class Exposure {
 public:
  /// `layers` iterations side by side.
  Exposure(const FilmSettings& film, std::size_t layers)
      : film_(film),
        pixels_(static_cast<std::size_t>(film.crop_width) *
                static_cast<std::size_t>(film.crop_height)),
        readings_(pixels_ * layers, &huge_pages()) {}

  void clear() { readings_.assign(readings_.size(), {}); }

  /// What a camera path of a pixel has read.
  void add(std::size_t pixel, std::size_t layer, const malus::Measurement<Rgb>& reading) {
    readings_[layer * pixels_ + pixel] += reading;
  }

  /// What light paths have brought, on all threads; the sums don't depend on their number.
  void add(std::span<const SplatList> lists);

  /// Adds a layer to one batch of a film, as one sample of every pixel, but of those where it is
  /// not finite; how many these are.
  std::uint64_t develop(std::size_t layer, std::size_t batch, Film& film) const;

  std::size_t bytes() const { return readings_.size() * sizeof(readings_[0]); }

 private:
  void add_to_rows(const Splat& splat, std::size_t layer, int first_row, int last_row);

  const FilmSettings& film_;
  std::size_t pixels_;
  std::pmr::vector<malus::Measurement<Rgb>> readings_;  // by layer, then pixel
};

}  // namespace renderer
