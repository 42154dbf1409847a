// SPDX-License-Identifier: MIT
// Between GLM's vectors and matrices of one channel and values of all channels. GLM's matrices are
// indexed by columns: component (r, c) is matrix[c][r].
#pragma once

#include <array>
#include <cstddef>

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include <malus/spectrum.hpp>

namespace malus::detail {

/// A value of which f(c) gives channel c.
template <SpectralValue V, class F>
constexpr V gather_channels(F&& f) {
  V value(scalar_t<V>(0));
  for (std::size_t c = 0; c < channel_count<V>; ++c)
    set_channel(value, c, static_cast<scalar_t<V>>(f(c)));
  return value;
}

/// The four components of one vector a channel.
template <SpectralValue V, class T>
constexpr std::array<V, 4> gather_vector(const std::array<glm::vec<4, T>, channel_count<V>>& v) {
  std::array<V, 4> value;
  for (int i = 0; i < 4; ++i)
    value[static_cast<std::size_t>(i)] =
        gather_channels<V>([&](std::size_t channel) { return v[channel][i]; });
  return value;
}

/// The rows of one matrix a channel.
template <SpectralValue V, class T>
constexpr std::array<std::array<V, 4>, 4> gather_rows(
    const std::array<glm::mat<4, 4, T>, channel_count<V>>& m) {
  std::array<std::array<V, 4>, 4> rows;
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c)
      rows[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)] =
          gather_channels<V>([&](std::size_t channel) { return m[channel][c][r]; });
  return rows;
}

/// One channel of component(r, c) as GLM's matrix.
template <class T, class F>
constexpr glm::mat<4, 4, T> to_glm_matrix(std::size_t i, F&& component) {
  glm::mat<4, 4, T> matrix;
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c) matrix[c][r] = channel(component(r, c), i);
  return matrix;
}

}  // namespace malus::detail
