// SPDX-License-Identifier: MIT
#include "reconstruction_filter.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace renderer {

ReconstructionFilter::ReconstructionFilter(Kind kind, float width) : kind_(kind), width_(width) {
  if (kind != Kind::gaussian) return;
  // Mitsuba's Gaussian, which falls to exactly zero where it is cut off.
  const double sigma = static_cast<double>(width), radius = 4 * sigma;
  const double floor = std::exp(-8.0);
  const auto density = [&](double x) {
    return std::max(0.0, std::exp(-0.5 * x * x / (sigma * sigma)) - floor);
  };
  constexpr std::size_t fine = 65536;
  std::vector<double> cumulative(fine + 1, 0.0);
  for (std::size_t i = 0; i < fine; ++i) {
    const double x = radius * (2 * (static_cast<double>(i) + 0.5) / fine - 1);
    cumulative[i + 1] = cumulative[i] + density(x);
  }
  scale_ = static_cast<float>(fine / (2 * radius * cumulative[fine]));
  for (std::size_t i = 0; i <= steps; ++i) {
    const double target = cumulative[fine] * static_cast<double>(i) / steps;
    const auto found = std::lower_bound(cumulative.begin(), cumulative.end(), target);
    const auto k = static_cast<std::size_t>(found - cumulative.begin());
    double place = static_cast<double>(k);
    if (k > 0) place -= (cumulative[k] - target) / (cumulative[k] - cumulative[k - 1]);
    inverse_[i] = static_cast<float>(radius * (2 * place / fine - 1));
  }
}

float ReconstructionFilter::sample_1d(float u) const {
  switch (kind_) {
    case Kind::box:
      return width_ * (2 * u - 1);
    case Kind::tent:
      return width_ * (u < 0.5f ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 * (1 - u)));
    default: {
      const float x = u * steps;
      const auto i = std::min(static_cast<std::size_t>(x), steps - 1);
      const float f = x - static_cast<float>(i);
      return inverse_[i] + f * (inverse_[i + 1] - inverse_[i]);
    }
  }
}

float ReconstructionFilter::density_1d(float x) const {
  switch (kind_) {
    case Kind::box:
      return x >= -width_ && x < width_ ? 1 / (2 * width_) : 0.0f;
    case Kind::tent:
      return std::max(0.0f, 1 - std::abs(x) / width_) / width_;
    default: {
      const float z = x / width_;
      return scale_ * std::max(0.0f, std::exp(-0.5f * z * z) - std::exp(-8.0f));
    }
  }
}

}  // namespace renderer
