// SPDX-License-Identifier: MIT
// Frames and rotations: axes, hints, round trips, and the trigonometry-free coefficients against
// atan2, cos and sin.
#include <doctest/doctest.h>

#include "property/comparison.hpp"

using namespace test;

namespace {

template <class T>
void require_close(const std::string& what, double got, double expected) {
  require_same(what, difference<T>(what, got, expected));
}

/// x ⊥ y, both of unit length, x × y = d.
template <class T>
void require_orthonormal(const malus::Frame<T>& frame, const reference::Axis& d) {
  const auto axes = to_axes(frame);
  require_close<T>("x·x", reference::dot(axes.x, axes.x), 1);
  require_close<T>("y·y", reference::dot(axes.y, axes.y), 1);
  require_close<T>("x·y", reference::dot(axes.x, axes.y), 0);
  const auto direction = reference::cross(axes.x, axes.y);
  for (std::size_t i = 0; i < 3; ++i) require_close<T>("x × y", direction[i], d[i]);
  for (int i = 0; i < 3; ++i)
    require_close<T>("direction()", static_cast<double>(frame.direction()[i]),
                     d[static_cast<std::size_t>(i)]);
}

template <class T>
void require_rotation(const std::string& what, const malus::Rotation<T>& got, double angle) {
  require_close<T>(what + ", cos 2φ", static_cast<double>(got.cos2), std::cos(2 * angle));
  require_close<T>(what + ", sin 2φ", static_cast<double>(got.sin2), std::sin(2 * angle));
}

template <class T>
malus::Frame<T> scaled(const malus::Frame<T>& frame, T length) {
  return {length * frame.x(), length * frame.y()};
}

}  // namespace

TEST_CASE_TEMPLATE("frames are orthonormal and x cross y is the direction of propagation", T, float,
                   double) {
  CHECK(rc::check("about a direction", [] {
    const auto d = *direction();
    require_orthonormal(malus::Frame<T>::about(d), d);
  }));
  CHECK(rc::check("toward a hint, which x lies as near to as may be", [] {
    const auto d = *direction(), hint = *direction();
    const T length = static_cast<T>(*positive());
    const auto frame = malus::Frame<T>::toward(d, malus::detail::to_vec3<T>(hint) * length);
    require_orthonormal(frame, d);
    const auto axes = to_axes(frame);
    require_close<T>("y·hint", reference::dot(axes.y, hint), 0);
    RC_ASSERT(reference::dot(axes.x, hint) >= -tolerance<T>);
  }));
  CHECK(rc::check("toward a hint that is almost the direction or its opposite", [] {
    const auto d = *direction(), across = axes_about(d, *angle()).x;
    const double off = std::pow(10.0, -*rc::gen::inRange(0, 20));
    const double sign = *rc::gen::element(1.0, -1.0);
    reference::Axis hint;
    for (std::size_t i = 0; i < 3; ++i) hint[i] = sign * d[i] + off * across[i];
    require_orthonormal(malus::Frame<T>::toward(d, hint), d);
  }));
  CHECK(rc::check("from a direction and x", [] {
    const auto d = *direction();
    const auto x = axes_about(d, *angle()).x;
    const auto frame = malus::Frame<T>::from_direction_and_x(d, x);
    require_orthonormal(frame, d);
    require_close<T>("x", reference::dot(to_axes(frame).x, x), 1);
  }));
  CHECK(rc::check("turned", [] {
    const auto d = *direction();
    const double phi = *angle();
    const auto frame = draw_frame<T>(d), turned = frame.turned(static_cast<T>(phi));
    require_orthonormal(turned, d);
    require_close<T>("x·x'", reference::dot(to_axes(frame).x, to_axes(turned).x), std::cos(phi));
    require_close<T>("y·x'", reference::dot(to_axes(frame).y, to_axes(turned).x), std::sin(phi));
  }));
}

