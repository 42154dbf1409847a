// SPDX-License-Identifier: MIT
// A frame: the pair of axes (x, y) that the linear components of a Stokes vector refer to.
// Invariant: x × y = the direction of light propagation, on both sides of a scattering event and
// whichever way a path is traced.
//
// Two frames of one direction differ by a rotation about it, G F⁻¹ = R(φ) (paper, sections 3.1
// and 4.1). R is applied to two components and is never formed; its coefficients need no
// trigonometry.
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <type_traits>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <malus/config.hpp>
#include <malus/spectrum.hpp>

namespace malus {

namespace detail {

template <class U>
concept HasXyz = requires(const U& u) {
  u.x;
  u.y;
  u.z;
};
template <class U>
concept HasXyzFunctions = requires(const U& u) {
  u.x();
  u.y();
  u.z();
};

/// Any vector type with x, y, z members, x(), y(), z() functions, or [].
template <std::floating_point T, class U>
glm::vec<3, T> to_vec3(const U& u) {
  if constexpr (HasXyzFunctions<U>)
    return {static_cast<T>(u.x()), static_cast<T>(u.y()), static_cast<T>(u.z())};
  else if constexpr (HasXyz<U>)
    return {static_cast<T>(u.x), static_cast<T>(u.y), static_cast<T>(u.z)};
  else
    return {static_cast<T>(u[0]), static_cast<T>(u[1]), static_cast<T>(u[2])};
}

}  // namespace detail

/// A vector of three numbers: members x, y, z, or functions of those names, or operator[].
template <class U>
concept Vector3 = detail::HasXyz<U> || detail::HasXyzFunctions<U> || requires(const U& u) { u[2]; };

/// The rotation R(φ) of a frame by φ, counter-clockwise in the receiver's view (paper,
/// section 3.1): rows (cos 2φ, sin 2φ) and (−sin 2φ, cos 2φ) on (S1, S2).
template <std::floating_point T>
struct Rotation {
  T cos2 = 1;
  T sin2 = 0;

  /// R(angle), radians, finite; to 1 ulp.
  static Rotation by(T angle) { return {std::cos(2 * angle), std::sin(2 * angle)}; }

  /// R(−φ).
  constexpr Rotation inverse() const { return {cos2, -sin2}; }

  /// True for multiples of a quarter turn, which map mirror-symmetric matrices to mirror-symmetric
  /// ones. To rounding: a frame's axes are orthogonal to rounding only, so that even between a
  /// frame and itself sin2 is seldom 0.
  constexpr bool is_quarter_turns() const {
    constexpr T rounding = 8 * std::numeric_limits<T>::epsilon();
    return -rounding <= sin2 && sin2 <= rounding;
  }

  /// R(φ₁) R(φ₂) = R(φ₁ + φ₂), to 1 ulp.
  friend constexpr Rotation operator*(Rotation a, Rotation b) {
    return {a.cos2 * b.cos2 - a.sin2 * b.sin2, a.sin2 * b.cos2 + a.cos2 * b.sin2};
  }
};

/// No rotation, known at compile time: between a static frame and itself.
struct NoRotation {
  constexpr NoRotation inverse() const { return {}; }
  constexpr bool is_quarter_turns() const { return true; }
};

/// A frame known at run time. x and y are orthogonal and of equal length (1, unless the maker says
/// otherwise: rotations are homogeneous in the axes, so that unnormalised ones are exact as well).
/// Default-constructed: uninitialised.
template <std::floating_point T>
class Frame {
 public:
  using scalar_type = T;
  using vector = glm::vec<3, T>;

  Frame() = default;

  /// The frame with these axes; they are taken as they are: orthogonal, of equal non-zero length.
  template <Vector3 X, Vector3 Y>
  Frame(const X& x, const Y& y) : x_(detail::to_vec3<T>(x)), y_(detail::to_vec3<T>(y)) {}

  /// F_u of the paper: x along `x`, y = direction × x. Both of unit length and orthogonal.
  template <Vector3 D, Vector3 X>
  static Frame from_direction_and_x(const D& direction, const X& x) {
    const vector d = detail::to_vec3<T>(direction), u = detail::to_vec3<T>(x);
    return {u, glm::cross(d, u)};
  }

  /// The frame about a unit direction whose x is as near to `hint` as may be: x = hint made
  /// orthogonal to the direction (the paper's v(ω)). The hint may be of any finite length; to 2 ulp
  /// over the sine between the two. Where hint and direction are parallel to working precision, and
  /// for a hint of 0, an arbitrary frame.
  template <Vector3 D, Vector3 H>
  static Frame toward(const D& direction, const H& hint) {
    const vector d = detail::to_vec3<T>(direction), long_hint = detail::to_vec3<T>(hint);
    const T largest =
        std::max({std::abs(long_hint.x), std::abs(long_hint.y), std::abs(long_hint.z)});
    if (!(largest > 0)) return about(d);
    // Of any length whose square is out of range, too.
    const vector h = long_hint / largest;
    const vector x = h - glm::dot(h, d) * d;
    const T length2 = glm::dot(x, x);
    constexpr T parallel = sizeof(T) == 4 ? T(1e-12) : T(1e-28);
    if (!(length2 > parallel * glm::dot(h, h))) return about(d);
    // Near the direction the difference is mostly rounding along it: take that off again.
    const vector across = x / std::sqrt(length2);
    return from_direction_and_x(d, glm::normalize(across - glm::dot(across, d) * d));
  }

