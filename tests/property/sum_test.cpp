// SPDX-License-Identifier: MIT
// Every pair of forms: sums of Mueller matrices, importances, light and rows against the full 4×4
// computation [M, Fi, Fo] + [N, Gi, Go] = [M + Fo Go⁻¹ N Gi Fi⁻¹, Fi, Fo] (paper, Appendix A).
#include <doctest/doctest.h>

#include "property/comparison.hpp"

using namespace test;

namespace {

/// A frame the same number of quarter turns from another, or anyhow about the same direction.
enum class Frames { anyhow, coincident, quarter_turn };

template <class T>
malus::Frame<T> beside(const malus::Frame<T>& frame, const reference::Axis& d, Frames how) {
  if (how == Frames::coincident) return frame;
  if (how == Frames::quarter_turn) return {frame.y(), -frame.x()};
  return draw_frame<T>(d);
}

template <class V>
void check_matrices(Frames how) {
  using T = malus::scalar_t<V>;
  const auto a_drawn = *components(16 * channels<V>), b_drawn = *components(16 * channels<V>);
  const auto d_enter = *direction(), d_exit = *direction();
  const auto a_enter = draw_frame<T>(d_enter), a_exit = draw_frame<T>(d_exit);
  const auto b_enter = beside(a_enter, d_enter, how), b_exit = beside(a_exit, d_exit, how);
  // The same again where all light goes on in one direction, as it must beside a collinear matrix.
  const auto a_exit_on = beside(a_enter, d_enter, how), b_exit_on = beside(a_enter, d_enter, how);
  for (const MuellerForm fa : all_mueller_forms)
    for (const MuellerForm fb : all_mueller_forms) {
      const bool on = is_collinear(fa) || is_collinear(fb);
      auto a = matrices<V>(fa, a_drawn, a_enter, on ? a_exit_on : a_exit);
      auto b = matrices<V>(fb, b_drawn, b_enter, on ? b_exit_on : b_exit);
      if (is_collinear(fa)) a.exit = a.enter;
      if (is_collinear(fb)) b.exit = b.enter;
      const std::string operands = name(fa) + " + " + name(fb);
      const auto sum = poisoned(a.quantity() + b.quantity());
      if (how != Frames::anyhow)
        require_form(operands, sum.form(), malus::sum_form(fa, fb, true));
      else if (sum.form() != malus::sum_form(fa, fb, true))
        require_form(operands, sum.form(), malus::sum_form(fa, fb, false));

      Matrices<V> expected{sum.form(), {}, a.enter, a.exit};
      const auto enter = reference::rotation(to_axes(a.enter), to_axes(b.enter));
      const auto exit = reference::rotation(to_axes(b.exit), to_axes(a.exit));
      for (std::size_t i = 0; i < channels<V>; ++i) expected.m[i] = a.m[i] + exit * b.m[i] * enter;
      require_same(operands, difference(sum, expected));
      require_same("the other way round, " + operands,
                   difference(b.quantity() + a.quantity(), expected));
      auto accumulated = a.quantity();
      accumulated += b.quantity();
      require_same("+= of " + operands, difference(accumulated, expected));
    }
}

template <class V>
void check_importances(Frames how) {
  using T = malus::scalar_t<V>;
  const auto a_drawn = *components(16 * channels<V>), b_drawn = *components(16 * channels<V>);
  const auto d = *direction();
  const auto a_frame = draw_frame<T>(d);
  const auto b_frame = beside(a_frame, d, how);
  for (const ImportanceForm fa : all_importance_forms)
    for (const ImportanceForm fb : all_importance_forms) {
      const auto a = measurements<V>(fa, a_drawn, a_frame),
                 b = measurements<V>(fb, b_drawn, b_frame);
      const std::string operands = name(fa) + " + " + name(fb) + " importance";
      const auto sum = poisoned(a.quantity() + b.quantity());
      if (how == Frames::coincident)
        require_form(operands, sum.form(), malus::sum_form(fa, fb, true));
      if (how == Frames::quarter_turn)
        require_form(operands, sum.form(), malus::sum_form(fa, fb, false));

      Measurements<V> expected{sum.form(), {}, a.frame};
      const auto turn = reference::rotation(to_axes(a.frame), to_axes(b.frame));
      for (std::size_t i = 0; i < channels<V>; ++i) expected.m[i] = a.m[i] + b.m[i] * turn;
      require_same(operands, difference(sum, expected));
      require_same("the other way round, " + operands,
                   difference(b.quantity() + a.quantity(), expected));
    }
}

template <class V>
void check_vectors() {
  using T = malus::scalar_t<V>;
  const auto a_drawn = *components(4 * channels<V>), b_drawn = *components(4 * channels<V>);
  const auto d = *direction();
  const auto a_frame = draw_frame<T>(d), b_frame = draw_frame<T>(d);
  for (const StokesForm fa : all_stokes_forms)
    for (const StokesForm fb : all_stokes_forms) {
      const auto a = vectors<V>(fa, a_drawn, a_frame), b = vectors<V>(fb, b_drawn, b_frame);
      const std::string operands = name(fa) + " + " + name(fb);
      const auto light = poisoned(a.light() + b.light());
      require_form(operands, light.form(), malus::sum_form(fa, fb));

      Vectors<V> expected{light.form(), {}, a.frame};
      const auto turn = reference::rotation(to_axes(b.frame), to_axes(a.frame));
      for (std::size_t i = 0; i < channels<V>; ++i) expected.v[i] = a.v[i] + turn * b.v[i];
      require_same("light " + operands, difference(light, expected));
      require_same("light, the other way round, " + operands,
                   difference(b.light() + a.light(), expected));
      require_same("rows " + operands, difference(a.analyzer() + b.analyzer(), expected));
    }
}

}  // namespace

#define MALUS_TEST_VALUES float, double, malus::Rgb, malus::Spectrum<double, 3>

TEST_CASE_TEMPLATE("Mueller + Mueller is the full 4x4 sum for every pair of forms and either order",
                   V, MALUS_TEST_VALUES) {
  CHECK(rc::check("frames anyhow", [] { check_matrices<V>(Frames::anyhow); }));
  CHECK(rc::check("frames coincident", [] { check_matrices<V>(Frames::coincident); }));
  CHECK(rc::check("frames a quarter turn apart", [] { check_matrices<V>(Frames::quarter_turn); }));
}
TEST_CASE_TEMPLATE(
    "Importance + Importance is the full sum for every pair of forms and either order", V,
    MALUS_TEST_VALUES) {
  CHECK(rc::check("frames anyhow", [] { check_importances<V>(Frames::anyhow); }));
  CHECK(rc::check("frames coincident", [] { check_importances<V>(Frames::coincident); }));
  CHECK(
      rc::check("frames a quarter turn apart", [] { check_importances<V>(Frames::quarter_turn); }));
}
TEST_CASE_TEMPLATE(
    "Stokes + Stokes and Analyzer + Analyzer are the full sum for every pair of forms", V,
    MALUS_TEST_VALUES) {
  CHECK(rc::check("frames anyhow", [] { check_vectors<V>(); }));
}
