// SPDX-License-Identifier: MIT
// Every pair of forms on the measuring side: Importance · Mueller, Importance · Stokes, Analyzer ·
// Mueller, Analyzer · Stokes and the inner product against the full 4×4 computation.
#include <doctest/doctest.h>

#include "property/comparison.hpp"

using namespace test;

namespace {

template <class V>
void check_importance_of_matrices() {
  using T = malus::scalar_t<V>;
  const auto w_drawn = *components(16 * channels<V>), m_drawn = *components(16 * channels<V>);
  const auto d = *direction();
  const auto w_frame = draw_frame<T>(d), m_exit = draw_frame<T>(d);
  const auto far_enter = draw_frame<T>(*direction());
  for (const ImportanceForm fw : all_importance_forms)
    for (const MuellerForm fm : all_mueller_forms) {
      const auto w = measurements<V>(fw, w_drawn, w_frame);
      const auto m = matrices<V>(fm, m_drawn, is_collinear(fm) ? m_exit : far_enter, m_exit);
      const std::string operands = name(fw) + " importance * " + name(fm);
      const auto product = propagate(w.quantity()) * m.quantity();
      require_form(operands, product.form(), malus::product_form(fw, fm));

      Measurements<V> expected{product.form(), {}, m.enter};
      const auto turn = reference::rotation(to_axes(m.exit), to_axes(w.frame));
      for (std::size_t i = 0; i < channels<V>; ++i) expected.m[i] = w.m[i] * turn * m.m[i];
      require_same(operands, difference(product, expected));
    }
}

template <class V>
void check_importance_of_light() {
  using T = malus::scalar_t<V>;
  const auto w_drawn = *components(16 * channels<V>), s_drawn = *components(4 * channels<V>);
  const auto d = *direction();
  const auto w_frame = draw_frame<T>(d), s_frame = draw_frame<T>(d);
  for (const ImportanceForm fw : all_importance_forms)
    for (const StokesForm fs : all_stokes_forms) {
      const auto w = measurements<V>(fw, w_drawn, w_frame);
      const auto s = vectors<V>(fs, s_drawn, s_frame);
      std::array<reference::Vector, channels<V>> expected;
      const auto turn = reference::rotation(to_axes(s.frame), to_axes(w.frame));
      for (std::size_t i = 0; i < channels<V>; ++i) expected[i] = w.m[i] * (turn * s.v[i]);
      require_same(name(fw) + " importance * " + name(fs),
                   difference(w.quantity() * s.light(), expected));
    }
}

template <class V>
void check_rows_of_matrices() {
  using T = malus::scalar_t<V>;
  const auto w_drawn = *components(4 * channels<V>), m_drawn = *components(16 * channels<V>);
  const auto d = *direction();
  const auto w_frame = draw_frame<T>(d), m_exit = draw_frame<T>(d);
  const auto far_enter = draw_frame<T>(*direction());
  for (const StokesForm fw : all_stokes_forms)
    for (const MuellerForm fm : all_mueller_forms) {
      const auto w = vectors<V>(fw, w_drawn, w_frame);
      const auto m = matrices<V>(fm, m_drawn, is_collinear(fm) ? m_exit : far_enter, m_exit);
      const std::string operands = name(fw) + " row * " + name(fm);
      const auto row = propagate(w.analyzer()) * m.quantity();
      require_form(operands, row.form(), malus::row_product_form(fw, fm));

      Vectors<V> expected{row.form(), {}, m.enter};
      const auto turn = reference::rotation(to_axes(m.exit), to_axes(w.frame));
      for (std::size_t i = 0; i < channels<V>; ++i)
        expected.v[i] = reference::transposed(turn * m.m[i]) * w.v[i];
      require_same(operands, difference(row, expected));
    }
}

template <class V>
void check_readings() {
  using T = malus::scalar_t<V>;
  const auto w_drawn = *components(4 * channels<V>), s_drawn = *components(4 * channels<V>);
  const auto d = *direction();
  const auto w_frame = draw_frame<T>(d), s_frame = draw_frame<T>(d);
  for (const StokesForm fw : all_stokes_forms)
    for (const StokesForm fs : all_stokes_forms) {
      const auto w = vectors<V>(fw, w_drawn, w_frame), s = vectors<V>(fs, s_drawn, s_frame);
      const auto turn = reference::rotation(to_axes(s.frame), to_axes(w.frame));
      std::array<double, channels<V>> expected;
      for (std::size_t i = 0; i < channels<V>; ++i)
        expected[i] = reference::dot(w.v[i], turn * s.v[i]);
      const std::string operands = name(fw) + " and " + name(fs);
      const V reading = w.analyzer() * s.light();
      require_same(operands, difference(reading, expected));
      const V inner = inner_product(w.light(), s.light());
      require_same("inner product of " + operands, difference(inner, expected));
    }
}

}  // namespace

#define MALUS_TEST_VALUES float, double, malus::Rgb, malus::Spectrum<double, 3>

TEST_CASE_TEMPLATE("Importance * Mueller is the full 4x4 product for every pair of forms", V,
                   MALUS_TEST_VALUES) {
  CHECK(rc::check("W M", [] { check_importance_of_matrices<V>(); }));
}
TEST_CASE_TEMPLATE("Importance * Stokes is the full product for every pair of forms", V,
                   MALUS_TEST_VALUES) {
  CHECK(rc::check("W S", [] { check_importance_of_light<V>(); }));
}
TEST_CASE_TEMPLATE("Analyzer * Mueller is the full product for every pair of forms", V,
                   MALUS_TEST_VALUES) {
  CHECK(rc::check("w M", [] { check_rows_of_matrices<V>(); }));
}
TEST_CASE_TEMPLATE(
    "Analyzer * Stokes and the inner product are the full ones for every pair of forms", V,
    MALUS_TEST_VALUES) {
  CHECK(rc::check("w S", [] { check_readings<V>(); }));
}