TEST_CASE_TEMPLATE("the rotation between two frames is R(phi), without trigonometry", T, float,
                   double) {
  CHECK(rc::check("equal to cos and sin of twice the angle between them", [] {
    const auto d = *direction();
    const double from = *angle(), to = *angle();
    const auto f = to_frame<T>(axes_about(d, from)), g = to_frame<T>(axes_about(d, to));
    require_rotation("rotation(f, g)", rotation(f, g), to - from);
    require_rotation("Rotation::by", malus::Rotation<T>::by(static_cast<T>(to - from)), to - from);
  }));
  CHECK(rc::check("whatever the axes' lengths", [] {
    const auto d = *direction();
    const double from = *angle(), to = *angle();
    const auto length = [] { return static_cast<T>(std::pow(10.0, *rc::gen::inRange(-6, 7))); };
    const auto f = scaled(to_frame<T>(axes_about(d, from)), length());
    const auto g = scaled(to_frame<T>(axes_about(d, to)), length());
    require_rotation("rotation(f, g)", rotation(f, g), to - from);
  }));
  CHECK(rc::check("an exact rotation where the frames are slightly off", [] {
    const auto d = *direction();
    auto f = draw_frame<T>(d), g = draw_frame<T>(d);
    const auto off = [] { return static_cast<T>(1 + *component() / 100); };
    f = {f.x() * off(), f.y() * off()};
    g = {g.x() * off(), g.y() * off()};
    const auto r = rotation(f, g);
    require_close<T>("cos² + sin²", static_cast<double>(r.cos2 * r.cos2 + r.sin2 * r.sin2), 1);
  }));
  CHECK(rc::check("there and back is nothing, and two turns are their sum", [] {
    const double p = *angle(), q = *angle();
    const auto a = malus::Rotation<T>::by(static_cast<T>(p));
    const auto b = malus::Rotation<T>::by(static_cast<T>(q));
    require_rotation("R R⁻¹", a * a.inverse(), 0);
    require_rotation("R(p) R(q)", a * b, p + q);
    const auto d = *direction();
    const auto f = draw_frame<T>(d), g = draw_frame<T>(d), h = draw_frame<T>(d);
    require_rotation("f to g and back", rotation(g, f) * rotation(f, g), 0);
    const auto there = rotation(g, h) * rotation(f, g), direct = rotation(f, h);
    require_close<T>("f to g to h, cos", static_cast<double>(there.cos2),
                     static_cast<double>(direct.cos2));
    require_close<T>("f to g to h, sin", static_cast<double>(there.sin2),
                     static_cast<double>(direct.sin2));
  }));
  CHECK(rc::check("light's frame there and back", [] {
    const auto d = *direction();
    const auto s = vectors<T>(StokesForm::full, *components(4), draw_frame<T>(d));
    const auto other = draw_frame<T>(d);
    const auto turned = s.light().expressed_in(other);
    require_same("turned", difference(turned, s));
    require_same("back", difference(turned.expressed_in(s.frame), s));
    require_close<T>("linear polarisation",
                     std::hypot(static_cast<double>(turned[1]), static_cast<double>(turned[2])),
                     std::hypot(s.v[0][1], s.v[0][2]));
  }));
}

TEST_CASE_TEMPLATE("quarter turns are told from other turns", T, float, double) {
  CHECK(rc::check("between a frame, itself and its quarter turns", [] {
    const auto f = draw_frame<T>(*direction());
    auto g = f;
    for (int turns = 0; turns < 5; ++turns) {
      RC_ASSERT(rotation(f, g).is_quarter_turns());
      require_close<T>("cos 2φ", static_cast<double>(rotation(f, g).cos2), turns % 2 == 0 ? 1 : -1);
      g = {g.y(), -g.x()};
    }
  }));
  CHECK(rc::check("a tenth of a degree is none", [] {
    const auto f = draw_frame<T>(*direction());
    RC_ASSERT(!rotation(f, f.turned(T(0.1 * std::numbers::pi / 180))).is_quarter_turns());
  }));
}
