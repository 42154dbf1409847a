// SPDX-License-Identifier: MIT
// Every pair of forms: Mueller · Mueller and Mueller · Stokes against the full 4×4 computation.
#include <doctest/doctest.h>

#include "property/comparison.hpp"

using namespace test;

namespace {

/// N and M of any forms, M's exit and N's enter frame about one direction and `between` apart.
template <class V>
struct Pair {
  using T = malus::scalar_t<V>;
  std::vector<double> n_drawn = *components(16 * channels<V>),
                      m_drawn = *components(16 * channels<V>);
  reference::Axis meeting = *direction();
  double at_exit = *angle();
  malus::Frame<T> far_enter = draw_frame<T>(*direction()), far_exit = draw_frame<T>(*direction());

  void check_all(double between, bool quarter_turns) const {
    const auto m_exit = to_frame<T>(axes_about(meeting, at_exit));
    // Quarter turns are made by exchanging axes, so that they are exact.
    auto n_enter = to_frame<T>(axes_about(meeting, at_exit + between));
    if (quarter_turns) {
      n_enter = m_exit;
      for (double turned = 0; turned < between - 0.1; turned += std::numbers::pi / 2)
        n_enter = {n_enter.y(), -n_enter.x()};
    }
    for (const MuellerForm fn : all_mueller_forms)
      for (const MuellerForm fm : all_mueller_forms) {
        const auto n = matrices<V>(fn, n_drawn, n_enter, is_collinear(fn) ? n_enter : far_exit);
        const auto m = matrices<V>(fm, m_drawn, is_collinear(fm) ? m_exit : far_enter, m_exit);
        const std::string operands = name(fn) + " * " + name(fm);
        const auto product = n.quantity() * propagate(m.quantity());
        const bool to_block = fn == MuellerForm::block && fm == MuellerForm::block;
        if (!to_block || quarter_turns || std::abs(std::sin(2 * between)) > 0.01)
          require_form(operands, product.form(), product_form(fn, fm, quarter_turns));

        Matrices<V> expected{product.form(), {}, m.enter, n.exit};
        const auto turn = reference::rotation(to_axes(m.exit), to_axes(n.enter));
        for (std::size_t i = 0; i < channels<V>; ++i) expected.m[i] = n.m[i] * turn * m.m[i];
        require_same(operands, difference(product, expected));
      }
  }
};

template <class V>
void check_light() {
  using T = malus::scalar_t<V>;
  const auto m_drawn = *components(16 * channels<V>), s_drawn = *components(4 * channels<V>);
  const auto d = *direction();
  const auto m_enter = draw_frame<T>(d), s_frame = draw_frame<T>(d);
  const auto far_exit = draw_frame<T>(*direction());
  for (const MuellerForm fm : all_mueller_forms)
    for (const StokesForm fs : all_stokes_forms) {
      const auto m = matrices<V>(fm, m_drawn, m_enter, is_collinear(fm) ? m_enter : far_exit);
      const auto s = vectors<V>(fs, s_drawn, s_frame);
      const std::string operands = name(fm) + " * " + name(fs);
      const auto light = m.quantity() * s.light();
      require_form(operands, light.form(), malus::product_form(fm, fs));

      Vectors<V> expected{light.form(), {}, m.exit};
      const auto turn = reference::rotation(to_axes(s.frame), to_axes(m.enter));
      for (std::size_t i = 0; i < channels<V>; ++i) expected.v[i] = m.m[i] * (turn * s.v[i]);
      require_same(operands, difference(light, expected));
    }
}

}  // namespace

#define MALUS_TEST_VALUES float, double, malus::Rgb, malus::Spectrum<double, 3>

TEST_CASE_TEMPLATE("Mueller * Mueller is the full 4x4 product for every pair of forms", V,
                   MALUS_TEST_VALUES) {
  CHECK(rc::check("frames anyhow", [] { Pair<V>().check_all(*angle(), false); }));
  CHECK(rc::check("coincident frames: blocks stay blocks", [] { Pair<V>().check_all(0, true); }));
  CHECK(rc::check("frames whole quarter turns apart: blocks stay blocks", [] {
    Pair<V>().check_all(*rc::gen::inRange(1, 4) * std::numbers::pi / 2, true);
  }));
}

TEST_CASE_TEMPLATE("Mueller * Stokes is the full product for every pair of forms", V,
                   MALUS_TEST_VALUES) {
  CHECK(rc::check("frames anyhow", [] { check_light<V>(); }));
}
