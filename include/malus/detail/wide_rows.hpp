// SPDX-License-Identifier: MIT
// Products that are full matrices by whole rows: row r of a·b is Σₖ a(r, k) · (row k of b), where
// the processor's registers hold a whole row of RGB components, or a half, or one component. Three
// to four times as fast as component by component.
#pragma once

#include <cstddef>
#include <cstring>
#include <type_traits>
#include <utility>

#include <malus/form.hpp>
#include <malus/frame.hpp>
#include <malus/spectrum.hpp>

namespace malus::detail {

#if MALUS_SIMD && defined(__has_builtin)
#if __has_builtin(__builtin_shufflevector)
#define MALUS_HAS_WIDE_ROWS 1
#endif
#endif

#if defined(MALUS_HAS_WIDE_ROWS)

/// The widest registers that the compiler makes good use of.
#if defined(__AVX512F__)
inline constexpr std::size_t widest_register_bytes = 64;
#elif defined(__AVX__) && defined(__clang__)
inline constexpr std::size_t widest_register_bytes = 32;
#else
inline constexpr std::size_t widest_register_bytes = 16;
#endif

/// The widest registers that hold whole values, or of which several hold one whole value.
constexpr std::size_t register_bytes_for(std::size_t value_bytes) {
  std::size_t bytes = widest_register_bytes;
  while (bytes % value_bytes != 0 && value_bytes % bytes != 0) bytes /= 2;
  return bytes;
}
template <class V>
inline constexpr std::size_t register_bytes = register_bytes_for(sizeof(V));

template <class V>
inline constexpr bool has_wide_rows = !std::is_floating_point_v<V>;
/// Where no frame is turned on the way. g++ takes rows through memory if a register holds one
/// component, and needs three times as long as component by component.
#if defined(__clang__)
template <class V>
inline constexpr bool has_wide_unturned_rows = has_wide_rows<V>;
#else
template <class V>
inline constexpr bool has_wide_unturned_rows = has_wide_rows<V> && (register_bytes<V> > 16);
#endif

/// Whether it pays to fill rows with zeros, as blocks need: where a register holds several values.
template <class V>
inline constexpr bool has_wide_sparse_rows = has_wide_rows<V> && (register_bytes<V> > sizeof(V));

template <class V>
struct WideOf {
  using type [[gnu::vector_size(register_bytes<V>)]] = scalar_t<V>;
};

/// How values lie in registers: a register holds several values, or a value takes several
/// registers.
template <class V>
struct WideLayout {
  using scalar = scalar_t<V>;
  using Wide = typename WideOf<V>::type;
  static constexpr std::size_t lanes = register_bytes<V> / sizeof(scalar);
  static constexpr std::size_t value_lanes = sizeof(V) / sizeof(scalar);
  /// Values of a register, and registers of a value; the smaller of them is 1.
  static constexpr std::size_t values = value_lanes < lanes ? lanes / value_lanes : 1;
  static constexpr std::size_t registers = value_lanes < lanes ? 1 : value_lanes / lanes;
};

/// `Count` values in registers.
template <class V, std::size_t Count>
struct Wides {
  using Layout = WideLayout<V>;
  static constexpr std::size_t pieces = Count * Layout::registers / Layout::values;
  typename Layout::Wide piece[pieces];
};
template <class V>
using Row = Wides<V, 4>;

template <class V, std::size_t Count>
MALUS_INLINE void load_wides(const V* values, Wides<V, Count>& to) {
  for (std::size_t p = 0; p < to.pieces; ++p)
    std::memcpy(&to.piece[p], reinterpret_cast<const char*>(values) + p * register_bytes<V>,
                register_bytes<V>);
}
template <class V>
MALUS_INLINE void store_row(const Row<V>& row, V* values) {
  for (std::size_t p = 0; p < row.pieces; ++p)
    std::memcpy(reinterpret_cast<char*>(values) + p * register_bytes<V>, &row.piece[p],
                register_bytes<V>);
}

/// Lane I of piece P of row R of a matrix: a lane of the register that holds the row's values, or,
/// where the form has zero, one of the register of zeros beside it.
template <auto Form, int R, class Layout>
constexpr int lane_of_row(std::size_t piece, std::size_t lane) {
  const int place =
      slot(Form, R, static_cast<int>(piece * Layout::values + lane / Layout::value_lanes));
  if (place < 0) return static_cast<int>(Layout::lanes + lane);
  const auto within = static_cast<std::size_t>(place) % Layout::values;
  return static_cast<int>(within * Layout::value_lanes + lane % Layout::value_lanes);
}

/// The first component kept of those under piece P of row R, by its place; negative if none is.
template <auto Form, int R, class Layout>
constexpr int place_of_piece(std::size_t piece) {
  const std::size_t column = piece * Layout::values / Layout::registers;
  for (std::size_t c = column; c < column + Layout::values; ++c)
    if (slot(Form, R, static_cast<int>(c)) >= 0) return slot(Form, R, static_cast<int>(c));
  return -1;
}

template <auto Form, int R, std::size_t P, class V, std::size_t Count>
MALUS_INLINE void expand_piece(const Wides<V, Count>& stored, typename WideLayout<V>::Wide& to) {
  using Layout = WideLayout<V>;
  constexpr int place = place_of_piece<Form, R, Layout>(P);
  if constexpr (place < 0) {
    to = typename Layout::Wide{};
  } else if constexpr (Layout::values == 1) {
    to = stored.piece[static_cast<std::size_t>(place) * Layout::registers + P % Layout::registers];
  } else {
    const auto& piece = stored.piece[static_cast<std::size_t>(place) / Layout::values];
    [&]<std::size_t... I>(std::index_sequence<I...>) MALUS_INLINE_LAMBDA {
      to = __builtin_shufflevector(piece, typename Layout::Wide{},
                                   lane_of_row<Form, R, Layout>(P, I)...);
    }(std::make_index_sequence<Layout::lanes>{});
  }
}

/// Row R of a matrix of a form, with its zeros.
template <auto Form, int R, class V, std::size_t Count>
MALUS_INLINE void expand_row(const Wides<V, Count>& stored, Row<V>& row) {
  [&]<std::size_t... P>(std::index_sequence<P...>) MALUS_INLINE_LAMBDA {
    (expand_piece<Form, R, P>(stored, row.piece[P]), ...);
  }(std::make_index_sequence<Row<V>::pieces>{});
}

/// sum = or += (the value in a place of `factors`) · row.
template <std::size_t Place, bool First, class V, std::size_t Count>
MALUS_INLINE void add_row(const Wides<V, Count>& factors, const Row<V>& row, Row<V>& sum) {
  using Layout = WideLayout<V>;
  [&]<std::size_t... I>(std::index_sequence<I...>) MALUS_INLINE_LAMBDA {
    for (std::size_t p = 0; p < row.pieces; ++p) {
      typename Layout::Wide factor;
      if constexpr (Layout::values == 1)
        factor = factors.piece[Place * Layout::registers + p % Layout::registers];
      else
        factor = __builtin_shufflevector(
            factors.piece[Place / Layout::values], factors.piece[Place / Layout::values],
            static_cast<int>(Place % Layout::values * Layout::value_lanes +
                             I % Layout::value_lanes)...);
      if constexpr (First)
        sum.piece[p] = factor * row.piece[p];
      else
        sum.piece[p] += factor * row.piece[p];
    }
  }(std::make_index_sequence<Layout::lanes>{});
}

template <class V>
MALUS_INLINE void rotate_rows(NoRotation, Row<V>&, Row<V>&) {}
template <class V>
MALUS_INLINE void rotate_rows(const Rotation<scalar_t<V>>& turn, Row<V>& row1, Row<V>& row2) {
  for (std::size_t p = 0; p < row1.pieces; ++p) {
    const typename WideLayout<V>::Wide rotated =
        turn.cos2 * row1.piece[p] + turn.sin2 * row2.piece[p];
    row2.piece[p] = turn.cos2 * row2.piece[p] - turn.sin2 * row1.piece[p];
    row1.piece[p] = rotated;
  }
}

/// The first component of row r that a form keeps.
template <auto Form>
constexpr int first_in_row(int r) {
  int c = 0;
  while (slot(Form, r, c) < 0) ++c;
  return c;
}

/// Row R of a·b, of whose rows those that meet zeros of a's form are left out.
template <auto A, int R, class V>
MALUS_INLINE void sum_rows(const V* a, const Row<V> (&b)[4], Row<V>& sum) {
  // Forms keep the components of a row within one group of four.
  constexpr int group = slot(A, R, first_in_row<A>(R)) / 4 * 4;
  Row<V> factors;
  load_wides(a + group, factors);
  [&]<int... K>(std::integer_sequence<int, K...>) MALUS_INLINE_LAMBDA {
    (
        [&]() MALUS_INLINE_LAMBDA {
          constexpr int place = slot(A, R, K) - group;
          if constexpr (place >= 0)
            add_row<static_cast<std::size_t>(place), K == first_in_row<A>(R)>(factors, b[K], sum);
        }(),
        ...);
  }(std::make_integer_sequence<int, 4>{});
}

/// out = a·R·b, all 16 components of it, of blocks or full matrices; out overlaps neither.
template <auto A, auto B, class V, class Turn>
MALUS_INLINE void multiply_rows(const V* a, const Turn& turn, const V* b, V* out) {
  Wides<V, value_count(B)> stored;
  load_wides(b, stored);
  Row<V> row[4];
  [&]<int... R>(std::integer_sequence<int, R...>) MALUS_INLINE_LAMBDA {
    (expand_row<B, R>(stored, row[R]), ...);
    rotate_rows<V>(turn, row[1], row[2]);
    Row<V> sum[4];
    ((sum_rows<A, R>(a, row, sum[R]), store_row(sum[R], out + 4 * R)), ...);
  }(std::make_integer_sequence<int, 4>{});
}

#else

template <class V>
inline constexpr bool has_wide_rows = false;
template <class V>
inline constexpr bool has_wide_unturned_rows = false;
template <class V>
inline constexpr bool has_wide_sparse_rows = false;

template <auto A, auto B, class V, class Turn>
void multiply_rows(const V* a, const Turn& turn, const V* b, V* out);

#endif

}  // namespace malus::detail