  /// Some frame about a unit direction, to 2 ulp, continuous but at z = 0 (Duff et al. 2017,
  /// "Building an orthonormal basis, revisited").
  template <Vector3 D>
  static Frame about(const D& direction) {
    const vector d = detail::to_vec3<T>(direction);
    const T sign = std::copysign(T(1), d.z);
    const T a = T(-1) / (sign + d.z);
    const T b = d.x * d.y * a;
    return {vector(1 + sign * d.x * d.x * a, sign * b, -sign * d.x),
            vector(b, sign + d.y * d.y * a, -d.y)};
  }

  const vector& x() const { return x_; }
  const vector& y() const { return y_; }
  /// x × y: the direction of light propagation (of unit length if the axes are).
  vector direction() const { return glm::cross(x_, y_); }

  /// This frame turned counter-clockwise, in the receiver's view, by a finite angle in radians; to
  /// 2 ulp.
  Frame turned(T angle) const {
    const T c = std::cos(angle), s = std::sin(angle);
    return {c * x_ + s * y_, c * y_ - s * x_};
  }

 private:
  vector x_, y_;
};

/// A frame that is a name: an empty type, so that quantities in it take no storage for it and
/// agreement is a matter of types. Tag is any type, and need not be complete.
template <class Tag>
struct StaticFrame {};

namespace detail {

#if MALUS_CHECK_FRAMES
/// The vector over its largest component: of axes far from unit length the squares are no numbers.
template <class T>
glm::vec<3, T> of_order_one(const glm::vec<3, T>& v) {
  const T largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  return largest > 0 ? v / largest : v;
}

template <class T>
void check_one_direction(const Frame<T>& from, const Frame<T>& to, const char* operation) {
  const auto a = of_order_one(from.direction()), b = of_order_one(to.direction());
  const T scale = std::sqrt(glm::dot(a, a) * glm::dot(b, b));
  // Two float directions computed in two ways differ by some 1e-6; a wrong vertex differs by far
  // more than 1e-3.
  if (glm::dot(a, b) >= T(1 - 1e-3) * scale) return;
  FrameMismatch m{};
  for (int i = 0; i < 3; ++i) {
    m.from_x[i] = static_cast<double>(from.x()[i]);
    m.from_y[i] = static_cast<double>(from.y()[i]);
    m.to_x[i] = static_cast<double>(to.x()[i]);
    m.to_y[i] = static_cast<double>(to.y()[i]);
  }
  m.operation = operation;
  mismatch_handler()(m);
}
#else
template <class T>
MALUS_INLINE void check_one_direction(const Frame<T>&, const Frame<T>&, const char*) {}
#endif

}  // namespace detail

/// R(φ) from any common multiple of c = cos φ and s = sin φ, to 3 ulp; of (0, 0) the identity. c² +
/// s² must be a number.
///
/// Made so that over long chains of rotations the degree of polarisation does not drift. By
/// quotients: products with 1/n, n just below 1, are rounded up again and again. And everything
/// times 5/4, which cancels: n = c² + s² of unit axes is next to 1, where numbers are spaced twice
/// as widely above as below, so that most of what is just above 1 is rounded down to it.
template <std::floating_point T>
MALUS_INLINE constexpr Rotation<T> rotation_by(T c, T s) {
  const T more_c = T(1.25) * c, more_s = T(1.25) * s;
  const T c2 = more_c * c, s2 = more_s * s, cs = more_c * s, norm2 = c2 + s2;
  if (!(norm2 > 0)) return {};
  return {(c2 - s2) / norm2, (cs + cs) / norm2};
}

/// G F⁻¹, the rotation that expresses in `to` what is expressed in `from`. With c = x·x', s = x'·y
/// of the two frames, cos 2φ = (c² − s²)/(c² + s²) and sin 2φ = 2cs/(c² + s²): the division keeps
/// it a rotation where the frames are slightly off, and makes it independent of the axes' lengths.
/// To 3 ulp of the axes as they are, of lengths from 1e-7 to 1e8 (double: 1e-60 to 1e60); where
/// directions disagree by δ, off by δ²/2 besides. Perpendicular directions, which have no rotation,
/// give the identity.
template <std::floating_point T>
MALUS_INLINE Rotation<T> rotation(const Frame<T>& from, const Frame<T>& to,
                                  const char* operation = "rotation") {
  detail::check_one_direction(from, to, operation);
  return rotation_by(glm::dot(from.x(), to.x()), glm::dot(from.y(), to.x()));
}

template <class Tag>
constexpr NoRotation rotation(StaticFrame<Tag>, StaticFrame<Tag>, const char* = "") {
  return {};
}

/// Rotates (S1, S2) by R: the only two components that a frame concerns.
template <SpectralValue V>
MALUS_INLINE constexpr void rotate(const Rotation<scalar_t<V>>& r, V& s1, V& s2) {
  const V rotated = r.cos2 * s1 + r.sin2 * s2;
  s2 = r.cos2 * s2 - r.sin2 * s1;
  s1 = rotated;
}

template <SpectralValue V>
MALUS_INLINE constexpr void rotate(NoRotation, V&, V&) {}

}  // namespace malus
