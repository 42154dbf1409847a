// SPDX-License-Identifier: MIT
#include "exposure.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "../core/parallel.hpp"
#include "../integrators/counters.hpp"

namespace renderer {

void Exposure::add_to_rows(const Splat& splat, std::size_t layer, int first_row, int last_row) {
  const float r = film_.filter.radius();
  const Vec2 place = splat.place - Vec2(film_.crop_x, film_.crop_y);
  // The pixels whose centres, at ½, are within the filter's radius.
  const auto first = [r](float x) { return static_cast<int>(std::ceil(x - 0.5f - r)); };
  const auto last = [r](float x) { return static_cast<int>(std::floor(x - 0.5f + r)); };
  const int y1 = std::min(last(place.y), last_row - 1);
  const int x0 = std::max(first(place.x), 0);
  const int x1 = std::min(last(place.x), film_.crop_width - 1);
  for (int y = std::max(first(place.y), first_row); y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      const float share = film_.filter.density(place - Vec2(x, y) - 0.5f);
      if (share > 0)
        readings_[layer * pixels_ +
                  static_cast<std::size_t>(y) * static_cast<std::size_t>(film_.crop_width) +
                  static_cast<std::size_t>(x)] += splat.reading * share;
    }
}

void Exposure::add(std::span<const SplatList> lists) {
  // Every thread has rows of its own and goes through all lists in the same order.
  const int threads = tbb::this_task_arena::max_concurrency();
  const auto grain = static_cast<std::size_t>((film_.crop_height + threads - 1) / threads);
  parallel_for(
      static_cast<std::size_t>(film_.crop_height), grain, [&](std::size_t first, std::size_t last) {
        for (const SplatList& list : lists)
          for (const Splat& splat : list.splats)
            add_to_rows(splat, list.layer, static_cast<int>(first), static_cast<int>(last));
      });
}

std::uint64_t Exposure::develop(std::size_t layer, std::size_t batch, Film& film) const {
  std::atomic<std::uint64_t> dropped{0};
  parallel_for(pixels_, 4096, [&](std::size_t first, std::size_t last) {
    for (std::size_t p = first; p != last; ++p) {
      const auto& reading = readings_[layer * pixels_ + p];
      if (is_finite(reading))
        film.at(p, batch).add(reading);
      else
        ++dropped;
    }
  });
  return dropped;
}

}  // namespace renderer
