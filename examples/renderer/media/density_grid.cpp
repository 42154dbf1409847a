// SPDX-License-Identifier: MIT
#include "density_grid.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>

namespace renderer {

namespace {

/// A NaN becomes 0, so that whatever is asked for is there.
float clamped(float x, float highest) { return x > 0 ? std::min(x, highest) : 0.0f; }

Rgb spread(float v) { return Rgb(v); }
Rgb spread(const Rgb& v) { return v; }

}  // namespace

DensityGrid::DensityGrid(GridValues grid, const glm::dmat4& to_world, Filter filter,
                         Outside outside)
    : grid_(std::move(grid)), extent_(grid_.size), filter_(filter), outside_(outside) {
  glm::dmat4 cells(1.0);
  std::uint32_t step = 1;
  for (int i = 0; i < 3; ++i) {
    cells[i][i] = grid_.size[i];
    last_[i] = extent_[i] - 1;
    step_[i] = grid_.size[i] > 1 ? step : 0;
    step *= static_cast<std::uint32_t>(grid_.size[i]);
  }
  to_cells_ = glm::mat4x3(glm::dmat4x3(cells * glm::inverse(to_world)));

  // Every cell counts alike in the interpolated field's mean, too: those at the box's faces have
  // half a cell for themselves where the others have a slope on either side.
  double sums[3]{};
  const auto channels = static_cast<std::size_t>(grid_.channels);
  float largest = 0;
  for (std::size_t i = 0; i < grid_.values.size(); ++i) {
    sums[i % channels] += static_cast<double>(grid_.values[i]);
    largest = std::max(largest, grid_.values[i]);
  }
  const auto mean = [&](std::size_t i) { return sums[i % channels] / static_cast<double>(step); };
  mean_ = to_rgb({mean(0), mean(1), mean(2)});
  // Interpolation rounds.
  maximum_ = largest * (1 + 1e-6f);
}

template <class V>
inline V DensityGrid::cell(std::uint32_t index) const {
  if constexpr (std::is_same_v<V, float>) {
    return grid_.values[index];
  } else {
    const float* v = &grid_.values[std::size_t{3} * index];
    return {v[0], v[1], v[2]};
  }
}

template <class V>
inline V DensityGrid::nearest(const Vec3& p) const {
  std::uint32_t index = 0;
  for (int i = 0; i < 3; ++i)
    index += step_[i] * static_cast<std::uint32_t>(clamped(p[i], last_[i]));
  return cell<V>(index);
}

template <class V>
inline V DensityGrid::trilinear(const Vec3& p) const {
  std::uint32_t index = 0;
  Vec3 part;
  for (int i = 0; i < 3; ++i) {
    const float from_first = clamped(p[i] - 0.5f, last_[i]);
    // At the last centre the cell before it is the lower one, wholly outweighed.
    const float lower = std::min(std::floor(from_first), std::max(last_[i] - 1, 0.0f));
    index += step_[i] * static_cast<std::uint32_t>(lower);
    part[i] = from_first - lower;
  }
  const auto [dx, dy, dz] = step_;
  const auto along_x = [&](std::uint32_t at) {
    return cell<V>(at) * (1 - part.x) + cell<V>(at + dx) * part.x;
  };
  const auto along_y = [&](std::uint32_t at) {
    return along_x(at) * (1 - part.y) + along_x(at + dy) * part.y;
  };
  return along_y(index) * (1 - part.z) + along_y(index + dz) * part.z;
}

Rgb DensityGrid::operator()(const Vec3& point) const {
  const Vec3 p = to_cells_ * glm::vec4(point, 1);
  if (outside_ == Outside::nothing && !(p.x >= 0 && p.x <= extent_.x && p.y >= 0 &&
                                        p.y <= extent_.y && p.z >= 0 && p.z <= extent_.z))
    return Rgb(0.0f);
  const auto value = [&]<class V>(V) {
    return spread(filter_ == Filter::nearest ? nearest<V>(p) : trilinear<V>(p));
  };
  return grid_.channels == 1 ? value(0.0f) : value(Rgb(0.0f));
}

Vec2 DensityGrid::clip(const Vec3& origin, const Vec3& direction) const {
  Vec2 range{-infinity, infinity};
  if (outside_ == Outside::nearest) return range;
  const Vec3 from = to_cells_ * glm::vec4(origin, 1), step = to_cells_ * glm::vec4(direction, 0);
  for (int i = 0; i < 3; ++i) {
    if (step[i] == 0) {
      if (!(from[i] >= 0 && from[i] <= extent_[i])) return {infinity, -infinity};
      continue;
    }
    const float at_low = -from[i] / step[i], at_high = (extent_[i] - from[i]) / step[i];
    range.x = std::max(range.x, std::min(at_low, at_high));
    range.y = std::min(range.y, std::max(at_low, at_high));
  }
  return range;
}

}  // namespace renderer
