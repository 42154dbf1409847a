// SPDX-License-Identifier: MIT
// The laws of the algebra (paper, section 4 and Appendix A), each between two computations by the
// library: associativity, distributivity, frame invariance, adjointness, propagation.
#include <doctest/doctest.h>

#include "property/comparison.hpp"

using namespace test;
using malus::exitant;
using malus::incident;

namespace {

MuellerForm draw_form() { return *rc::gen::elementOf(all_mueller_forms); }

/// Three matrices in a row, C·B·A, of any forms; frames on the two sides of a meeting point lie
/// anyhow.
template <class V>
struct Chain {
  using T = malus::scalar_t<V>;
  MuellerForm forms[3] = {draw_form(), draw_form(), draw_form()};
  reference::Axis directions[4] = {*direction(), *direction(), *direction(), *direction()};
  Matrices<V> a, b, c;
  Vectors<V> light, row;
  Measurements<V> importance;

  Chain() : a(), b(), c(), light(), row(), importance() {
    for (std::size_t i = 3; i > 0; --i)
      if (is_collinear(forms[i - 1])) directions[i - 1] = directions[i];
    a = matrix(0);
    b = matrix(1);
    c = matrix(2);
    light = vectors<V>(*rc::gen::elementOf(all_stokes_forms), *components(4 * channels<V>),
                       draw_frame<T>(directions[0]));
    row = vectors<V>(*rc::gen::elementOf(all_stokes_forms), *components(4 * channels<V>),
                     draw_frame<T>(directions[3]));
    importance = measurements<V>(*rc::gen::elementOf(all_importance_forms),
                                 *components(16 * channels<V>), draw_frame<T>(directions[3]));
  }

  /// Another matrix in the place of the i-th.
  Matrices<V> matrix(std::size_t i, MuellerForm form) const {
    const auto enter = draw_frame<T>(directions[i]);
    const auto exit = is_collinear(form) ? enter : draw_frame<T>(directions[i + 1]);
    return matrices<V>(form, *components(16 * channels<V>), enter, exit);
  }
  Matrices<V> matrix(std::size_t i) const { return matrix(i, forms[i]); }
  /// Another one of any form that may stand there.
  Matrices<V> other(std::size_t i) const {
    const auto form = draw_form();
    return matrix(i, is_collinear(form) ? forms[i] : form);
  }
};

// What the library's quantities say, for comparison modulo frames with others that the library
// makes.
template <class M>
auto told(const M& m, const Matrices<typename M::value_type>& by_default)
  requires malus::MuellerType<M>
{
  auto result = by_default;
  result.form = m.form();
  if (needs_enter_frame(m.form())) result.enter = m.enter();
  if (needs_exit_frame(m.form())) result.exit = m.exit();
  if (is_collinear(m.form())) result.exit = result.enter;
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c)
      for (std::size_t i = 0; i < channels<typename M::value_type>; ++i)
        result.m[i][static_cast<std::size_t>(r)][static_cast<std::size_t>(c)] =
            static_cast<double>(malus::channel(m(r, c), i));
  return result;
}
template <class W>
auto told(const W& w, const malus::Frame<typename W::scalar_type>& by_default)
  requires malus::ImportanceType<W>
{
  Measurements<typename W::value_type> result{w.form(), {}, by_default};
  if (needs_frame(w.form())) result.frame = w.frame();
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c)
      for (std::size_t i = 0; i < channels<typename W::value_type>; ++i)
        result.m[i][static_cast<std::size_t>(r)][static_cast<std::size_t>(c)] =
            static_cast<double>(malus::channel(w(r, c), i));
  return result;
}
template <class S>
auto told(const S& s, const malus::Frame<typename S::scalar_type>& by_default)
  requires(malus::StokesType<S> || malus::AnalyzerType<S>)
{
  Vectors<typename S::value_type> result{s.form(), {}, by_default};
  if (needs_frame(s.form())) result.frame = s.frame();
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t i = 0; i < channels<typename S::value_type>; ++i)
      result.v[i][k] = static_cast<double>(malus::channel(s[k], i));
  return result;
}
template <class V>
std::array<reference::Vector, channels<V>> told(const malus::Measurement<V>& readings) {
  std::array<reference::Vector, channels<V>> result;
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t i = 0; i < channels<V>; ++i)
      result[i][k] = static_cast<double>(malus::channel(readings[k], i));
  return result;
}
template <malus::SpectralValue V>
std::array<double, channels<V>> told(const V& value) {
  std::array<double, channels<V>> result{};
  for (std::size_t i = 0; i < channels<V>; ++i)
    result[i] = static_cast<double>(malus::channel(value, i));
  return result;
}

