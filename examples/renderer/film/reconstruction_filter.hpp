// SPDX-License-Identifier: MIT
// Reconstruction filters by importance sampling (Ernst et al. 2006): a sample of a pixel is drawn
// from the filter around its centre and counts in full, so that a pixel is a plain mean of
// independent samples, whatever the filter.
#pragma once

#include <array>
#include <cstddef>

#include "../core/vector.hpp"

namespace renderer {

class ReconstructionFilter {
 public:
  enum class Kind { box, tent, gaussian };

  /// `width` is the radius of box and tent in pixels, and the standard deviation of a Gaussian cut
  /// off at four of them.
  explicit ReconstructionFilter(Kind kind = Kind::gaussian, float width = 0.5f);

  /// The offset from the pixel's centre, in pixels, for u in [0, 1)².
  Vec2 sample(const Vec2& u) const { return {sample_1d(u.x), sample_1d(u.y)}; }
  /// The density of sample(), which integrates to 1: the share that light at an offset has in a
  /// pixel.
  float density(const Vec2& offset) const { return density_1d(offset.x) * density_1d(offset.y); }
  /// No offset is larger, in x or y.
  float radius() const { return kind_ == Kind::gaussian ? 4 * width_ : width_; }

 private:
  float sample_1d(float u) const;
  float density_1d(float x) const;

  static constexpr std::size_t steps = 4096;
  Kind kind_;
  float width_;
  float scale_ = 1;                         // makes the Gaussian's integral 1
  std::array<float, steps + 1> inverse_{};  // of the Gaussian's cumulative distribution
};

}  // namespace renderer
