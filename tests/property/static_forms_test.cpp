// SPDX-License-Identifier: MIT
// Forms known at compile time: for every pair, products, sums and adjoints of static forms have the
// form of the table as their type, and the same components and frames as those of flagged ones.
#include <doctest/doctest.h>

#include <type_traits>
#include <utility>

#include "property/comparison.hpp"

using namespace test;
using malus::exitant;
using malus::incident;

namespace {

using V = double;

template <MuellerForm Form, class In, class Out>
using Static = malus::Mueller<V, In, Out, malus::Frame<V>, malus::Frame<V>, Form>;

/// The matrix again, of a static form.
template <MuellerForm Form, class In = incident, class Out = exitant>
Static<Form, In, Out> with_static_form(const Matrices<V>& m) {
  using M = Static<Form, In, Out>;
  const auto& v = m.m[0];
  using enum MuellerForm;
  if constexpr (Form == zero) return M();
  if constexpr (Form == plain) return M::plain(v[0][0]);
  if constexpr (Form == partial) return M::partial(v[0][0], v[1][1]);
  if constexpr (Form == depolarizing) return M::depolarizing(v[0][0]);
  if constexpr (Form == depolarizing_enter)
    return M::depolarizing_enter({v[0][0], v[1][0], v[2][0], v[3][0]}, m.exit);
  if constexpr (Form == depolarizing_exit) return M::depolarizing_exit(v[0].component, m.enter);
  if constexpr (Form == block)
    return M::block({v[0][0], v[0][1], v[1][0], v[1][1]}, {v[2][2], v[2][3], v[3][2], v[3][3]},
                    m.enter, m.exit);
  if constexpr (Form == full)
    return M::from_rows({v[0].component, v[1].component, v[2].component, v[3].component}, m.enter,
                        m.exit);
}

template <StokesForm Form>
auto light_of(const Vectors<V>& s) {
  using S = malus::Stokes<V, incident, malus::Frame<V>, Form>;
  if constexpr (Form == StokesForm::zero) return S();
  if constexpr (Form == StokesForm::unpolarized) return S::unpolarized(s.v[0][0]);
  if constexpr (Form == StokesForm::full)
    return S(s.v[0][0], s.v[0][1], s.v[0][2], s.v[0][3], s.frame);
}
template <StokesForm Form>
auto row_of(const Vectors<V>& w) {
  using W = malus::Analyzer<V, exitant, malus::Frame<V>, Form>;
  if constexpr (Form == StokesForm::zero) return W();
  if constexpr (Form == StokesForm::unpolarized) return W::intensity(w.v[0][0]);
  if constexpr (Form == StokesForm::full)
    return W(w.v[0][0], w.v[0][1], w.v[0][2], w.v[0][3], w.frame);
}
template <ImportanceForm Form>
auto importance_of(const Measurements<V>& w) {
  using W = malus::Importance<V, exitant, malus::Frame<V>, Form>;
  const auto& v = w.m[0];
  if constexpr (Form == ImportanceForm::zero) return W();
  if constexpr (Form == ImportanceForm::plain) return W::plain(v[0][0], w.frame);
  if constexpr (Form == ImportanceForm::depolarizing)
    return W::depolarizing({v[0][0], v[1][0], v[2][0], v[3][0]});
  if constexpr (Form == ImportanceForm::full)
    return W::from_rows({v[0].component, v[1].component, v[2].component, v[3].component}, w.frame);
}

template <auto& Forms, class F>
void for_each_form(F&& f) {
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    (f(std::integral_constant<std::remove_cvref_t<decltype(Forms[0])>, Forms[I]>{}), ...);
  }(std::make_index_sequence<Forms.size()>{});
}

/// All in one direction, so that any form may stand anywhere.
struct Drawn {
  reference::Axis d = *direction();
  malus::Frame<V> frames[5] = {draw_frame<V>(d), draw_frame<V>(d), draw_frame<V>(d),
                               draw_frame<V>(d), draw_frame<V>(d)};
  std::vector<double> a = *components(16), b = *components(16), s = *components(4);

  Matrices<V> left(MuellerForm f) const {
    return matrices<V>(f, a, frames[0], is_collinear(f) ? frames[0] : frames[1]);
  }
  Matrices<V> right(MuellerForm f) const {
    return matrices<V>(f, b, frames[2], is_collinear(f) ? frames[2] : frames[3]);
  }
};

