// SPDX-License-Identifier: MIT
// One estimate of a picture: twelve planes, S0.R S0.G S0.B S1.R … S3.B, and what it cost.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace convergence {

inline constexpr std::size_t planes = 12;

struct Picture {
  int width = 0, height = 0;
  std::vector<float> data;  ///< plane by plane
  std::uint64_t samples = 0;
  double seconds = 0;

  std::size_t pixels() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  std::span<const float> plane(std::size_t i) const {
    return {data.data() + i * pixels(), pixels()};
  }
};

}  // namespace convergence
