// SPDX-License-Identifier: MIT
// Measurement: four readings of sensors (paper, section 3.1). Not a Stokes vector: it has no frame
// and no direction, so that readings of differently oriented sensors may be summed, and nothing can
// be done to its polarisation any more.
#pragma once

#include <array>
#include <cstddef>

#include <glm/vec4.hpp>

#include <malus/detail/glm_conversion.hpp>
#include <malus/spectrum.hpp>

namespace malus {

template <SpectralValue V>
class Measurement {
 public:
  using value_type = V;
  using scalar_type = scalar_t<V>;

  /// Nothing was read.
  constexpr Measurement() { reading_.fill(V(0)); }
  constexpr Measurement(const V& r0, const V& r1, const V& r2, const V& r3)
      : reading_{r0, r1, r2, r3} {
    for (V& r : reading_) detail::hide_constant(r);
  }

  /// Reading i of 0…3.
  constexpr const V& operator[](std::size_t i) const { return reading_[i]; }

  constexpr Measurement& operator+=(const Measurement& m) {
    for (std::size_t i = 0; i < 4; ++i) reading_[i] += m.reading_[i];
    return *this;
  }
  constexpr Measurement& operator*=(const V& k) {
    for (V& r : reading_) r *= k;
    return *this;
  }
  friend constexpr Measurement operator+(Measurement a, const Measurement& b) { return a += b; }
  friend constexpr Measurement operator*(Measurement m, const V& k) { return m *= k; }
  friend constexpr Measurement operator*(const V& k, Measurement m) { return m *= k; }
  friend constexpr Measurement operator*(Measurement m, scalar_type k)
    requires(!std::same_as<scalar_type, V>)
  {
    return m *= V(k);
  }
  friend constexpr Measurement operator*(scalar_type k, Measurement m)
    requires(!std::same_as<scalar_type, V>)
  {
    return m *= V(k);
  }
  friend constexpr bool operator==(const Measurement& a, const Measurement& b) {
    return a.reading_ == b.reading_;
  }

  /// From GLM's four readings, one vector a channel.
  template <class T>
  static constexpr Measurement from_vec4(const std::array<glm::vec<4, T>, channel_count<V>>& r) {
    const auto value = detail::gather_vector<V>(r);
    return {value[0], value[1], value[2], value[3]};
  }

  /// One channel's readings, as GLM's vector.
  constexpr glm::vec<4, scalar_type> to_vec4(std::size_t i = 0) const {
    return {channel(reading_[0], i), channel(reading_[1], i), channel(reading_[2], i),
            channel(reading_[3], i)};
  }

 private:
  std::array<V, 4> reading_;
};

}  // namespace malus
