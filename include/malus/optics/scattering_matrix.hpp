// SPDX-License-Identifier: MIT
// Scattering by particles that are turned at random and as many as their mirror images, spheres
// among them: six numbers at each angle (van de Hulst 1957, Light Scattering by Small Particles,
// section 5.2; Hovenier & van der Mee 1983),
//
//         a1   b1    0    0
//         b1   a2    0    0
//          0    0   a3   b2
//          0    0  -b2   a4
//
// in the frames of the scattering plane, which holds both directions of propagation: x lies in the
// plane, so that S1 > 0 is polarised parallel to it, and y = ω × x is its normal, common to both
// sides. (A surface's frames, optics/frames.hpp, have the normal as x.)
//
// A sphere's fields are E∥ = S2 E∥, E⊥ = S1 E⊥ of van de Hulst, with exp(−iωt). Here Ex = E∥; Ey is
// E⊥ on both sides, or its opposite on both, so that the Jones matrix is diag(S2, S1). S2 = 2
// Re(Ex* Ey) and S3 = −2 Im(Ex* Ey) mean Ex* Ey = (S2 − iS3)/2, of which scattering makes S2* S1
// times as much. With S2* S1 = c + id: S2' = c S2 + d S3 and S3' = c S3 − d S2, whence
//
//   a1 = a2 = (|S1|² + |S2|²)/2   b1 = (|S2|² − |S1|²)/2   a3 = a4 = Re(S1 S2*)   b2 = Im(S1 S2*).
#pragma once

#include <complex>
#include <concepts>
#include <limits>

#include <malus/mueller.hpp>
#include <malus/optics/frames.hpp>

namespace malus {

/// The six elements at one angle.
template <SpectralValue V>
struct ScatteringElements {
  V a1, a2, a3, a4, b1, b2;

  constexpr ScatteringElements& operator+=(const ScatteringElements& e) {
    a1 += e.a1, a2 += e.a2, a3 += e.a3, a4 += e.a4, b1 += e.b1, b2 += e.b2;
    return *this;
  }
  friend constexpr ScatteringElements operator+(ScatteringElements a, const ScatteringElements& b) {
    return a += b;
  }
  template <class Factor>
    requires std::same_as<Factor, V> || std::same_as<Factor, scalar_t<V>>
  friend constexpr ScatteringElements operator*(const ScatteringElements& e, const Factor& k) {
    return {e.a1 * k, e.a2 * k, e.a3 * k, e.a4 * k, e.b1 * k, e.b2 * k};
  }
};

/// The elements of amplitudes S1 (across the scattering plane) and S2 (parallel to it).
template <std::floating_point T>
ScatteringElements<T> scattering_elements(const std::complex<T>& s1, const std::complex<T>& s2) {
  const T across = std::norm(s1), along = std::norm(s2);
  const std::complex<T> product = s1 * std::conj(s2);
  const T a1 = (across + along) / 2;
  return {a1, a1, product.real(), product.real(), (along - across) / 2, product.imag()};
}

/// The frames of the scattering plane of light that propagates along `in` before and along `out`
/// after; both of unit length. Their axes are as long as the sine of the angle between the two:
/// rotations need no more. Where the directions are parallel, to rounding, any plane through `in`
/// will do.
template <std::floating_point T, Vector3 D>
FramePair<T> frames_of_scattering(const D& in, const D& out) {
  const auto a = detail::to_vec3<T>(in), b = detail::to_vec3<T>(out);
  glm::vec<3, T> normal = glm::cross(a, b);
  constexpr T parallel = std::numeric_limits<T>::epsilon();
  if (!(glm::dot(normal, normal) > parallel)) normal = Frame<T>::about(a).y();
  return {Frame<T>(glm::cross(normal, a), normal), Frame<T>(glm::cross(normal, b), normal)};
}

/// The phase matrix of given elements, in the frames of the scattering plane.
template <SpectralValue V, FrameType F>
constexpr BlockMueller<V, incident, exitant, F> scattering_matrix(const ScatteringElements<V>& e,
                                                                  const F& enter, const F& exit) {
  return BlockMueller<V, incident, exitant, F>::block({e.a1, e.b1, e.b1, e.a2},
                                                      {e.a3, e.b2, -e.b2, e.a4}, enter, exit);
}
template <SpectralValue V>
constexpr BlockMueller<V, incident, exitant, Frame<scalar_t<V>>> scattering_matrix(
    const ScatteringElements<V>& e, const FramePair<scalar_t<V>>& frames) {
  return scattering_matrix(e, frames.enter, frames.exit);
}

}  // namespace malus