template <class V>
std::string names(const Chain<V>& x) {
  return name(x.c.form) + ", " + name(x.b.form) + ", " + name(x.a.form) + ", light " +
         name(x.light.form) + ", row " + name(x.row.form) + ", importance " +
         name(x.importance.form);
}

template <class V>
void check_associativity() {
  const Chain<V> x;
  const auto a = propagate(x.a.quantity()), b = propagate(x.b.quantity());
  const auto c = x.c.quantity();
  const auto s = x.light.light();
  const auto w = propagate(x.row.analyzer());
  const auto many = propagate(x.importance.quantity());
  const auto far = [&] {
    auto m = x.a;
    m.exit = x.c.exit;
    if (is_collinear(x.c.form)) m.exit = x.c.enter;
    return m;
  }();
  require_same("(C B) A = C (B A): " + names(x), difference((c * b) * a, told(c * (b * a), far)));
  require_same("(C B) s = C (B s): " + names(x),
               difference((b * a) * s, told(b * (a * s), x.b.exit)));
  require_same("(W C) B = W (C B): " + names(x),
               difference((many * c) * b, told(many * (c * b), x.b.enter)));
  require_same("(w C) B = w (C B): " + names(x),
               difference((w * c) * b, told(w * (c * b), x.b.enter)));
  const auto tail = c * b * a;
  require_same("(W M) s = W (M s): " + names(x),
               difference((many * tail) * s, told(many * (tail * s))));
  require_same("(w M) s = w (M s): " + names(x),
               difference(V((w * tail) * s), told(V(w * (tail * s)))));
}

template <class V>
void check_distributivity() {
  const Chain<V> x;
  const auto b = x.b.quantity();
  const auto s = propagate(x.a.quantity() * x.light.light());
  const auto a = propagate(x.a.quantity()), a2 = propagate(x.other(0).quantity());
  const auto b2 = x.other(1).quantity();
  const auto far = [&] {
    auto m = x.a;
    m.exit = is_collinear(x.b.form) ? x.b.enter : x.b.exit;
    return m;
  }();
  require_same("B (A + A') = B A + B A': " + names(x),
               difference(b * (a + a2), told(b * a + b * a2, far)));
  require_same("(B + B') A = B A + B' A: " + names(x),
               difference((b + b2) * a, told(b * a + b2 * a, far)));
  require_same("(B + B') s = B s + B' s: " + names(x),
               difference((b + b2) * s, told(b * s + b2 * s, x.b.exit)));
  const auto w = propagate(x.row.analyzer());
  const auto many = propagate(x.importance.quantity());
  const auto c = x.c.quantity(), c2 = x.other(2).quantity();
  require_same("w (C + C') = w C + w C': " + names(x),
               difference(w * (c + c2), told(w * c + w * c2, x.c.enter)));
  require_same("W (C + C') = W C + W C': " + names(x),
               difference(many * (c + c2), told(many * c + many * c2, x.c.enter)));
  require_same("(W + W) C = W C + W C: " + names(x),
               difference((many + many) * c, told(many * c + many * c, x.c.enter)));
}

