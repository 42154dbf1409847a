// SPDX-License-Identifier: MIT
// The arithmetic of forms: products, sums and rotations of arrays of values laid out as form.hpp
// says. Everything about which components exist is decided at compile time; no kernel knows a frame
// or a side.
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>

#include <malus/detail/wide_rows.hpp>
#include <malus/form.hpp>
#include <malus/frame.hpp>
#include <malus/spectrum.hpp>

namespace malus::detail {

/// A block whose exit frame was turned: rows 1 and 2 are full, rows 0 and 3 are as they were. Only
/// ever an intermediate.
struct TurnedBlock {};
inline constexpr TurnedBlock turned_block{};
constexpr int slot(TurnedBlock, int r, int c) {
  if (r == 0) return c < 2 ? c : -1;
  if (r == 3) return c < 2 ? -1 : 8 + c;
  return 2 + 4 * (r - 1) + c;
}

/// The first component that a form keeps in a place; others in the same place equal it.
template <auto Form, int R, int C>
constexpr bool is_first_in_slot() {
  const int place = slot(Form, R, C);
  for (int i = 0; i < 4 * R + C; ++i)
    if (slot(Form, i / 4, i % 4) == place) return false;
  return place >= 0;
}

/// Calls f.operator()<r, c>() for one component of every place that a form keeps.
template <auto Form, class F>
MALUS_INLINE constexpr void for_each_slot(F&& f) {
  [&]<int... I>(std::integer_sequence<int, I...>) MALUS_INLINE_LAMBDA {
    (
        [&]() MALUS_INLINE_LAMBDA {
          if constexpr (is_first_in_slot<Form, I / 4, I % 4>())
            f.template operator()<I / 4, I % 4>();
        }(),
        ...);
  }(std::make_integer_sequence<int, 16>{});
}

// products as lists of multiplications
// Which components
// meet is a table made by the compiler: one fold over it is far cheaper to compile than a recursion
// of templates. Sums are made in locals and stored at the end, since a store may change what is
// still to be read, for all that the compiler knows, and would have every operand read again.

/// out[to] = or += a[left]·b[right]; a negative `left` stands for zero.
struct Term {
  int to, left, right;
  bool first;
};
struct Terms {
  int count = 0;
  Term term[64] = {};
};

/// The multiplications of a product of `rows` times `columns` components, by the places of its
/// result and factors.
template <class Out, class A, class B>
consteval Terms list_terms(int rows, int columns, Out out, A a, B b) {
  Terms terms;
  bool done[16] = {};
  for (int r = 0; r < rows; ++r)
    for (int c = 0; c < columns; ++c) {
      const int to = out(r, c);
      if (to < 0 || done[to]) continue;
      done[to] = true;
      bool first = true;
      for (int k = 0; k < 4; ++k)
        if (a(r, k) >= 0 && b(k, c) >= 0) {
          terms.term[terms.count++] = {to, a(r, k), b(k, c), first};
          first = false;
        }
      if (first) terms.term[terms.count++] = {to, -1, -1, true};
    }
  return terms;
}

template <class V>
MALUS_INLINE constexpr void add_term(const Term& term, const V* a, const V* b, V* out) {
  if (term.left < 0)
    out[term.to] = V(0);
  else if (term.first)
    out[term.to] = a[term.left] * b[term.right];
  else
    out[term.to] = out[term.to] + a[term.left] * b[term.right];
}

/// to[i] = f(from[i]).
template <std::size_t Count, class F, class V>
MALUS_INLINE constexpr void map_values(F&& f, const V* from, V* to) {
  [&]<std::size_t... I>(std::index_sequence<I...>)
      MALUS_INLINE_LAMBDA { ((to[I] = f(from[I])), ...); }(std::make_index_sequence<Count>{});
}
template <std::size_t Count, class V>
MALUS_INLINE constexpr void copy_values(const V* from, V* to) {
  map_values<Count>([](const V& value) MALUS_INLINE_LAMBDA { return value; }, from, to);
}

template <const Terms& List, std::size_t Size, class V>
MALUS_INLINE constexpr void add_terms(const V* a, const V* b, V* out) {
  V sum[Size];
  [&]<std::size_t... I>(std::index_sequence<I...>) MALUS_INLINE_LAMBDA {
    (add_term(List.term[I], a, b, sum), ...);
  }(std::make_index_sequence<static_cast<std::size_t>(List.count)>{});
  copy_values<Size>(static_cast<const V*>(sum), out);
}

template <auto Out, auto A, auto B>
inline constexpr Terms product_terms = list_terms(
    4, 4, [](int r, int c) { return slot(Out, r, c); }, [](int r, int k) { return slot(A, r, k); },
    [](int k, int c) { return slot(B, k, c); });

template <auto M>
inline constexpr std::size_t layout_size = value_count(M);
template <>
inline constexpr std::size_t layout_size<turned_block> = 12;

/// Products that are worth being made by whole rows: full matrices of full ones, and of blocks.
template <class V, auto Out, auto A, auto B>
inline constexpr bool suits_rows =
    layout_size<Out> == 16 &&
    ((layout_size<A> == 16 && layout_size<B> == 16) ||
     (layout_size<A> >= 8 && layout_size<B> >= 8 && has_wide_sparse_rows<V>));

/// out = a·b, no frames to turn. Out is the form of the result; out overlaps neither factor.
template <auto Out, auto A, auto B, class V>
MALUS_INLINE constexpr void multiply(const V* a, const V* b, V* out) {
  if constexpr (suits_rows<V, Out, A, B> && has_wide_unturned_rows<V>)
    multiply_rows<A, B>(a, NoRotation{}, b, out);
  else
    add_terms<product_terms<Out, A, B>, layout_size<Out>>(a, b, out);
}

/// (s1, s2) = R·(a, 0) or R·(0, a): what is zero by form is not multiplied.
template <class V>
MALUS_INLINE constexpr void rotate_one(const Rotation<scalar_t<V>>& turn, bool first, const V& a,
                                       V& s1, V& s2) {
  s1 = (first ? turn.cos2 : turn.sin2) * a;
  s2 = (first ? -turn.sin2 : turn.cos2) * a;
}
template <class V>
MALUS_INLINE constexpr void rotate_one(NoRotation, bool first, const V& a, V& s1, V& s2) {
  s1 = first ? a : V(0);
  s2 = first ? V(0) : a;
}

/// Column C of out = R·m.
template <auto Out, auto M, int C, class Turn, class V>
MALUS_INLINE constexpr void turn_column(const Turn& turn, const V* m, V* out) {
  if constexpr (slot(Out, 0, C) >= 0) out[slot(Out, 0, C)] = m[slot(M, 0, C)];
  if constexpr (slot(Out, 3, C) >= 0) out[slot(Out, 3, C)] = m[slot(M, 3, C)];
  if constexpr (slot(M, 1, C) >= 0 && slot(M, 2, C) >= 0) {
    out[slot(Out, 1, C)] = m[slot(M, 1, C)];
    out[slot(Out, 2, C)] = m[slot(M, 2, C)];
    rotate(turn, out[slot(Out, 1, C)], out[slot(Out, 2, C)]);
  } else if constexpr (slot(Out, 1, C) >= 0) {
    constexpr bool first = slot(M, 1, C) >= 0;
    rotate_one(turn, first, m[slot(M, first ? 1 : 2, C)], out[slot(Out, 1, C)],
               out[slot(Out, 2, C)]);
  }
}

/// out = R·m: the exit frame of m turned. The values of m must be of a form with an exit frame.
template <auto Out, auto M, class Turn, class V>
MALUS_INLINE constexpr void turn_exit(const Turn& turn, const V* m, V* out) {
  turn_column<Out, M, 0>(turn, m, out);
  turn_column<Out, M, 1>(turn, m, out);
  turn_column<Out, M, 2>(turn, m, out);
  turn_column<Out, M, 3>(turn, m, out);
}

/// The form that a matrix of form M has once its exit frame has been turned.
template <MuellerForm M>
constexpr auto turned_form() {
  if constexpr (M == MuellerForm::block)
    return turned_block;
  else
    return M;
}
template <auto N>
constexpr bool is_one_row() {
  if constexpr (std::is_same_v<decltype(N), MuellerForm>)
    return N == MuellerForm::depolarizing_exit;
  else
    return false;
}

/// out = n·R·m, where R expresses m's exit frame in n's enter frame.
template <auto Out, auto N, MuellerForm M, class Turn, class V>
MALUS_INLINE constexpr void multiply_turned(const V* n, const Turn& turn, const V* m, V* out) {
  if constexpr (is_one_row<N>() && M != MuellerForm::depolarizing_enter) {
    // Turn the one row of n rather than the rows of m.
    V row[4] = {n[0], n[1], n[2], n[3]};
    rotate(turn.inverse(), row[1], row[2]);
    multiply<Out, N, M>(static_cast<const V*>(row), m, out);
  } else if constexpr (suits_rows<V, Out, N, M> && has_wide_rows<V>) {
    multiply_rows<N, M>(n, turn, m, out);
  } else {
    constexpr auto T = turned_form<M>();
    V turned[layout_size<T>];
    turn_exit<T, M>(turn, m, turned);
    multiply<Out, N, T>(n, static_cast<const V*>(turned), out);
  }
}

/// out = n·R·m for two blocks whose frames differ by quarter turns alone: R = diag(1, ±1, ±1, 1).
template <class V>
MALUS_INLINE constexpr void multiply_blocks(const V* n, scalar_t<V> sign, const V* m, V* out) {
  const V turned[8] = {m[0], m[1], sign * m[2], sign * m[3], sign * m[4], sign * m[5], m[6], m[7]};
  multiply<MuellerForm::block, MuellerForm::block, MuellerForm::block>(
      n, static_cast<const V*>(turned), out);
}

template <std::size_t Count, auto M, StokesForm S>
inline constexpr Terms apply_terms = list_terms(
    static_cast<int>(Count), 1, [](int r, int) { return r; },
    [](int r, int k) { return slot(M, r, k); }, [](int k, int) { return slot(S, k); });

/// out = m·s of `Count` components.
template <std::size_t Count, auto M, StokesForm S, class V>
MALUS_INLINE constexpr void apply(const V* m, const V* s, V* out) {
  add_terms<apply_terms<Count, M, S>, Count>(m, s, out);
}

/// out = m·R·s, where R expresses the Stokes vector's frame in m's enter frame.
template <std::size_t Count, auto M, StokesForm S, class Turn, class V>
MALUS_INLINE constexpr void apply_turned(const V* m, const Turn& turn, const V* s, V* out) {
  if constexpr (S == StokesForm::full) {
    V turned[4] = {s[0], s[1], s[2], s[3]};
    rotate(turn, turned[1], turned[2]);
    apply<Count, M, S>(m, static_cast<const V*>(turned), out);
  } else {
    apply<Count, M, S>(m, s, out);
  }
}

template <std::size_t Count, StokesForm W, MuellerForm M>
inline constexpr Terms row_terms = list_terms(
    1, static_cast<int>(Count), [](int, int c) { return c; }, [](int, int k) { return slot(W, k); },
    [](int k, int c) { return slot(M, k, c); });

/// out = the row w·m of `Count` components.
template <std::size_t Count, StokesForm W, MuellerForm M, class V>
MALUS_INLINE constexpr void apply_row(const V* w, const V* m, V* out) {
  add_terms<row_terms<Count, W, M>, Count>(w, m, out);
}

/// All 16 components by rows of a matrix of any form.
template <auto Form, class V>
MALUS_INLINE constexpr void expand(const V* m, V* rows) {
  [&]<int... I>(std::integer_sequence<int, I...>) MALUS_INLINE_LAMBDA {
    (
        [&]() MALUS_INLINE_LAMBDA {
          if constexpr (slot(Form, I / 4, I % 4) >= 0)
            rows[I] = m[slot(Form, I / 4, I % 4)];
          else
            rows[I] = V(0);
        }(),
        ...);
  }(std::make_integer_sequence<int, 16>{});
}

/// The values that a form keeps of 16 components by rows; what the form has as zero must be zero.
template <auto Form, class V>
MALUS_INLINE constexpr void compress(const V* rows, V* m) {
  for_each_slot<Form>([&]<int R, int C>()
                          MALUS_INLINE_LAMBDA { m[slot(Form, R, C)] = rows[4 * R + C]; });
}

}  // namespace malus::detail
