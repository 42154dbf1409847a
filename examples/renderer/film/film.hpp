// SPDX-License-Identifier: MIT
// The film: sums of measurements, one a pixel and batch. Sums are in double precision, since a
// radiancemeter adds up 10⁹ samples.
#pragma once

#include <array>
#include <cstdint>
#include <malus/measurement.hpp>
#include <span>
#include <string>
#include <vector>

#include "../core/vector.hpp"
#include "../io/image.hpp"

namespace renderer {

/// Which way S1 and S2 are written: x right and y up in the picture, or the paper's v(ω), x up.
/// They differ in sign.
enum class StokesFrame { horizontal, up };

struct PixelSum {
  std::array<double, 12> stokes{};  ///< S0.R S0.G S0.B S1.R … S3.B
  double square = 0;                ///< of the mean of S0's channels
  std::uint64_t count = 0;

  void add(const malus::Measurement<Rgb>& m);
  PixelSum& operator+=(const PixelSum& p);
  double mean(std::size_t i) const {
    return count > 0 ? stokes[i] / static_cast<double>(count) : 0;
  }
};

class Film {
 public:
  /// `batches` independent estimates of every pixel.
  Film(int width, int height, std::size_t batches);

  int width() const { return width_; }
  int height() const { return height_; }
  std::size_t batches() const { return batches_; }
  PixelSum& at(std::size_t pixel, std::size_t batch) { return sums_[pixel * batches_ + batch]; }

  /// All of them, by pixel, then batch.
  std::span<PixelSum> sums() { return sums_; }
  std::span<const PixelSum> sums() const { return sums_; }

  /// A pixel's sum over its batches, always in the same order.
  PixelSum total(std::size_t pixel) const;
  /// The standard error of a pixel's 12 means, from the spread of its batches' means; NaN where
  /// there are less than two.
  std::array<double, 12> standard_error(std::size_t pixel) const;
  /// The mean over pixels of the relative standard error of S0, a measure of noise; 0 where nothing
  /// was sampled.
  double relative_noise() const;

  /// R G B and S0.R … S3.B; with errors, SE0.R … SE3.B too.
  Image image(StokesFrame frame, bool with_errors = false) const;

 private:
  int width_, height_;
  std::size_t batches_;
  std::vector<PixelSum> sums_;
};

}  // namespace renderer
