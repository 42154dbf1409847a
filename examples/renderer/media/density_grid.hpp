// SPDX-License-Identifier: MIT
// A density, or an albedo, that varies within a box: values at the centres of a grid's cells,
// between which they are interpolated; outside the outermost centres the nearest counts, and
// outside the box there is none. As Mitsuba's "gridvolume".
#pragma once

#include <cstdint>
#include <vector>

#include "../core/vector.hpp"

namespace renderer {

struct GridValues {
  glm::ivec3 size{1};  ///< in cells, none of them 0
  int channels = 1;    ///< or 3
  /// A cell's channels together, x fastest, then y; finite, none is negative.
  std::vector<float> values;
};

class DensityGrid {
 public:
  enum class Filter { trilinear, nearest };
  enum class Outside { nothing, nearest };  ///< what counts outside the box

  /// `to_world` brings the unit cube to the box.
  DensityGrid(GridValues grid, const glm::dmat4& to_world, Filter filter = Filter::trilinear,
              Outside outside = Outside::nothing);

  /// At a point of the world.
  Rgb operator()(const Vec3& point) const;
  /// No channel is above it anywhere.
  float maximum() const { return maximum_; }
  /// Over the box, each channel by itself.
  const Rgb& mean() const { return mean_; }
  /// Where a ray is in the box: from.x to from.y, as parts of its direction's length. Empty (x > y)
  /// where it never is; the whole ray where the box isn't the end.
  Vec2 clip(const Vec3& origin, const Vec3& direction) const;

 private:
  template <class V>
  V cell(std::uint32_t index) const;
  template <class V>
  V nearest(const Vec3& p) const;
  template <class V>
  V trilinear(const Vec3& p) const;

  GridValues grid_;
  glm::mat4x3 to_cells_;     // from the world to where one cell is a unit cube
  Vec3 extent_{}, last_{};   // of the box, and of the last cell's centre from the first's, in cells
  std::uint32_t step_[3]{};  // to the next cell's number along each axis, 0 where there is one cell
  Filter filter_;
  Outside outside_;
  float maximum_ = 0;
  Rgb mean_{0.0f};
};

}  // namespace renderer
