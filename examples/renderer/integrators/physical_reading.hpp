// SPDX-License-Identifier: MIT
// What a sensor reads is light, of which no more can be polarised than there is. Where light is
// extinguished, as between crossed polarizers, rounding leaves something that need not be.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <malus/measurement.hpp>

#include "../core/rounding.hpp"

namespace renderer {

namespace physical_reading {

/// A channel's total and the square of its polarised part, of finite readings. In double precision,
/// since squares of small floats vanish and those of large ones overflow.
struct Channel {
  template <class V>
  Channel(const malus::Measurement<V>& m, std::size_t c) : total(m[0][c]) {
    for (std::size_t i = 1; i < 4; ++i) {
      const double part = m[i][c];
      polarized_squared += part * part;
    }
  }
  bool is_physical() const {
    const double most = total + rounding_of_polarization(total);
    return total >= 0 && polarized_squared <= most * most;
  }

  double total, polarized_squared = 0;
};

/// What nearly all readings are by single precision alone, where no square leaves its range. All
/// channels at once.
template <class V>
MALUS_INLINE bool is_plainly_physical(const malus::Measurement<V>& m) {
  constexpr float least = 1e-18f, most = 1e18f;
  const V polarized_squared = m[1] * m[1] + m[2] * m[2] + m[3] * m[3];
  const V excess = polarized_squared - m[0] * m[0] * 1.0001f;
  return malus::max_channel(excess) <= 0 && malus::max_channel(-m[0]) < -least &&
         malus::max_channel(m[0]) < most;
}

}  // namespace physical_reading

/// Whether the finite readings of S0…S3 can be those of light, in every channel, but for rounding.
template <class V>
bool is_physical(const malus::Measurement<V>& m) {
  if (physical_reading::is_plainly_physical(m)) return true;
  for (std::size_t c = 0; c < V::channels; ++c)
    if (!physical_reading::Channel(m, c).is_physical()) return false;
  return true;
}

/// The same intensity, or 0 where it is negative, and as much of the polarised part as it can have.
template <class V>
malus::Measurement<V> made_physical(const malus::Measurement<V>& m) {
  V polarized = V(1), total = m[0];
  for (std::size_t c = 0; c < V::channels; ++c) {
    const physical_reading::Channel channel(m, c);
    if (channel.is_physical()) continue;
    const double least = std::max(channel.total, 0.0);
    total.set(c, static_cast<typename V::scalar_type>(least));
    polarized.set(c, static_cast<typename V::scalar_type>(
                         least > 0 ? least / std::sqrt(channel.polarized_squared) : 0.0));
  }
  return {total, m[1] * polarized, m[2] * polarized, m[3] * polarized};
}

}  // namespace renderer
