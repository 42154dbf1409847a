// SPDX-License-Identifier: MIT
// The numbers that samples are drawn by, of one of two kinds. A picture depends on the seed alone
// and not on which thread renders what when:
//
//   independent: a PCG32 stream (O'Neill 2014) of its own for every sample of every pixel;
//   sobol: points of the first two dimensions of Sobol's sequence (1967), scrambled as by Owen
//   (1995), whose samples spread evenly over the unit square: any 2^k from the first on put one
//   point into each of 2^k equal boxes, of every shape. Every pair of draws is such a sequence of
//   its own, in an order of its own (sobol_points.hpp). Each draw is uniform, so that means are
//   right whatever is drawn when, but samples of one sequence are not independent of each other:
//   estimates of errors compare sequences.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "sobol_points.hpp"

namespace renderer {

/// A well-mixed function of 64 bits (the finaliser of SplitMix64, Steele et al. 2014).
constexpr std::uint64_t mix_bits(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

enum class SamplerKind { independent, sobol };
constexpr const char* name_of(SamplerKind kind) {
  return kind == SamplerKind::sobol ? "sobol" : "independent";
}

class Sampler {
 public:
  /// Independent numbers: the stream of one sample of one pixel under a seed.
  Sampler(std::uint64_t seed, std::uint64_t pixel, std::uint64_t sample)
      : state_(0), increment_((mix_bits(mix_bits(seed) ^ pixel) << 1) | 1u) {
    next();
    state_ += mix_bits(increment_ ^ mix_bits(sample));
    next();
  }

  /// Point `index` of a scrambled Sobol sequence under a seed. Sequences of different numbers are
  /// independent.
  static Sampler sobol(std::uint64_t seed, std::uint64_t sequence, std::uint64_t index) {
    return {SamplerKind::sobol, mix_bits(mix_bits(mix_bits(seed) ^ sequence) ^ (index >> 32)),
            static_cast<std::uint32_t>(index)};
  }

  /// Uniform in [0, 1).
  float next_1d() {
    if (is_sobol_) return next_single();
    return static_cast<float>(next() >> 8) * 0x1p-24f;
  }
  /// The same, independent of everything with either kind: for a choice that gains nothing by
  /// being spread evenly, and would take other draws out of step if it were.
  float next_choice() {
    if (!is_sobol_) return next_1d();
    const std::uint64_t number = increment_ << 32 | ++choices_;
    return static_cast<float>(mix_bits(state_ ^ number) >> 40) * 0x1p-24f;
  }
  Vec2 next_2d() {
    if (is_sobol_) return next_pair();
    const float x = next_1d();
    return {x, next_1d()};
  }

 private:
  Sampler(SamplerKind, std::uint64_t scramble, std::uint32_t index)
      : state_(scramble), increment_(index), is_sobol_(true) {}

  std::uint32_t next() {
    const std::uint64_t old = state_;
    state_ = old * 6364136223846793005ull + increment_;
    const auto shifted = static_cast<std::uint32_t>(((old >> 18) ^ old) >> 27);
    return std::rotr(shifted, static_cast<int>(old >> 59));
  }

  Vec2 next_pair() {
    const std::size_t i = drawn_++ % SobolPoints::count;
    if (i == 0) points_.fill(state_, static_cast<std::uint32_t>(increment_), drawn_ - 1);
    return {points_.x[i], points_.y[i]};
  }
  /// Two draws of one number make a pair.
  float next_single() {
    if (has_spare_) {
      has_spare_ = false;
      return spare_;
    }
    const Vec2 pair = next_pair();
    spare_ = pair.y;
    has_spare_ = true;
    return pair.x;
  }

  // Of independent numbers, the generator's; of a sequence, its scrambling and the index in it.
  std::uint64_t state_, increment_;
  bool is_sobol_ = false, has_spare_ = false;
  std::uint32_t drawn_ = 0;  // pairs
  std::uint32_t choices_ = 0;
  float spare_;
  SobolPoints points_;
};

}  // namespace renderer
