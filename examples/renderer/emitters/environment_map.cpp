// SPDX-License-Identifier: MIT
#include "environment_map.hpp"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <span>

namespace renderer {

namespace {

/// From 0 to 1 with a density that runs linearly from a to b; not both are 0.
float draw_linear(float u, float a, float b) {
  const float x = u * (a + b) / (a + std::sqrt((1 - u) * a * a + u * b * b));
  return std::min(x, 0x1.fffffep-1f);
}

float mix(float a, float b, float t) { return (1 - t) * a + t * b; }

/// The step of a cumulative distribution at u, which becomes its place within the step.
int draw_step(std::span<const float> cumulative, float& u) {
  const auto found = std::upper_bound(cumulative.begin(), cumulative.end(), u);
  const auto i =
      std::min(static_cast<std::size_t>(found - cumulative.begin()), cumulative.size() - 1);
  const float before = i > 0 ? cumulative[i - 1] : 0.0f, width = cumulative[i] - before;
  u = width > 0 ? std::clamp((u - before) / width, 0.0f, 0x1.fffffep-1f) : 0.5f;
  return static_cast<int>(i);
}

}  // namespace

EnvironmentMap::EnvironmentMap(Texels radiance, const glm::mat3& to_world)
    : map_(std::move(radiance)), to_world_(to_world) {
  make_row_sines();
  make_distribution();
}

void EnvironmentMap::make_row_sines() {
  const double step = glm::pi<double>() / (map_.height - 1);
  glm::dvec3 total(0);
  for (int row = 0; row < map_.height; ++row) {
    const bool is_pole = row == 0 || row + 1 == map_.height;
    const double integral = is_pole ? 1 - std::sin(step) / step
                                    : 2 * std::sin(row * step) * (1 - std::cos(step)) / step;
    row_sine_.push_back(static_cast<float>(integral / (is_pole ? step / 2 : step)));
    glm::dvec3 sum(0);
    for (int column = 0; column < map_.width; ++column) {
      const Rgb& c = map_.at(column, row);
      sum += glm::dvec3(c[0], c[1], c[2]);
    }
    total += sum * (integral * 2 * glm::pi<double>() / map_.width);
  }
  total_ = to_rgb(total);
}

void EnvironmentMap::make_distribution() {
  const auto width = static_cast<std::size_t>(map_.width);
  std::vector<double> sums(width);
  std::vector<double> mass_to_row;
  for (int row = 0; row + 1 < map_.height; ++row) {
    double sum = 0;
    for (int column = 0; column < map_.width; ++column) {
      const int right = right_of(column);
      for (const int c : {column, right})
        for (const int r : {row, row + 1}) sum += 0.25 * static_cast<double>(weight(c, r));
      sums[static_cast<std::size_t>(column)] = sum;
    }
    for (const double s : sums) cells_.push_back(sum > 0 ? static_cast<float>(s / sum) : 0.0f);
    mass_ += sum;
    mass_to_row.push_back(mass_);
  }
  for (const double m : mass_to_row) rows_.push_back(mass_ > 0 ? static_cast<float>(m / mass_) : 0);
}

EnvironmentMap::Cell EnvironmentMap::cell(const Vec3& direction) const {
  const Vec3 d = glm::transpose(to_world_) * direction;
  const float sin_theta = std::hypot(d.x, d.z);
  const auto w = static_cast<float>(map_.width), h = static_cast<float>(map_.height - 1);
  float x = std::atan2(d.x, -d.z) / (2 * pi) * w - 0.5f;
  if (x < 0) x += w;
  const float y = std::atan2(sin_theta, d.y) / pi * h;
  // The minima are for rounding, which may give the places just beyond the last.
  const float column = std::min(std::floor(x), w - 1), row = std::min(std::floor(y), h - 1);
  return {static_cast<int>(column),
          static_cast<int>(row),
          {std::min(x - column, 1.0f), std::min(y - row, 1.0f)},
          sin_theta};
}

Rgb EnvironmentMap::radiance(const Vec3& direction) const {
  const Cell c = cell(direction);
  const int right = right_of(c.column);
  const auto [x, y] = std::pair(c.fraction.x, c.fraction.y);
  return (map_.at(c.column, c.row) * (1 - x) + map_.at(right, c.row) * x) * (1 - y) +
         (map_.at(c.column, c.row + 1) * (1 - x) + map_.at(right, c.row + 1) * x) * y;
}

float EnvironmentMap::density(const Cell& c) const {
  if (!(mass_ > 0)) return 0;
  const int right = right_of(c.column);
  const float w =
      mix(mix(weight(c.column, c.row), weight(right, c.row), c.fraction.x),
          mix(weight(c.column, c.row + 1), weight(right, c.row + 1), c.fraction.x), c.fraction.y);
  // From a density by cells to one by solid angle; at a pole, where that has none, to a large one.
  const float cells_per_radian2 =
      static_cast<float>(map_.width) * static_cast<float>(map_.height - 1) / (2 * pi * pi);
  return w / static_cast<float>(mass_) * cells_per_radian2 / std::max(c.sin_theta, 1e-6f);
}

float EnvironmentMap::pdf(const Vec3& direction) const { return density(cell(direction)); }

bool EnvironmentMap::sample(Vec2 u, Vec3& direction, float& pdf) const {
  if (!(mass_ > 0)) return false;
  const int row = draw_step(rows_, u.y);
  const auto width = static_cast<std::size_t>(map_.width);
  const int column = draw_step({cells_.data() + static_cast<std::size_t>(row) * width, width}, u.x);
  const int right = right_of(column);
  const float upper[2] = {weight(column, row), weight(right, row)},
              lower[2] = {weight(column, row + 1), weight(right, row + 1)};
  const float y = draw_linear(u.y, upper[0] + upper[1], lower[0] + lower[1]);
  const float x = draw_linear(u.x, mix(upper[0], lower[0], y), mix(upper[1], lower[1], y));

  const float longitude =
      (static_cast<float>(column) + 0.5f + x) / static_cast<float>(map_.width) * 2 * pi;
  const float theta = (static_cast<float>(row) + y) / static_cast<float>(map_.height - 1) * pi;
  const float sin_theta = std::sin(theta);
  direction = glm::normalize(to_world_ * Vec3(std::sin(longitude) * sin_theta, std::cos(theta),
                                              -std::cos(longitude) * sin_theta));
  pdf = density({column, row, {x, y}, sin_theta});
  return pdf > 0;
}

}  // namespace renderer
