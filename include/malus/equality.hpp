// SPDX-License-Identifier: MIT
// Equality modulo frame: [S, F] = [G F⁻¹ S, G] are one and the same light (paper, section 4.1 and
// Appendix A), and so for Mueller matrices and importance. Directions must agree; forms need not.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <malus/sum.hpp>

namespace malus {

namespace detail {

template <class V>
constexpr scalar_t<V> largest_magnitude(const V* values, std::size_t count) {
  scalar_t<V> largest = 0;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t c = 0; c < channel_count<V>; ++c) {
      const scalar_t<V> magnitude = std::abs(channel(values[i], c));
      if (magnitude > largest) largest = magnitude;
    }
  return largest;
}

template <class Q>
inline constexpr std::size_t component_count = (MuellerType<Q> || ImportanceType<Q>) ? 16 : 4;

template <class Q>
constexpr void write_components(const Q& q, typename Q::value_type* out) {
  if constexpr (component_count<Q> == 16) {
    for (int i = 0; i < 16; ++i) out[i] = q(i / 4, i % 4);
  } else {
    for (std::size_t i = 0; i < 4; ++i) out[i] = q[i];
  }
}

}  // namespace detail

/// True when a and b differ in no component, expressed in the same frames, by more than `tolerance`
/// times the largest component of both. Never true where a component is NaN or infinite.
template <class A, class B>
  requires Summable<A, B>
constexpr bool is_close(const A& a, const B& b, typename A::scalar_type tolerance) {
  using V = typename A::value_type;
  using T = typename A::scalar_type;
  constexpr std::size_t n = detail::component_count<A>;
  V left[n], right[n], difference[n];
  detail::write_components(a, left);
  detail::write_components(b, right);
  // a + (−b) brings b into a's frames, or a into b's where a has none.
  detail::write_components(a + b * V(T(-1)), difference);
  // The operands, too: compilers with -ffast-math know infinity less infinity to be 0.
  for (std::size_t i = 0; i < n; ++i)
    if (!is_finite(left[i]) || !is_finite(right[i]) || !is_finite(difference[i])) return false;
  const T scale = std::max(detail::largest_magnitude(left, n), detail::largest_magnitude(right, n));
  return detail::largest_magnitude(difference, n) <= tolerance * scale;
}

/// Equality modulo frame. Exact where no rotation is needed; where one is, to a few roundings of
/// its arithmetic.
template <class A, class B>
  requires Summable<A, B>
constexpr bool operator==(const A& a, const B& b) {
  using T = typename A::scalar_type;
  return is_close(a, b, 16 * std::numeric_limits<T>::epsilon());
}

}  // namespace malus