template <MuellerForm FN, MuellerForm FM>
void check_pair(const Drawn& drawn) {
  const auto n = drawn.left(FN), m = drawn.right(FM);
  const auto ns = with_static_form<FN>(n);
  const auto ms = with_static_form<FM, incident, incident>(m);
  const std::string operands = name(FN) + " and " + name(FM);
  const auto turn = reference::rotation(to_axes(m.exit), to_axes(n.enter));

  const auto product = ns * ms;
  static_assert(product.static_form == malus::product_form(FN, FM, false));
  require_same("product of " + operands,
               difference(product, Matrices<V>{FN, {n.m[0] * turn * m.m[0]}, m.enter, n.exit}));

  const auto sum = ns + with_static_form<FM>(m);
  static_assert(sum.static_form == malus::sum_form(FN, FM, false));
  const auto enter = reference::rotation(to_axes(n.enter), to_axes(m.enter));
  const auto exit = reference::rotation(to_axes(m.exit), to_axes(n.exit));
  require_same("sum of " + operands,
               difference(sum, Matrices<V>{FN, {n.m[0] + exit * m.m[0] * enter}, n.enter, n.exit}));

  const auto with_flag = ns * m.quantity<incident, incident>();
  require_same("static and dynamic of " + operands,
               difference(with_flag, Matrices<V>{FN, {n.m[0] * turn * m.m[0]}, m.enter, n.exit}));
}

template <MuellerForm FM>
void check_one(const Drawn& drawn) {
  const auto m = drawn.left(FM);
  const auto ms = with_static_form<FM>(m);
  const malus::Mueller<V> widened = ms;
  require_same("widened " + name(FM), difference(widened, m));
  require_same(name(FM) + " expressed in other frames",
               difference(ms.expressed_in(drawn.frames[3], drawn.frames[4]), m));

  const auto adjoint_m = adjoint(ms);
  static_assert(adjoint_m.static_form == malus::adjoint_form(FM));
  require_same(
      "adjoint of " + name(FM),
      difference(adjoint_m, Matrices<V>{FM, {reference::transposed(m.m[0])}, m.exit, m.enter}));
  require_same("propagated " + name(FM), difference(propagate(ms), m));

  for_each_form<all_stokes_forms>([&](auto fs) {
    const auto s = vectors<V>(fs(), drawn.s, drawn.frames[4]);
    const auto light = ms * light_of<fs()>(s);
    static_assert(light.static_form == malus::product_form(FM, fs()));
    const auto into = reference::rotation(to_axes(s.frame), to_axes(m.enter));
    require_same(name(FM) + " * " + name(fs()),
                 difference(light, Vectors<V>{fs(), {m.m[0] * (into * s.v[0])}, m.exit}));

    const auto row = row_of<fs()>(s) * ms;
    static_assert(row.static_form == malus::row_product_form(fs(), FM));
    const auto onto = reference::rotation(to_axes(m.exit), to_axes(s.frame));
    require_same(
        name(fs()) + " row * " + name(FM),
        difference(row,
                   Vectors<V>{fs(), {reference::transposed(onto * m.m[0]) * s.v[0]}, m.enter}));
  });
  for_each_form<all_importance_forms>([&](auto fw) {
    const auto w = measurements<V>(fw(), drawn.b, drawn.frames[4]);
    const auto product = importance_of<fw()>(w) * ms;
    static_assert(product.static_form == malus::product_form(fw(), FM));
    const auto turn = reference::rotation(to_axes(m.exit), to_axes(w.frame));
    require_same(name(fw()) + " importance * " + name(FM),
                 difference(product, Measurements<V>{fw(), {w.m[0] * turn * m.m[0]}, m.enter}));
  });
}

template <ImportanceForm FW>
void check_importance(const Drawn& drawn) {
  const auto w = measurements<V>(FW, drawn.a, drawn.frames[0]);
  const auto ws = importance_of<FW>(w);
  require_same("importance expressed in another frame",
               difference(ws.expressed_in(drawn.frames[1]), w));
  for_each_form<all_importance_forms>([&](auto fv) {
    const auto v = measurements<V>(fv(), drawn.b, drawn.frames[2]);
    const auto sum = ws + importance_of<fv()>(v);
    static_assert(sum.static_form == malus::sum_form(FW, fv(), false));
    const auto turn = reference::rotation(to_axes(w.frame), to_axes(v.frame));
    require_same(name(FW) + " + " + name(fv()) + " importance",
                 difference(sum, Measurements<V>{FW, {w.m[0] + v.m[0] * turn}, w.frame}));
  });
}

}  // namespace

TEST_CASE(
    "every pair of static forms has the table's form as its type and the full computation's "
    "values") {
  CHECK(rc::check("Mueller matrices", [] {
    const Drawn drawn;
    for_each_form<all_mueller_forms>([&](auto fn) {
      for_each_form<all_mueller_forms>([&](auto fm) { check_pair<fn(), fm()>(drawn); });
    });
  }));
  CHECK(rc::check("a Mueller matrix and light, a row, importance", [] {
    const Drawn drawn;
    for_each_form<all_mueller_forms>([&](auto fm) { check_one<fm()>(drawn); });
  }));
  CHECK(rc::check("importances", [] {
    const Drawn drawn;
    for_each_form<all_importance_forms>([&](auto fw) { check_importance<fw()>(drawn); });
  }));
}
