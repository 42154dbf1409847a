// SPDX-License-Identifier: MIT
// What the tests of optics share: repeatable random parameters, and distances between matrices.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>

#include <malus/mueller.hpp>

namespace optics_test {

inline constexpr double pi = std::numbers::pi;
constexpr double radians(double degrees) { return degrees * (pi / 180); }

using Double3 = malus::Spectrum<double, 3>;

/// The same numbers with every standard library: its distributions are not.
class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  /// In [0, 1).
  double unit() { return static_cast<double>(engine_()) * 0x1p-32; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  std::size_t below(std::size_t count) {
    return static_cast<std::size_t>(unit() * static_cast<double>(count));
  }
  std::array<double, 3> direction() {
    const double z = between(-1, 1), phi = between(0, 2 * pi), r = std::sqrt(1 - z * z);
    return {r * std::cos(phi), r * std::sin(phi), z};
  }
  malus::Frame<double> frame() {
    return malus::Frame<double>::about(direction()).turned(between(0, 2 * pi));
  }
  Double3 between3(double low, double high) {
    return {between(low, high), between(low, high), between(low, high)};
  }

 private:
  std::mt19937 engine_;
};

/// The larger of a bound and a magnitude; a NaN wins, so that it is close to nothing.
inline double worse(double bound, double difference) {
  return std::abs(difference) <= bound ? bound : std::abs(difference);
}

/// The largest difference of one channel of a Mueller matrix from 16 components by rows.
template <class M, class Rows>
double deviation(const M& m, const Rows& rows, std::size_t channel = 0) {
  double worst = 0;
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c)
      worst = worse(worst, static_cast<double>(malus::channel(m(r, c), channel)) -
                               rows[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)]);
  return worst;
}

/// The largest difference of one channel of a Stokes vector, or of readings, from four components.
template <class S, class Four>
double deviation_of_four(const S& s, const Four& expected, std::size_t channel = 0) {
  double worst = 0;
  for (std::size_t i = 0; i < 4; ++i)
    worst = worse(worst, static_cast<double>(malus::channel(s[i], channel)) - expected[i]);
  return worst;
}

/// The largest difference of two matrices of any value, by components and channels.
template <class A, class B>
double difference(const A& a, const B& b) {
  double worst = 0;
  for (int i = 0; i < 16; ++i)
    for (std::size_t k = 0; k < malus::channel_count<typename A::value_type>; ++k)
      worst = worse(worst, static_cast<double>(malus::channel(a(i / 4, i % 4), k)) -
                               static_cast<double>(malus::channel(b(i / 4, i % 4), k)));
  return worst;
}

template <class M>
bool all_finite(const M& m) {
  for (int i = 0; i < 16; ++i)
    if (!malus::is_finite(m(i / 4, i % 4))) return false;
  return true;
}

}  // namespace optics_test
