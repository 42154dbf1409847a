// SPDX-License-Identifier: MIT
// The arithmetic of forms: products, sums and rotations of arrays of values laid out as form.hpp
// says. Everything about which components exist is decided at compile time; no kernel knows a frame
// or a side.
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>

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
  [&]<int... I>(std::integer_sequence<int, I...>) {
    (
        [&] {
          if constexpr (is_first_in_slot<Form, I / 4, I % 4>())
            f.template operator()<I / 4, I % 4>();
        }(),
        ...);
  }
  (std::make_integer_sequence<int, 16>{});
}

template <auto A, auto B, int R, int C>
constexpr bool has_terms_from(int k) {
  for (; k < 4; ++k)
    if (slot(A, R, k) >= 0 && slot(B, k, C) >= 0) return true;
  return false;
}

/// Component (R, C) of a·b: Σₖ a(R, k) b(k, C) over the k at which neither is zero by form.
template <auto A, auto B, int R, int C, int K = 0, class V>
MALUS_INLINE constexpr V product_entry(const V* a, const V* b) {
  constexpr bool here = slot(A, R, K) >= 0 && slot(B, K, C) >= 0;
  if constexpr (!here)
    return product_entry<A, B, R, C, K + 1>(a, b);
  else if constexpr (has_terms_from<A, B, R, C>(K + 1))
    return a[slot(A, R, K)] * b[slot(B, K, C)] + product_entry<A, B, R, C, K + 1>(a, b);
  else
    return a[slot(A, R, K)] * b[slot(B, K, C)];
}

/// out = a·b, no frames to turn. Out is the form of the result.
template <auto Out, auto A, auto B, class V>
MALUS_INLINE constexpr void multiply(const V* a, const V* b, V* out) {
  for_each_slot<Out>([&]<int R, int C>() {
    if constexpr (has_terms_from<A, B, R, C>(0))
      out[slot(Out, R, C)] = product_entry<A, B, R, C>(a, b);
    else
      out[slot(Out, R, C)] = V(0);
  });
}

/// out = R·m: the exit frame of m turned. The values of m must be of a form with an exit frame.
template <auto Out, auto M, class Turn, class V>
MALUS_INLINE constexpr void turn_exit(const Turn& turn, const V* m, V* out) {
  for_each_slot<Out>([&]<int R, int C>() {
    if constexpr (slot(M, R, C) >= 0)
      out[slot(Out, R, C)] = m[slot(M, R, C)];
    else
      out[slot(Out, R, C)] = V(0);
  });
  [&]<int... C>(std::integer_sequence<int, C...>) {
    (
        [&] {
          if constexpr (slot(Out, 1, C) >= 0)
            rotate(turn, out[slot(Out, 1, C)], out[slot(Out, 2, C)]);
        }(),
        ...);
  }
  (std::make_integer_sequence<int, 4>{});
}

/// m = m·R⁻¹ in place: the enter frame turned by R, for matrices of a form with whole rows.
template <MuellerForm M, class Turn, class V>
MALUS_INLINE constexpr void turn_enter(const Turn& turn, V* m) {
  static_assert(M == MuellerForm::full || M == MuellerForm::depolarizing_exit);
  constexpr int rows = M == MuellerForm::full ? 4 : 1;
  for (int r = 0; r < rows; ++r) rotate(turn, m[4 * r + 1], m[4 * r + 2]);
}

/// The form that a matrix of form M has once its exit frame has been turned.
template <MuellerForm M>
constexpr auto turned_form() {
  if constexpr (M == MuellerForm::block)
    return turned_block;
  else
    return M;
}
template <auto M>
inline constexpr std::size_t layout_size = value_count(M);
template <>
inline constexpr std::size_t layout_size<turned_block> = 12;

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

/// Component R of m·s.
template <auto M, StokesForm S, int R, int K = 0, class V>
MALUS_INLINE constexpr V apply_entry(const V* m, const V* s) {
  constexpr auto has = [](int k) { return slot(M, R, k) >= 0 && slot(S, k) >= 0; };
  constexpr bool later = (K < 1 && has(1)) || (K < 2 && has(2)) || (K < 3 && has(3));
  if constexpr (!has(K) && later)
    return apply_entry<M, S, R, K + 1>(m, s);
  else if constexpr (!has(K))
    return V(0);
  else if constexpr (later)
    return m[slot(M, R, K)] * s[slot(S, K)] + apply_entry<M, S, R, K + 1>(m, s);
  else
    return m[slot(M, R, K)] * s[slot(S, K)];
}

/// out = m·s of `Count` components.
template <std::size_t Count, auto M, StokesForm S, class V>
MALUS_INLINE constexpr void apply(const V* m, const V* s, V* out) {
  [&]<int... R>(std::integer_sequence<int, R...>) { ((out[R] = apply_entry<M, S, R>(m, s)), ...); }
  (std::make_integer_sequence<int, static_cast<int>(Count)>{});
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

/// Component C of the row w·m, of `Count` components.
template <std::size_t Count, StokesForm W, MuellerForm M, class V>
MALUS_INLINE constexpr void apply_row(const V* w, const V* m, V* out) {
  for (std::size_t c = 0; c < Count; ++c) out[c] = V(0);
  [&]<int... I>(std::integer_sequence<int, I...>) {
    (
        [&] {
          constexpr int k = I / 4, c = I % 4;
          if constexpr (slot(W, k) >= 0 && slot(M, k, c) >= 0 && c < static_cast<int>(Count))
            out[c] = out[c] + w[slot(W, k)] * m[slot(M, k, c)];
        }(),
        ...);
  }
  (std::make_integer_sequence<int, 16>{});
}

/// All 16 components by rows of a matrix of any form.
template <auto Form, class V>
MALUS_INLINE constexpr void expand(const V* m, V* rows) {
  [&]<int... I>(std::integer_sequence<int, I...>) {
    (
        [&] {
          if constexpr (slot(Form, I / 4, I % 4) >= 0)
            rows[I] = m[slot(Form, I / 4, I % 4)];
          else
            rows[I] = V(0);
        }(),
        ...);
  }
  (std::make_integer_sequence<int, 16>{});
}

/// The values that a form keeps of 16 components by rows; what the form has as zero must be zero.
template <auto Form, class V>
MALUS_INLINE constexpr void compress(const V* rows, V* m) {
  for_each_slot<Form>([&]<int R, int C>() { m[slot(Form, R, C)] = rows[4 * R + C]; });
}

}  // namespace malus::detail