template <class V>
void check_adjointness() {
  const Chain<V> x;
  const auto m = x.c.quantity();
  const auto s = vectors<V>(*rc::gen::elementOf(all_stokes_forms), *components(4 * channels<V>),
                            draw_frame<malus::scalar_t<V>>(x.directions[2]))
                     .light();
  const auto w = x.row.template light<exitant>();
  require_same("<w, M s> = <M^T w, s>: " + names(x),
               difference(V(inner_product(w, m * s)), told(V(inner_product(adjoint(m) * w, s)))));
  require_same("the adjoint's adjoint: " + names(x), difference(adjoint(adjoint(m)), x.c));
  require_form("adjoint of " + name(x.c.form), adjoint(m).form(), malus::adjoint_form(x.c.form));

  auto transposed = x.c;
  std::swap(transposed.enter, transposed.exit);
  for (auto& matrix : transposed.m) matrix = reference::transposed(matrix);
  require_same("the adjoint is the transpose with frames exchanged: " + names(x),
               difference(poisoned(adjoint(m)), transposed));
}

/// The operands of an operation may be expressed in any frames.
template <class V>
void check_frame_invariance() {
  using T = malus::scalar_t<V>;
  const Chain<V> x;
  const auto frame_at = [&](std::size_t i) { return draw_frame<T>(x.directions[i]); };
  const auto s = x.light.light(), s2 = s.expressed_in(frame_at(0));
  const auto a = propagate(x.a.quantity());
  const auto a2 = a.expressed_in(frame_at(0), frame_at(1));
  const auto b = propagate(x.b.quantity());
  const auto b2 = b.expressed_in(frame_at(1), frame_at(2));
  const auto c = x.c.quantity();
  const auto c2 = c.expressed_in(frame_at(2), frame_at(3));
  const auto w = propagate(x.row.analyzer()), w2 = w.expressed_in(frame_at(3));
  const auto many = propagate(x.importance.quantity()), many2 = many.expressed_in(frame_at(3));

  require_same("light itself: " + names(x), difference(s2, x.light));
  require_same("a matrix itself: " + names(x), difference(a2, x.a));
  require_same("a row itself: " + names(x), difference(w2, x.row));
  require_same("importance itself: " + names(x), difference(many2, x.importance));
  require_same("there and back: " + names(x),
               difference(a2.expressed_in(x.a.enter, x.a.exit), x.a));

  require_same("M s: " + names(x), difference(a2 * s2, told(a * s, x.a.exit)));
  auto ends = x.a;
  ends.exit = is_collinear(x.b.form) ? x.b.enter : x.b.exit;
  require_same("N M: " + names(x), difference(b2 * a2, told(b * a, ends)));
  require_same("W M: " + names(x), difference(many2 * c2, told(many * c, x.c.enter)));
  require_same("w M: " + names(x), difference(w2 * c2, told(w * c, x.c.enter)));
  require_same("M + N: " + names(x), difference(a2 + a, told(a + a, x.a)));
  require_same("s + t: " + names(x), difference(s2 + s, told(s + s, x.light.frame)));
  require_same("W + V: " + names(x),
               difference(many2 + many, told(many + many, x.importance.frame)));
  const auto end = c * (b * (a * s));
  const auto end2 = c2 * (b2 * (a2 * s2));
  require_same("w s: " + names(x), difference(V(w2 * end2), told(V(w * end))));
  require_same("W s: " + names(x), difference(many2 * end2, told(many * end)));
  require_same("<s, t>: " + names(x),
               difference(V(inner_product(s2, s)), told(V(inner_product(s, s)))));
}

