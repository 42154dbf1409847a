// SPDX-License-Identifier: MIT
// Products of blocks and full matrices against sums over their 16 components, for values that fill
// a part of a register, one, and several: the kernels go by whole registers of the processor.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <malus/malus.hpp>

using namespace malus;

namespace {

using Rows = std::array<std::array<double, 4>, 4>;
struct Bench;

Rows operator*(const Rows& a, const Rows& b) {
  Rows product{};
  for (std::size_t r = 0; r < 4; ++r)
    for (std::size_t c = 0; c < 4; ++c)
      for (std::size_t k = 0; k < 4; ++k) product[r][c] += a[r][k] * b[k][c];
  return product;
}

/// A frame turned by `angle` sees (S1, S2) turned by twice the angle the other way.
Rows seen_from_turned_frame(double angle) {
  const double c = std::cos(2 * angle), s = std::sin(2 * angle);
  return {{{1, 0, 0, 0}, {0, c, s, 0}, {0, -s, c, 0}, {0, 0, 0, 1}}};
}

/// Different in every component and channel, none of them small.
template <class V>
V value(int seed) {
  V v(scalar_t<V>(0));
  for (std::size_t i = 0; i < channel_count<V>; ++i)
    set_channel(v, i, static_cast<scalar_t<V>>(1.5 + std::sin(7.3 * seed + 1.1 * double(i))));
  return v;
}

template <class M>
M block(int seed, const typename M::enter_frame_type& enter,
        const typename M::exit_frame_type& exit) {
  using V = typename M::value_type;
  const auto at = [&](int i) { return value<V>(seed + i); };
  return M::block({at(0), at(1), at(2), at(3)}, {at(4), at(5), at(6), at(7)}, enter, exit);
}
template <class M>
M full(int seed, const typename M::enter_frame_type& enter,
       const typename M::exit_frame_type& exit) {
  typename M::rows_type rows;
  for (std::size_t i = 0; i < 16; ++i)
    rows[i / 4][i % 4] = value<typename M::value_type>(seed + static_cast<int>(i));
  return M::from_rows(rows, enter, exit);
}

template <class Q>
Rows rows_of(const Q& q, std::size_t i) {
  Rows rows;
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c)
      rows[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)] =
          static_cast<double>(channel(q(r, c), i));
  return rows;
}

void check_close(const Rows& got, const Rows& expected, double tolerance) {
  for (std::size_t r = 0; r < 4; ++r)
    for (std::size_t c = 0; c < 4; ++c) {
      INFO("component ", r, " ", c);
      CHECK(std::abs(got[r][c] - expected[r][c]) <= tolerance);
    }
}

/// n·m is N·R·M in every channel, to the rounding of four products and a turn of values below 3.
template <class N, class M>
void check_product(const N& n, const M& m, const Rows& turn) {
  using V = typename N::value_type;
  const auto product = n * m;
  const double tolerance = 100 * static_cast<double>(std::numeric_limits<scalar_t<V>>::epsilon());
  for (std::size_t i = 0; i < channel_count<V>; ++i) {
    INFO("channel ", i);
    check_close(rows_of(product, i), rows_of(n, i) * turn * rows_of(m, i), tolerance);
  }
}

template <class V, class Left, class Right, class F>
void check_pairs(const Left& enter, const Right& exit, const Rows& turn, F frame) {
  using Type = std::remove_cvref_t<decltype(frame)>;
  using Block = Mueller<V, incident, incident, Type, Type, MuellerForm::block>;
  using Full = Mueller<V, incident, incident, Type, Type, MuellerForm::full>;
  const auto block_n = block<Block>(1, enter, frame), block_m = block<Block>(30, frame, exit);
  const auto full_n = full<Full>(60, enter, frame), full_m = full<Full>(90, frame, exit);
  check_product(full_n, full_m, turn);
  check_product(full_n, block_m, turn);
  check_product(block_n, full_m, turn);
  check_product(block_n, block_m, turn);

  typename Full::rows_type rows;
  for (std::size_t i = 0; i < 16; ++i) rows[i / 4][i % 4] = value<V>(120 + static_cast<int>(i));
  const auto measured = Importance<V, incident, Type, ImportanceForm::full>::from_rows(rows, enter);
  check_product(measured, full_m, turn);
  check_product(measured, block_m, turn);
}

}  // namespace

TEST_CASE_TEMPLATE("products of blocks and full matrices are sums over components", V,
                   Spectrum<double, 1>, Rgb, Spectrum<float, 5>, Spectrum<float, 12>,
                   Spectrum<float, 16>, Spectrum<double, 3>) {
  const StaticFrame<Bench> bench;
  check_pairs<V>(bench, bench, seen_from_turned_frame(0), bench);

  using T = scalar_t<V>;
  const auto frame = Frame<T>::about(glm::normalize(glm::vec<3, T>(1, 2, -3)));
  for (const double angle : {0.0, 0.4, 2.1})
    check_pairs<V>(frame.turned(static_cast<T>(angle)), frame, seen_from_turned_frame(angle),
                   frame);
}
