// SPDX-License-Identifier: MIT
// The bounds of docs/accuracy.md, of frames, products and Fresnel's equations: over random inputs
// and at the edges of what is allowed, against long double. Compiled a second time with
// -ffast-math.
#include "unit/accuracy_support.hpp"

#include <malus/malus.hpp>

namespace {

using namespace accuracy_test;
using malus::exitant, malus::incident;

template <class T>
using Vector = glm::vec<3, T>;
using Exact3 = std::array<Exact, 3>;

Exact3 cross(const Exact3& a, const Exact3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Exact dot(const Exact3& a, const Exact3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Exact3 times(Exact k, const Exact3& a) { return {k * a[0], k * a[1], k * a[2]}; }
Exact3 plus(const Exact3& a, const Exact3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Exact3 unit(const Exact3& a) { return times(1 / std::sqrt(dot(a, a)), a); }
template <class T>
Exact3 exact(const Vector<T>& v) {
  return {v.x, v.y, v.z};
}
template <class T>
Vector<T> rounded(const Exact3& v) {
  return {static_cast<T>(v[0]), static_cast<T>(v[1]), static_cast<T>(v[2])};
}
template <class T>
std::array<T, 3> components(const Vector<T>& v) {
  return {v.x, v.y, v.z};
}

/// A unit direction, now and then an axis or next to one.
Exact3 direction(Random& random) {
  const auto d = random.direction();
  Exact3 v{d[0], d[1], d[2]};
  const double kind = random.unit();
  if (kind < 0.1) v = {0, 0, random.sign()};
  if (kind < 0.05) v[0] = random.magnitude(1e-30, 1e-3);
  return unit(v);
}
/// A unit vector across, at any angle about the direction.
Exact3 across(const Exact3& d, Random& random) {
  const Exact3 other = std::abs(d[0]) < 0.6L ? Exact3{1, 0, 0} : Exact3{0, 1, 0};
  const Exact3 u = unit(cross(d, other)), v = cross(d, u);
  const Exact angle = random.between(0, 2 * std::numbers::pi);
  return plus(times(std::cos(angle), u), times(std::sin(angle), v));
}
template <class T>
malus::Frame<T> frame(const Exact3& d, const Exact3& x, Exact length = 1) {
  return {rounded<T>(times(length, x)), rounded<T>(times(length, cross(d, x)))};
}

/// The proper rotation between two frames as their axes are.
template <class T>
std::array<Exact, 2> turn(const malus::Frame<T>& from, const malus::Frame<T>& to) {
  const Exact c = dot(exact(from.x()), exact(to.x())), s = dot(exact(from.y()), exact(to.x()));
  const Exact n = c * c + s * s;
  return {(c * c - s * s) / n, 2 * c * s / n};
}

template <class T>
void measure_frames(Bounds& bounds) {
  using malus::Frame;
  Random random(1);
  for (int i = 0; i < 8000; ++i) {
    const Exact3 d = direction(random), x = across(d, random);
    const Vector<T> td = rounded<T>(d), tx = rounded<T>(x);
    const Exact3 rd = exact(td), rx = exact(tx);

    const auto made = Frame<T>::from_direction_and_x(td, tx);
    bounds.compare("Frame::from_direction_and_x", components(made.y()), cross(rd, rx), 1);
    bounds.compare("Frame::direction", components(made.direction()),
                   cross(exact(made.x()), exact(made.y())), 1);
    const Exact sign = std::copysign(1.0L, rd[2]), a = -1 / (sign + rd[2]);
    const auto about = Frame<T>::about(td);
    bounds.compare("Frame::about", components(about.x()),
                   {1 + sign * rd[0] * rd[0] * a, sign * rd[0] * rd[1] * a, -sign * rd[0]}, 1);
    bounds.compare("Frame::about", components(about.y()),
                   {rd[0] * rd[1] * a, sign + rd[1] * rd[1] * a, -rd[1]}, 1);
    const T angle = static_cast<T>(random.between(-10, 10));
    const Exact ca = std::cos(static_cast<Exact>(angle)), sa = std::sin(static_cast<Exact>(angle));
    const auto turned = made.turned(angle);
    bounds.compare("Frame::turned", components(turned.x()),
                   plus(times(ca, exact(made.x())), times(sa, exact(made.y()))), 1);

    // A hint of any length, at any angle to the direction: the error times the sine.
    const Exact sine = random.magnitude(1e-4, 1);
    const Exact3 hint = times(static_cast<Exact>(random.magnitude(1e-30, 1e30)),
                              plus(times(std::sqrt(1 - sine * sine), d), times(sine, x)));
    const Exact3 h = exact(rounded<T>(hint));
    const Exact3 hu = unit(h), d1 = unit(rd);
    const Exact3 perpendicular = plus(hu, times(-dot(hu, d1), d1));
    const Exact found = std::sqrt(dot(perpendicular, perpendicular));
    const auto toward = Frame<T>::toward(td, rounded<T>(hint));
    const Exact3 expected = unit(perpendicular);
    std::array<T, 3> scaled = components(toward.x());
    std::array<Exact, 3> scaled_exact{};
    for (std::size_t k = 0; k < 3; ++k) {
      scaled_exact[k] = found * expected[k];
      scaled[k] =
          static_cast<T>(found * (static_cast<Exact>(scaled[k]) - expected[k]) + scaled_exact[k]);
    }
    bounds.compare("Frame::toward", scaled, scaled_exact, 1);

    // Nearly equal, nearly opposite, a quarter turn; long axes and short ones.
    const double kind = random.unit();
    const Exact small = random.magnitude(1e-20, 1e-1);
    const Exact by = kind < 0.4   ? random.between(-std::numbers::pi, std::numbers::pi)
                     : kind < 0.6 ? small
                     : kind < 0.8 ? pi + small
                                  : pi / 2 - small;
    const Exact3 to_x = plus(times(std::cos(by), x), times(std::sin(by), cross(d, x)));
    const double reach = sizeof(T) == 4 ? 1e7 : 1e60;
    const auto from = frame<T>(d, x, random.magnitude(1 / reach, reach));
    const auto to = frame<T>(d, to_x, random.magnitude(1 / reach, reach));
    const auto r = malus::rotation(from, to);
    bounds.compare("rotation", std::array{r.cos2, r.sin2}, turn(from, to), 1);
    bounds.record<T>(
        "Rotation, of length 1", true,
        static_cast<double>(
            std::abs(std::hypot(static_cast<Exact>(r.cos2), static_cast<Exact>(r.sin2)) - 1) /
            last_place<T>(1)));
    const T c = static_cast<T>(std::cos(by)), s = static_cast<T>(std::sin(by));
    const Exact ec = c, es = s, n = ec * ec + es * es;
    const auto direct = malus::rotation_by(c, s);
    bounds.compare("rotation_by", std::array{direct.cos2, direct.sin2},
                   {(ec * ec - es * es) / n, 2 * ec * es / n}, 1);
    const auto angled = malus::Rotation<T>::by(angle);
    bounds.compare(
        "Rotation::by", std::array{angled.cos2, angled.sin2},
        {std::cos(2 * static_cast<Exact>(angle)), std::sin(2 * static_cast<Exact>(angle))}, 1);
    const auto both = angled * direct;
    const Exact c1 = angled.cos2, s1 = angled.sin2, c2 = direct.cos2, s2 = direct.sin2;
    bounds.compare("Rotation * Rotation", std::array{both.cos2, both.sin2},
                   {c1 * c2 - s1 * s2, s1 * c2 + c1 * s2}, 1);
  }
}

using ExactStokes = std::array<Exact, 4>;
using ExactRows = std::array<ExactStokes, 4>;

ExactStokes turned(const std::array<Exact, 2>& t, const ExactStokes& s) {
  return {s[0], t[0] * s[1] + t[1] * s[2], t[0] * s[2] - t[1] * s[1], s[3]};
}
ExactStokes act(const ExactRows& m, const ExactStokes& s) {
  ExactStokes out{};
  for (std::size_t r = 0; r < 4; ++r)
    for (std::size_t k = 0; k < 4; ++k) out[r] += m[r][k] * s[k];
  return out;
}
ExactRows transposed(const ExactRows& m) {
  ExactRows t;
  for (std::size_t r = 0; r < 4; ++r)
    for (std::size_t c = 0; c < 4; ++c) t[c][r] = m[r][c];
  return t;
}
/// n · R · m
ExactRows multiply(const ExactRows& n, const std::array<Exact, 2>& t, const ExactRows& m) {
  ExactRows columns = transposed(m);
  for (auto& column : columns) column = act(n, turned(t, column));
  return transposed(columns);
}
/// R_o · m · R_i⁻¹
ExactRows turned(const std::array<Exact, 2>& exit, const std::array<Exact, 2>& enter,
                 const ExactRows& m) {
  ExactRows columns = transposed(m);
  for (auto& column : columns) column = turned(exit, column);
  ExactRows rows = transposed(columns);
  for (auto& row : rows) row = turned(enter, row);
  return rows;
}

template <class T>
struct Operand {
  malus::Stokes<T> light;
  malus::Mueller<T> matrix;
  ExactStokes exact_light;
  ExactRows exact_rows;
};

/// Light and a matrix of any size, in frames about one direction.
template <class T>
Operand<T> operand(const Exact3& d, bool block, double size, Random& random) {
  const auto any = [&] { return frame<T>(d, across(d, random)); };
  const auto value = [&] { return static_cast<T>(size * random.between(-1, 1)); };
  Operand<T> o;
  std::array<std::array<T, 4>, 4> rows{};
  for (std::size_t r = 0; r < 4; ++r)
    for (std::size_t c = 0; c < 4; ++c) rows[r][c] = block && r / 2 != c / 2 ? T(0) : value();
  o.matrix = block ? malus::Mueller<T>::block({rows[0][0], rows[0][1], rows[1][0], rows[1][1]},
                                              {rows[2][2], rows[2][3], rows[3][2], rows[3][3]},
                                              any(), any())
                   : malus::Mueller<T>::from_rows(rows, any(), any());
  o.light = {static_cast<T>(size), value(), value(), value(), any()};
  for (std::size_t i = 0; i < 4; ++i) {
    o.exact_light[i] = o.light[i];
    for (std::size_t k = 0; k < 4; ++k) o.exact_rows[i][k] = rows[i][k];
  }
  return o;
}

template <class Q>
auto four(const Q& q) {
  return std::array{q[0], q[1], q[2], q[3]};
}
template <class M>
auto sixteen(const M& m) {
  std::array<typename M::scalar_type, 16> flat;
  for (int i = 0; i < 16; ++i) flat[static_cast<std::size_t>(i)] = m(i / 4, i % 4);
  return flat;
}
std::array<Exact, 16> sixteen(const ExactRows& m) {
  std::array<Exact, 16> flat;
  for (std::size_t i = 0; i < 16; ++i) flat[i] = m[i / 4][i % 4];
  return flat;
}

template <class T>
void measure_products(Bounds& bounds) {
  Random random(2);
  for (int i = 0; i < 3000; ++i) {
    const Exact3 d = direction(random);
    // Products of two are in range.
    const double size =
        sizeof(T) == 4 ? random.magnitude(1e-14, 1e14) : random.magnitude(1e-90, 1e90);
    const auto a = operand<T>(d, false, size, random), b = operand<T>(d, false, size, random);
    const Exact one = static_cast<Exact>(size), two = one * one;
    const auto to = frame<T>(d, across(d, random));
    const auto t = turn(a.light.frame(), to);

    bounds.compare("Stokes::expressed_in", four(a.light.expressed_in(to)), turned(t, a.exact_light),
                   one);
    bounds.compare(
        "Mueller::expressed_in", sixteen(a.matrix.expressed_in(to, to)),
        sixteen(turned(turn(a.matrix.exit(), to), turn(a.matrix.enter(), to), a.exact_rows)), one);
    const auto arrives = propagate(b.light);
    const auto entry = turn(b.light.frame(), a.matrix.enter());
    const ExactStokes scattered = act(a.exact_rows, turned(entry, b.exact_light));
    bounds.compare("Mueller * Stokes", four(a.matrix * arrives), scattered, two);
    bounds.compare(
        "Mueller * Mueller", sixteen(a.matrix * propagate(b.matrix)),
        sixteen(multiply(a.exact_rows, turn(b.matrix.exit(), a.matrix.enter()), b.exact_rows)),
        two);
    const auto w = malus::Importance<T>::from_rows(
        {four(a.light), four(b.light), four(a.light), four(b.light)}, a.light.frame());
    const ExactRows w_rows{a.exact_light, b.exact_light, a.exact_light, b.exact_light};
    const auto facing = turn(b.light.frame(), a.light.frame());
    bounds.compare("Importance * Stokes", four(w * arrives),
                   act(w_rows, turned(facing, b.exact_light)), two);
    bounds.compare("Importance * Mueller", sixteen(w * propagate(b.matrix)),
                   sixteen(multiply(w_rows, turn(b.matrix.exit(), a.light.frame()), b.exact_rows)),
                   two);
    const malus::Analyzer<T> row(a.light[0], a.light[1], a.light[2], a.light[3], a.light.frame());
    bounds.compare("Analyzer * Stokes", row * arrives,
                   act(w_rows, turned(facing, b.exact_light))[0], two);
    bounds.compare("inner_product", inner_product(a.light, b.light),
                   act(w_rows, turned(facing, b.exact_light))[0], two);
    ExactStokes sum = turned(facing, b.exact_light);
    for (std::size_t k = 0; k < 4; ++k) sum[k] += a.exact_light[k];
    bounds.compare("Stokes + Stokes", four(a.light + b.light), sum, one);
    ExactRows added = turned(turn(b.matrix.exit(), a.matrix.exit()),
                             turn(b.matrix.enter(), a.matrix.enter()), b.exact_rows);
    for (std::size_t k = 0; k < 16; ++k) added[k / 4][k % 4] += a.exact_rows[k / 4][k % 4];
    bounds.compare("Mueller + Mueller", sixteen(a.matrix + b.matrix), sixteen(added), one);
    bounds.compare("adjoint", sixteen(adjoint(a.matrix)), sixteen(transposed(a.exact_rows)), one);

    // Blocks in frames that differ by rounding or by almost a quarter turn.
    auto p = operand<T>(d, true, size, random), q = operand<T>(d, true, size, random);
    const Exact off = random.unit() < 0.5
                          ? random.between(-2, 2) * static_cast<double>(last_place<T>(1))
                          : random.between(-std::numbers::pi, std::numbers::pi);
    const Exact3 x = across(d, random);
    const Exact3 y = plus(times(std::sin(off), x), times(std::cos(off), cross(d, x)));
    const auto enter = frame<T>(d, x), exit = frame<T>(d, y);
    const malus::BlockMueller<T> left = malus::BlockMueller<T>::block(
        {p.matrix(0, 0), p.matrix(0, 1), p.matrix(1, 0), p.matrix(1, 1)},
        {p.matrix(2, 2), p.matrix(2, 3), p.matrix(3, 2), p.matrix(3, 3)}, enter, enter);
    const malus::BlockMueller<T> right = malus::BlockMueller<T>::block(
        {q.matrix(0, 0), q.matrix(0, 1), q.matrix(1, 0), q.matrix(1, 1)},
        {q.matrix(2, 2), q.matrix(2, 3), q.matrix(3, 2), q.matrix(3, 3)}, exit, exit);
    bounds.compare("block * block",
                   sixteen(malus::Mueller<T>(left) * propagate(malus::Mueller<T>(right))),
                   sixteen(multiply(p.exact_rows, turn(exit, enter), q.exact_rows)), two);
  }
  // The sweeps of a path of 20 vertices, in units of its largest possible result.
  for (int i = 0; i < 200; ++i) {
    const Exact3 d = direction(random);
    malus::PathSweep<T> sweep;
    malus::DeferredSweep<T, malus::Mueller<T>> deferred;
    std::vector<Operand<T>> vertices;
    for (int k = 0; k < 20; ++k) {
      vertices.push_back(operand<T>(d, k % 2 == 0, 0.5, random));
      sweep.deposit(vertices.back().light);
      sweep.scatter(vertices.back().matrix);
      deferred.deposit(vertices.back().light);
      deferred.scatter() = vertices.back().matrix;
    }
    ExactStokes light{};
    Exact scale = 0;
    for (std::size_t k = vertices.size(); k-- > 0;) {
      const auto& v = vertices[k];
      if (k + 1 < vertices.size()) {
        light = turned(turn(vertices[k + 1].light.frame(), v.matrix.enter()), light);
        light = turned(turn(v.matrix.exit(), v.light.frame()), act(v.exact_rows, light));
      }
      for (std::size_t j = 0; j < 4; ++j) light[j] += v.exact_light[j];
      for (const Exact x : light) scale = std::max(scale, std::abs(x));
    }
    bounds.compare("PathSweep::result", four(sweep.result()), light, scale);
    const auto acted = deferred.result([](const auto& matrix, const auto& arriving, bool) {
      return malus::Stokes<T>(matrix * propagate(arriving));
    });
    bounds.compare("DeferredSweep::result", four(acted.expressed_in(vertices[0].light.frame())),
                   light, scale);
  }
}

/// The amplitudes of reflection in Verdet's signs; of total reflection the root is in the upper
/// half plane.
struct Amplitudes {
  Complex s, p;
};
Amplitudes reflect(Exact cosine, Complex eta) {
  Complex q = std::sqrt((eta - 1.0L) * (eta + 1.0L) + cosine * cosine);
  if (q.imag() < 0) q = -q;
  if (cosine == 0) return eta == 1.0L ? Amplitudes{} : Amplitudes{-1, -1};
  return {(cosine - q) / (cosine + q), (eta * eta * cosine - q) / (eta * eta * cosine + q)};
}
std::array<Exact, 4> terms(const Amplitudes& a) {
  const Complex both = std::conj(a.s) * a.p;
  return {std::norm(a.s), std::norm(a.p), both.real(), both.imag()};
}
template <class T>
std::array<T, 4> terms(const malus::FresnelTerms<T>& f) {
  return {f.s, f.p, f.re, f.im};
}

/// How much a change of the cosine or the index by a unit in the last place changes the result: in
/// front of the critical angle beyond all bounds. Errors are measured against the larger of both.
template <class T, class Function>
void compare_conditioned(Bounds& bounds, const std::string& name, const std::array<T, 4>& got,
                         Exact cosine, Complex eta, const Function& function) {
  const std::array<Exact, 4> right = function(cosine, eta);
  const Exact step = last_place<T>(1) / 2;
  Exact change = 0;
  for (const Exact sign : {-1.0L, 1.0L}) {
    const auto moved = function(cosine, eta * (1 + sign * step));
    const auto tilted = function(std::min(cosine * (1 + sign * step), 1.0L), eta);
    for (std::size_t i = 0; i < 4; ++i)
      change = std::max({change, std::abs(moved[i] - right[i]), std::abs(tilted[i] - right[i])});
  }
  Exact worst = 0;
  bool finite = true;
  for (std::size_t i = 0; i < 4; ++i) {
    finite = finite && is_number(got[i]);
    worst = std::max(worst, std::abs(static_cast<Exact>(got[i]) - right[i]));
  }
  bounds.record<T>(name, finite, static_cast<double>(worst / std::max(2 * step, change)));
}

template <class T>
void measure_fresnel(Bounds& bounds) {
  Random random(3);
  for (int i = 0; i < 20000; ++i) {
    double eta = random.unit() < 0.5 ? random.magnitude(1.0 / 4, 4) : random.magnitude(1e-6, 1e6);
    const double kind = random.unit();
    if (kind < 0.2) eta = 1 + random.sign() * random.magnitude(1e-7, 1e-1);
    if (kind < 0.02) eta = 1;
    const T index = static_cast<T>(eta);
    const Exact n = index;
    // Any incidence, grazing, normal, Brewster's and critical, and their neighbours.
    const double where = random.unit();
    Exact cosine = random.unit();
    if (where < 0.02)
      cosine = 1;
    else if (where < 0.2)
      cosine = random.magnitude(1e-30, 1e-2);
    else if (where < 0.3)
      cosine = 1 - random.magnitude(1e-17, 1e-3);
    else if (where < 0.4)
      cosine = 1 / std::sqrt(1 + n * n);
    else if (where < 0.5 && n < 1)
      cosine = std::sqrt((1 - n) * (1 + n));
    T c = static_cast<T>(cosine);
    const int steps = static_cast<int>(random.between(-3, 3));
    for (int k = 0; k < std::abs(steps); ++k) c = std::nextafter(c, T(steps < 0 ? -1 : 2));
    c = std::min(std::max(c, T(0)), T(1));

    const auto reflection = [](Exact x, Complex m) { return terms(reflect(x, m)); };
    compare_conditioned<T>(bounds, "fresnel_dielectric", terms(malus::fresnel_dielectric(c, index)),
                           c, n, reflection);
    const auto transmission = [](Exact x, Complex m) -> std::array<Exact, 4> {
      const Exact q2 = (m.real() - 1) * (m.real() + 1) + x * x;
      if (m == 1.0L) return {1, 1, 1, 0};
      if (!(q2 > 0) || !(x > 0)) return {};
      const Exact q = std::sqrt(q2), s = 2 / (x + q),
                  p = 2 * m.real() / (m.real() * m.real() * x + q);
      return {x * q * s * s, x * q * p * p, x * q * s * p, 0};
    };
    compare_conditioned<T>(bounds, "fresnel_transmission",
                           terms(malus::fresnel_transmission(c, index)), c, n, transmission);
    const auto refracted = [](Exact x, Complex m) -> std::array<Exact, 4> {
      const Exact q2 = (m.real() - 1) * (m.real() + 1) + x * x;
      return {q2 > 0 ? std::sqrt(q2) / m.real() : 0, 0, 0, 0};
    };
    compare_conditioned<T>(bounds, "refracted_cosine",
                           {malus::refracted_cosine(c, index), T(0), T(0), T(0)}, c, n, refracted);
    const T k = static_cast<T>(random.unit() < 0.2 ? 0 : random.magnitude(1e-6, 1e4));
    const auto metal = malus::fresnel_conductor(c, index, k);
    if (n * n + static_cast<Exact>(k) * static_cast<Exact>(k) < 0.0625L) continue;
    compare_conditioned<T>(bounds, "fresnel_conductor", terms(metal), c, {n, static_cast<Exact>(k)},
                           reflection);
    const malus::Spectrum<T, 3> wide_index(index), wide_k(k);
    const auto wide = malus::fresnel_conductor(c, wide_index, wide_k);
    compare_conditioned<T>(bounds, "fresnel_conductor",
                           {wide.s[2], wide.p[2], wide.re[2], wide.im[2]}, c,
                           {n, static_cast<Exact>(k)}, reflection);
    bounds.compare("FresnelTerms::mean", metal.mean(),
                   (static_cast<Exact>(metal.s) + static_cast<Exact>(metal.p)) / 2, metal.s);
  }
}

TEST_CASE("accuracy: frames and rotations keep the bounds that the docs state") {
  Bounds bounds("Frames");
  measure_frames<float>(bounds);
  measure_frames<double>(bounds);
  bounds.check();
}
TEST_CASE("accuracy: products and sums keep the bounds that the docs state") {
  Bounds bounds("Products and sums");
  measure_products<float>(bounds);
  measure_products<double>(bounds);
  bounds.check();
}
TEST_CASE("accuracy: Fresnel's equations keep the bounds that the docs state") {
  Bounds bounds("Fresnel's equations");
  measure_fresnel<float>(bounds);
  measure_fresnel<double>(bounds);
  bounds.check();
}

}  // namespace