template <class V>
void check_propagation() {
  const Chain<V> x;
  const auto t = x.b.template quantity<exitant, incident>();
  const auto s = vectors<V>(x.light.form, *components(4 * channels<V>),
                            draw_frame<malus::scalar_t<V>>(x.directions[1]));
  const auto exitant_light = s.template light<exitant>();
  require_same("free space leaves light as it is",
               difference(poisoned(propagate(exitant_light)), s));
  require_same("free space leaves a matrix as it is",
               difference(poisoned(propagate(x.a.quantity())), x.a));
  require_same("free space leaves a row as it is",
               difference(poisoned(propagate(x.row.analyzer())), x.row));
  require_same("free space leaves importance as it is",
               difference(poisoned(propagate(x.importance.quantity())), x.importance));

  require_same("a transmittance acts last: " + names(x),
               difference(propagate(exitant_light, t), told(t * exitant_light, x.b.exit)));
  const auto w = vectors<V>(x.row.form, *components(4 * channels<V>),
                            draw_frame<malus::scalar_t<V>>(x.directions[2]))
                     .analyzer();
  // w (T s) = (w T) s: light sent to the measurement, or the measurement to the light.
  require_same("G and G*: " + names(x), difference(V(w * propagate(exitant_light, t)),
                                                   told(V(propagate(w, t) * exitant_light))));
  const auto unit = malus::Mueller<V, exitant, incident>::plain(V(1));
  require_same("free space is the transmittance 1: " + names(x),
               difference(propagate(exitant_light, unit), told(propagate(exitant_light), s.frame)));
}

template <class V>
void check_scaling() {
  using T = malus::scalar_t<V>;
  const Chain<V> x;
  const auto k =
      value_of<V>([drawn = *components(channels<V>)](std::size_t i) { return drawn[i]; });
  const auto a = x.a.quantity();
  const auto s = x.light.light();
  const auto w = x.row.analyzer();
  const auto many = x.importance.quantity();
  require_form("scaled matrix", (k * a).form(), a.form());
  require_same("(k M) s = M (k s): " + names(x),
               difference((k * a) * s, told(a * (s * k), x.a.exit)));
  require_same("k M = M k: " + names(x), difference(k * a, told(a * k, x.a)));
  require_same("2 M = M + M: " + names(x), difference(T(2) * a, told(a + a, x.a)));
  require_same("2 s = s + s: " + names(x), difference(T(2) * s, told(s + s, x.light.frame)));
  require_same("w / 0.5 = w + w: " + names(x), difference(w / T(0.5), told(w + w, x.row.frame)));
  require_same("2 W = W + W: " + names(x),
               difference(many * T(2), told(many + many, x.importance.frame)));
  auto scaled = a;
  scaled *= k;
  require_same("M *= k: " + names(x), difference(scaled, told(a * k, x.a)));
}

/// Row r of an importance is an analyzer.
template <class V>
void check_rows() {
  const Chain<V> x;
  const auto c = x.c.quantity();
  const auto s = vectors<V>(StokesForm::full, *components(4 * channels<V>),
                            draw_frame<malus::scalar_t<V>>(x.directions[2]))
                     .light();
  const auto many = propagate(x.importance.quantity());
  const auto readings = many * (c * s);
  const auto product = many * c;
  for (std::size_t r = 0; r < 4; ++r) {
    Vectors<V> row{StokesForm::full, {}, x.importance.frame};
    for (std::size_t i = 0; i < channels<V>; ++i) row.v[i] = x.importance.m[i][r];
    const auto w = propagate(row.analyzer());
    require_same("reading " + std::to_string(r) + ": " + names(x),
                 difference(V(w * (c * s)), told(readings[r])));
    require_same("row " + std::to_string(r) + " of a product: " + names(x),
                 difference(V((w * c) * s), told((product * s)[r])));
  }
}

}  // namespace

TEST_CASE_TEMPLATE("the algebra's laws hold for any forms", V, double, malus::Rgb) {
  CHECK(rc::check("products are associative", [] { check_associativity<V>(); }));
  CHECK(rc::check("products distribute over sums", [] { check_distributivity<V>(); }));
  CHECK(rc::check("the adjoint is the transpose", [] { check_adjointness<V>(); }));
  CHECK(
      rc::check("no result depends on the operands' frames", [] { check_frame_invariance<V>(); }));
  CHECK(rc::check("propagation", [] { check_propagation<V>(); }));
  CHECK(rc::check("scaling", [] { check_scaling<V>(); }));
  CHECK(rc::check("the rows of an importance are analyzers", [] { check_rows<V>(); }));
}
