// SPDX-License-Identifier: MIT
// The product of two full matrices by whole rows: row r of a·b is Σₖ a(r, k) · (row k of b), where
// the processor's registers hold a whole row of RGB components, or a half, or one component. Three
// to four times as fast as component by component.
#pragma once

#include <cstddef>
#include <cstring>
#include <type_traits>
#include <utility>

#include <malus/frame.hpp>
#include <malus/spectrum.hpp>

namespace malus::detail {

#if MALUS_SIMD && defined(__has_builtin)
#if __has_builtin(__builtin_shufflevector)
#define MALUS_HAS_WIDE_ROWS 1
#endif
#endif

#if defined(MALUS_HAS_WIDE_ROWS)

#if defined(__AVX512F__)
inline constexpr std::size_t register_bytes = 64;
#elif defined(__AVX__) && defined(__clang__)
inline constexpr std::size_t register_bytes = 32;
#else
inline constexpr std::size_t register_bytes = 16;
#endif

template <class V>
inline constexpr bool has_wide_rows = !std::is_floating_point_v<V>;
/// Where no frame is turned on the way. g++ takes rows through memory if a register holds one
/// component, and needs three times as long as component by component.
#if defined(__clang__)
template <class V>
inline constexpr bool has_wide_unturned_rows = has_wide_rows<V>;
#else
template <class V>
inline constexpr bool has_wide_unturned_rows = has_wide_rows<V> && (register_bytes > 16);
#endif

template <class T>
struct WideOf {
  using type [[gnu::vector_size(register_bytes)]] = T;
};

/// Where the pieces of a row of four values V lie: a register holds several values, or a value
/// takes several registers.
template <class V>
struct RowLayout {
  using scalar = scalar_t<V>;
  using Wide = typename WideOf<scalar>::type;
  static constexpr std::size_t lanes = register_bytes / sizeof(scalar);
  static constexpr std::size_t value_lanes = sizeof(V) / sizeof(scalar);
  static constexpr std::size_t pieces = 4 * value_lanes / lanes;
  struct Row {
    Wide piece[pieces];
  };
};

template <class V>
MALUS_INLINE void load_row(const V* values, typename RowLayout<V>::Row& row) {
  for (std::size_t p = 0; p < RowLayout<V>::pieces; ++p)
    std::memcpy(&row.piece[p], reinterpret_cast<const char*>(values) + p * register_bytes,
                register_bytes);
}
template <class V>
MALUS_INLINE void store_row(const typename RowLayout<V>::Row& row, V* values) {
  for (std::size_t p = 0; p < RowLayout<V>::pieces; ++p)
    std::memcpy(reinterpret_cast<char*>(values) + p * register_bytes, &row.piece[p],
                register_bytes);
}

/// sum = or += (component K of `factors`) · row.
template <class V, std::size_t K>
MALUS_INLINE void add_row(const typename RowLayout<V>::Row& factors,
                          const typename RowLayout<V>::Row& row, typename RowLayout<V>::Row& sum) {
  using Layout = RowLayout<V>;
  constexpr std::size_t lanes = Layout::lanes, value_lanes = Layout::value_lanes;
  constexpr std::size_t start = K * value_lanes;
  [&]<std::size_t... I>(std::index_sequence<I...>) MALUS_INLINE_LAMBDA {
    for (std::size_t p = 0; p < Layout::pieces; ++p) {
      // The piece of the component that lies over piece p of the row.
      const auto& piece =
          factors.piece[value_lanes > lanes ? start / lanes + p % (value_lanes / lanes)
                                            : start / lanes];
      if constexpr (value_lanes >= lanes) {
        if constexpr (K == 0)
          sum.piece[p] = piece * row.piece[p];
        else
          sum.piece[p] += piece * row.piece[p];
      } else {
        const typename Layout::Wide factor = __builtin_shufflevector(
            piece, piece, static_cast<int>(start % lanes + I % value_lanes)...);
        if constexpr (K == 0)
          sum.piece[p] = factor * row.piece[p];
        else
          sum.piece[p] += factor * row.piece[p];
      }
    }
  }(std::make_index_sequence<lanes>{});
}

template <class V>
MALUS_INLINE void rotate_rows(NoRotation, typename RowLayout<V>::Row&,
                              typename RowLayout<V>::Row&) {}
template <class V>
MALUS_INLINE void rotate_rows(const Rotation<scalar_t<V>>& turn, typename RowLayout<V>::Row& row1,
                              typename RowLayout<V>::Row& row2) {
  for (std::size_t p = 0; p < RowLayout<V>::pieces; ++p) {
    const typename RowLayout<V>::Wide rotated =
        turn.cos2 * row1.piece[p] + turn.sin2 * row2.piece[p];
    row2.piece[p] = turn.cos2 * row2.piece[p] - turn.sin2 * row1.piece[p];
    row1.piece[p] = rotated;
  }
}

/// out = a·R·b of full matrices; out overlaps neither.
template <class V, class Turn>
MALUS_INLINE void multiply_full(const V* a, const Turn& turn, const V* b, V* out) {
  using Row = typename RowLayout<V>::Row;
  Row row[4];
  for (std::size_t k = 0; k < 4; ++k) load_row(b + 4 * k, row[k]);
  rotate_rows<V>(turn, row[1], row[2]);
  for (std::size_t r = 0; r < 4; ++r) {
    Row factors, sum;
    load_row(a + 4 * r, factors);
    add_row<V, 0>(factors, row[0], sum);
    add_row<V, 1>(factors, row[1], sum);
    add_row<V, 2>(factors, row[2], sum);
    add_row<V, 3>(factors, row[3], sum);
    store_row(sum, out + 4 * r);
  }
}

#else

template <class V>
inline constexpr bool has_wide_rows = false;
template <class V>
inline constexpr bool has_wide_unturned_rows = false;

template <class V, class Turn>
void multiply_full(const V* a, const Turn& turn, const V* b, V* out);

#endif

}  // namespace malus::detail
