// SPDX-License-Identifier: MIT
// Quantities made of constants hold these constants. At -O3 -march=native g++ 12 with AVX-512 would
// otherwise broadcast the lower half of a constant whose upper half is zero.
#include <doctest/doctest.h>

#include <array>
#include <malus/malus.hpp>

using namespace malus;

namespace {

struct Bench;

/// A copy that the optimiser must make as a whole, from memory it knows to be constant.
template <class Q>
Q copied(const Q& q) {
  std::array<Q, 2> copies{q, q};
  volatile std::size_t second = 1;
  return copies[second];
}

template <class M>
void check_block(const M& m) {
  using V = typename M::value_type;
  using T = typename M::scalar_type;
  const M c = copied(m);
  for (int r = 0; r < 4; ++r)
    for (int k = 0; k < 4; ++k) {
      INFO("component ", r, " ", k);
      CHECK(c(r, k) == V(r < 2 && k < 2 ? T(0.5) : T(0)));
    }
}

}  // namespace

TEST_CASE_TEMPLATE("constants: an ideal polarizer has a lower block of zeros", V, float, double,
                   Rgb, Spectrum<double, 3>, Spectrum<float, 8>) {
  using T = scalar_t<V>;
  const StaticFrame<Bench> bench;
  check_block(linear_polarizer(V(T(1)), bench));
  check_block(linear_diattenuator(V(T(1)), V(T(0)), bench));
  check_block(linear_polarizer(V(T(1)), Frame<T>::about(glm::vec<3, T>(0, 0, 1))));
  // A turn by nothing goes through all of the values.
  const auto turned_by_nothing = linear_polarizer(V(T(1)), bench, T(0));
  for (int k = 0; k < 4; ++k) CHECK(turned_by_nothing(3, k) == V(T(0)));
}

TEST_CASE_TEMPLATE("constants: unpolarised light written in full has three zeros", V, float, double,
                   Rgb, Spectrum<double, 3>) {
  using T = scalar_t<V>;
  const auto frame = Frame<T>::about(glm::vec<3, T>(0, 0, 1));
  const auto light = copied(Stokes<V>(V(T(1)), V(T(0)), V(T(0)), V(T(0)), frame));
  const auto row = copied(Analyzer<V>(V(T(1)), V(T(0)), V(T(0)), V(T(0)), frame));
  const auto exit =
      copied(Mueller<V>::depolarizing_exit({V(T(1)), V(T(0)), V(T(0)), V(T(0))}, frame));
  const auto readings = copied(Measurement<V>(V(T(1)), V(T(0)), V(T(0)), V(T(0))));
  for (std::size_t i = 0; i < 4; ++i) {
    const V expected(T(i == 0 ? 1 : 0));
    CHECK(light[i] == expected);
    CHECK(row[i] == expected);
    CHECK(exit(0, static_cast<int>(i)) == expected);
    CHECK(readings[i] == expected);
  }
}
