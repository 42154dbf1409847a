// SPDX-License-Identifier: MIT
// Independent random numbers: one PCG32 stream (O'Neill 2014) for every sample of every pixel, so
// that a picture depends on the seed alone and not on which thread renders what when.
#pragma once

#include <bit>
#include <cstdint>

#include "vector.hpp"

namespace renderer {

/// A well-mixed function of 64 bits (the finaliser of SplitMix64, Steele et al. 2014).
constexpr std::uint64_t mix_bits(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

class Sampler {
 public:
  /// The stream of one sample of one pixel under a seed.
  Sampler(std::uint64_t seed, std::uint64_t pixel, std::uint64_t sample)
      : state_(0), increment_((mix_bits(mix_bits(seed) ^ pixel) << 1) | 1u) {
    next();
    state_ += mix_bits(increment_ ^ mix_bits(sample));
    next();
  }

  /// Uniform in [0, 1).
  float next_1d() { return static_cast<float>(next() >> 8) * 0x1p-24f; }
  Vec2 next_2d() {
    const float x = next_1d();
    return {x, next_1d()};
  }

 private:
  std::uint32_t next() {
    const std::uint64_t old = state_;
    state_ = old * 6364136223846793005ull + increment_;
    const auto shifted = static_cast<std::uint32_t>(((old >> 18) ^ old) >> 27);
    return std::rotr(shifted, static_cast<int>(old >> 59));
  }

  std::uint64_t state_, increment_;
};

}  // namespace renderer
