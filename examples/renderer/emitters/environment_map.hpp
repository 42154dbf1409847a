// SPDX-License-Identifier: MIT
// Radiance from infinity by direction: a picture in longitude and colatitude, as Mitsuba's
// "envmap" has it. Columns are longitudes atan2(x, −z), from 0 to 360 degrees from the left edge to
// the right one, so that +z is in the picture's middle, and texels have theirs at their centres.
// Rows are angles θ from +y, the first at 0 and the last at 180 degrees. Between texels radiance is
// bilinear. Directions are drawn by the bilinear interpolation of luminance times sin θ.
#pragma once

#include <vector>

#include "../textures/bitmap.hpp"

namespace renderer {

class EnvironmentMap {
 public:
  /// Of 2 columns and 3 rows at least, no value below 0. `to_world` turns, or mirrors.
  EnvironmentMap(Texels radiance, const glm::mat3& to_world);

  /// What comes from a direction that points to infinity, unit.
  Rgb radiance(const Vec3& direction) const;
  /// Draws a direction to where light comes from, and says with which density by solid angle; false
  /// where there is none.
  bool sample(Vec2 u, Vec3& direction, float& pdf) const;
  float pdf(const Vec3& direction) const;

  /// The integral of the radiance over all directions: times the area of a disk, the power that a
  /// ball of its radius meets.
  const Rgb& total() const { return total_; }

 private:
  /// A place between four texels: the upper left one, and how far it is to the lower right one.
  struct Cell {
    int column, row;
    Vec2 fraction;
    float sin_theta;
  };
  Cell cell(const Vec3& direction) const;
  int right_of(int column) const { return column + 1 < map_.width ? column + 1 : 0; }
  /// Luminance times sin θ at a texel.
  float weight(int column, int row) const {
    return luminance(map_.at(column, row)) * row_sine_[static_cast<std::size_t>(row)];
  }
  void make_row_sines();
  void make_distribution();
  float density(const Cell& cell) const;

  Texels map_;
  glm::mat3 to_world_;
  /// sin θ as the average over the rows between which a texel's share of the radiance falls to 0:
  /// above 0 at the poles, too, where light would be there that is never drawn.
  std::vector<float> row_sine_;
  std::vector<float> rows_;   // cumulative shares of the rows of cells
  std::vector<float> cells_;  // cumulative shares of each row's cells in it
  double mass_ = 0;           // the sum of all cells' mean weights
  Rgb total_{0.0f};
};

}  // namespace renderer
