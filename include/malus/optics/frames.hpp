// SPDX-License-Identifier: MIT
// The frames that a scattering event's Mueller matrix is mirror-symmetric in: x = s, perpendicular
// to the plane of incidence and common to both sides; y = ω × s = p of each. Directions are those
// of light propagation.
#pragma once

#include <cmath>
#include <concepts>
#include <limits>

#include <malus/frame.hpp>

namespace malus {

template <std::floating_point T>
struct FramePair {
  Frame<T> enter, exit;
};

/// The frames with the common axis s, of any length but zero, perpendicular to both directions.
template <std::floating_point T, Vector3 D, Vector3 S>
FramePair<T> frames_with_common_axis(const D& in, const D& out, const S& s) {
  return {Frame<T>::from_direction_and_x(in, s), Frame<T>::from_direction_and_x(out, s)};
}

/// For reflection and refraction at a surface of normal n: s along n × ω. At normal incidence every
/// s will do, and where sin² θ drowns in rounding, so that n × ω is no longer perpendicular to ω.
template <std::floating_point T, Vector3 D, Vector3 N>
FramePair<T> frames_of_incidence(const N& normal, const D& in, const D& out) {
  const auto n = detail::to_vec3<T>(normal), d = detail::to_vec3<T>(in);
  glm::vec<3, T> s = glm::cross(n, d);
  const T length2 = glm::dot(s, s);
  constexpr T normal_incidence = std::numeric_limits<T>::epsilon();
  s = length2 > normal_incidence ? s / std::sqrt(length2) : Frame<T>::about(d).x();
  return frames_with_common_axis<T>(d, detail::to_vec3<T>(out), s);
}

}  // namespace malus
