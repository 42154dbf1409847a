// SPDX-License-Identifier: MIT
// The channels of a spectrum do not meet: any operation on 4, 8 or 16 channels is the scalar one,
// channel by channel.
#include <doctest/doctest.h>

#include "property/comparison.hpp"

using namespace test;

namespace {

/// Channel i of drawn operands, as scalar ones.
template <class V>
Matrices<malus::scalar_t<V>> channel_of(const Matrices<V>& m, std::size_t i) {
  return {m.form, {m.m[i]}, m.enter, m.exit};
}
template <class V>
Vectors<malus::scalar_t<V>> channel_of(const Vectors<V>& s, std::size_t i) {
  return {s.form, {s.v[i]}, s.frame};
}

template <class V>
void check_channels() {
  using T = malus::scalar_t<V>;
  const auto form = [] { return *rc::gen::elementOf(all_mueller_forms); };
  const auto d = *direction();
  const auto enter = draw_frame<T>(d), exit = draw_frame<T>(d);
  const auto n = matrices<V>(form(), *components(16 * channels<V>), enter, enter);
  auto m = matrices<V>(form(), *components(16 * channels<V>), exit, exit);
  const auto s = vectors<V>(*rc::gen::elementOf(all_stokes_forms), *components(4 * channels<V>),
                            draw_frame<T>(d));
  const auto product = n.quantity() * propagate(m.quantity());
  const auto sum = n.quantity() + m.quantity();
  const auto light = product * s.light();
  const V reading = s.analyzer() * propagate(light);
  for (std::size_t i = 0; i < channels<V>; ++i) {
    const auto n1 = channel_of(n, i), m1 = channel_of(m, i);
    const auto s1 = channel_of(s, i);
    const auto product1 = n1.quantity() * propagate(m1.quantity());
    const auto sum1 = n1.quantity() + m1.quantity();
    const auto light1 = product1 * s1.light();
    const std::string operands = name(n.form) + ", " + name(m.form) + ", " + name(s.form);
    for (int r = 0; r < 4; ++r) {
      for (int c = 0; c < 4; ++c) {
        require_same("product of " + operands,
                     difference<T>("", static_cast<double>(product(r, c)[i]),
                                   static_cast<double>(product1(r, c))));
        require_same("sum of " + operands, difference<T>("", static_cast<double>(sum(r, c)[i]),
                                                         static_cast<double>(sum1(r, c))));
      }
      const auto k = static_cast<std::size_t>(r);
      require_same("light of " + operands, difference<T>("", static_cast<double>(light[k][i]),
                                                         static_cast<double>(light1[k])));
    }
    require_same("reading of " + operands,
                 difference<T>("", static_cast<double>(reading[i]),
                               static_cast<double>(s1.analyzer() * propagate(light1))));
  }
}

}  // namespace

TEST_CASE("4, 8 and 16 channels are as many scalar computations") {
  CHECK(rc::check("4 floats", [] { check_channels<malus::Spectrum<float, 4>>(); }));
  CHECK(rc::check("8 doubles", [] { check_channels<malus::Spectrum<double, 8>>(); }));
  CHECK(rc::check("16 floats", [] { check_channels<malus::Spectrum<float, 16>>(); }));
  CHECK(
      rc::check("one double in a spectrum", [] { check_channels<malus::Spectrum<double, 1>>(); }));
}
