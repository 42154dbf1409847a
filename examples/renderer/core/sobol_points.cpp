// SPDX-License-Identifier: MIT
#include "sobol_points.hpp"

namespace renderer {

namespace {

constexpr std::uint32_t reverse_bits(std::uint32_t x) {
  x = (x << 16) | (x >> 16);
  x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
  x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
  x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
  return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}

/// A hash of 32 bits without much bias (Wellons 2018, "lowbias32").
constexpr std::uint32_t mix(std::uint32_t x) {
  x = (x ^ (x >> 16)) * 0x7feb352du;
  x = (x ^ (x >> 15)) * 0x846ca68bu;
  return x ^ (x >> 16);
}

/// Owen's scrambling of a number of reversed bits: flips each by a hash of those below (Laine &
/// Karras 2011, with Vegdahl's constants of 2021).
constexpr std::uint32_t scramble_reversed(std::uint32_t x, std::uint32_t seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  return x ^ (x * 0x53a22864u);
}

/// The second dimension's matrix is Pascal's triangle modulo 2: bits taken for the coefficients of
/// a polynomial p(t) become those of p(t + 1), since (t + 1)^(2^k) = t^(2^k) + 1.
constexpr std::uint32_t pascal(std::uint32_t x) {
  x ^= x >> 16;
  x ^= (x & 0xff00ff00u) >> 8;
  x ^= (x & 0xf0f0f0f0u) >> 4;
  x ^= (x & 0xccccccccu) >> 2;
  return x ^ ((x & 0xaaaaaaaau) >> 1);
}

constexpr float to_unit(std::uint32_t bits) {
  return static_cast<float>(static_cast<std::int32_t>(bits >> 8)) * 0x1p-24f;
}

// Burley 2020: a shuffled order is a scrambling of the index, and leaves every 2^k points together.
// One loop without branches, for compilers to make vectors of.
[[gnu::always_inline]] inline void fill_points(SobolPoints& points, std::uint64_t scramble,
                                               std::uint32_t index, std::uint32_t first) {
  const auto low = static_cast<std::uint32_t>(scramble);
  const auto high = static_cast<std::uint32_t>(scramble >> 32);
  const std::uint32_t reversed = reverse_bits(index);
  for (std::uint32_t i = 0; i < SobolPoints::count; ++i) {
    const std::uint32_t a = mix(low + (first + i) * 0x9e3779b9u);
    const std::uint32_t b = mix(a ^ high), c = mix(b + high);
    const std::uint32_t shuffled = reverse_bits(scramble_reversed(reversed, a));
    // Both coordinates are of reversed bits until they have been scrambled.
    points.x[i] = to_unit(reverse_bits(scramble_reversed(shuffled, b)));
    points.y[i] = to_unit(reverse_bits(scramble_reversed(pascal(shuffled), c)));
  }
}

// Without AVX2 there is no multiplication of vectors of integers, and this takes six times as long.
// Programs that are compiled for any x86 processor ask for it when they run; bits are the same.
#if defined(__GNUC__) && defined(__x86_64__) && !defined(__AVX2__)
constexpr bool may_be_wider = true;
bool has_avx2() { return __builtin_cpu_supports("avx2") != 0; }
[[gnu::target("avx2")]] void fill_wide(SobolPoints& points, std::uint64_t scramble,
                                       std::uint32_t index, std::uint32_t first) {
  fill_points(points, scramble, index, first);
}
#else
constexpr bool may_be_wider = false;
bool has_avx2() { return false; }
void fill_wide(SobolPoints&, std::uint64_t, std::uint32_t, std::uint32_t) {}
#endif

}  // namespace

void SobolPoints::fill(std::uint64_t scramble, std::uint32_t index, std::uint32_t first) {
  static const bool is_wide = may_be_wider && has_avx2();
  if (is_wide)
    fill_wide(*this, scramble, index, first);
  else
    fill_points(*this, scramble, index, first);
}

}  // namespace renderer
