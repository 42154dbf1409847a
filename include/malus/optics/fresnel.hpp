// SPDX-License-Identifier: MIT
// Fresnel reflection and refraction (Born & Wolf, Principles of Optics, sections 1.5 and 14.2), at
// interfaces to dielectrics and conductors, as mirror-symmetric Mueller blocks in frames with the
// common axis s (optics/frames.hpp).
//
// Signs: fields exp(−iωt), complex index n + ik, k ≥ 0; Verdet's signs, r_s = (cos θi − q)/(cos θi
// + q) and r_p = (η² cos θi − q)/(η² cos θi + q) with q = η cos θt = √(η² − sin² θi), so that at
// normal incidence r_p = −r_s: the p axes of both sides are then opposite. S1 = |Es|² − |Ep|², S2 =
// 2 Re(Es* Ep), S3 = −2 Im(Es* Ep).
//
// No trigonometry and no complex arithmetic: with q = a + ib and t = sin²/cos, r_s* r_p = −R_s
// (|q|² − t² + 2itb)/|q + t|². η is the index behind the interface over that before it; cosines are
// of the incident side, in [0, 1].
#pragma once

#include <array>
#include <cmath>

#include <malus/mueller.hpp>
#include <malus/optics/frames.hpp>

namespace malus {

/// What a Mueller block is made of: the intensity ratios of s and p light and the complex ratio of
/// their product, r_s* r_p = re + i·im (transmission: with its factor q/cos θi).
template <SpectralValue V>
struct FresnelTerms {
  V s, p, re, im;

  /// The value for unpolarised light.
  constexpr V mean() const { return scalar_t<V>(0.5) * (s + p); }
  /// What S1 of unpolarised light becomes.
  constexpr V half_difference() const { return scalar_t<V>(0.5) * (s - p); }
};

namespace detail {

/// η² − sin² θi = q². Near η = 1 written so that nothing cancels at grazing incidence, and with
/// η = 1, q is cos θi itself and nothing is reflected; for a small η so that it is not lost
/// beside 1.
template <std::floating_point T>
constexpr T squared_root_term(T cos_i, T eta) {
  if (eta < T(0.5)) return eta * eta - (1 - cos_i) * (1 + cos_i);
  return (eta - 1) * (eta + 1) + cos_i * cos_i;
}

/// The terms of reflection from q = a + ib. Both R_p and r_s* r_p are taken times cos² to stay
/// finite at grazing incidence.
template <std::floating_point T>
constexpr FresnelTerms<T> reflection_from_root(T cos_i, T sin2_i, T a, T b) {
  const T before = cos_i - a, after = cos_i + a;
  const T after2 = after * after + b * b;
  // Grazing light where there is no interface: cos θi = q = 0.
  if (after2 == 0) return {0, 0, 0, 0};
  const T rs = (before * before + b * b) / after2;
  const T ac = a * cos_i, bc = b * cos_i;
  const T plus = (ac + sin2_i) * (ac + sin2_i) + bc * bc;
  const T minus = (ac - sin2_i) * (ac - sin2_i) + bc * bc;
  const T scale = rs / plus;
  return {rs, scale * minus, -scale * (ac * ac + bc * bc - sin2_i * sin2_i),
          -scale * 2 * sin2_i * bc};
}

}  // namespace detail

/// cos θt of refraction, to 2 ulp (as below), 0 beyond the critical angle.
template <std::floating_point T>
T refracted_cosine(T cos_i, T eta) {
  const T q2 = detail::squared_root_term(cos_i, eta);
  return q2 > 0 ? std::sqrt(q2) / eta : T(0);
}

/// Reflection at a dielectric of relative index eta, 1e-9…1e9, from either side; total where sin θi
/// > eta. To 8 ulp of 1 or, where that is more, of what half an ulp of cos_i or eta changes: much
/// in front of the critical angle. At cos_i = 0 and eta = 1 nothing.
template <std::floating_point T>
constexpr FresnelTerms<T> fresnel_dielectric(T cos_i, T eta) {
  const T sin2 = (1 - cos_i) * (1 + cos_i);
  const T q2 = detail::squared_root_term(cos_i, eta);
  if (q2 > 0) return detail::reflection_from_root(cos_i, sin2, std::sqrt(q2), T(0));
  return detail::reflection_from_root(cos_i, sin2, T(0), std::sqrt(-q2));
}

/// Reflection at a conductor of relative complex index eta + ik, k ≥ 0; one a channel, all channels
/// at once. To 10 ulp (double: 8) as above where eta² + k² is in 1/16…1e16; below, ratios between 0
/// and 1 without a bound.
template <SpectralValue V>
constexpr FresnelTerms<V> fresnel_conductor(scalar_t<V> cos_i, const V& eta, const V& k) {
  using std::sqrt;
  using T = scalar_t<V>;
  const T cos2 = cos_i * cos_i, sin2 = (1 - cos_i) * (1 + cos_i);
  const V one(T(1)), none(T(0)), c(cos_i), s2(sin2), half(T(0.5));
  // q² = (η + ik)² − sin² θ, q = a + ib; its root by half angles, the larger part first to avoid
  // cancellation.
  const V re = (eta - one) * (eta + one) + V(cos2) - k * k, half_im = eta * k;
  const V modulus = sqrt(re * re + (half_im + half_im) * (half_im + half_im));
  const V larger = sqrt(half * (modulus + where_negative(re, -re, re)));
  const V smaller = where_negative(-larger, half_im / larger, none);
  const V a = where_negative(re, smaller, larger), b = where_negative(re, larger, smaller);
  // R_p and r_s* r_p are taken times cos² to stay finite at grazing incidence.
  const V before = (c - a) * (c - a) + b * b, after = (c + a) * (c + a) + b * b;
  const V ac = a * c, bc = b * c;
  const V plus = (ac + s2) * (ac + s2) + bc * bc, minus = (ac - s2) * (ac - s2) + bc * bc;
  // Nothing is left of grazing light where there is no interface: cos θi = q = 0.
  const V rs = where_negative(-after, before / after, none);
  const V scale = where_negative(-plus, rs / plus, none);
  return {rs, scale * minus, -scale * (ac * ac + bc * bc - s2 * s2), -scale * (s2 + s2) * bc};
}

/// Refraction into a dielectric of relative index eta, 1e-9…1e9: the fractions of power
/// transmitted, to 6 ulp as above. All zero
/// in total reflection and, but for eta = 1, at cos_i = 0.
template <std::floating_point T>
constexpr FresnelTerms<T> fresnel_transmission(T cos_i, T eta) {
  const T q2 = detail::squared_root_term(cos_i, eta);
  constexpr T tiny = T(1e-15);
  if (!(q2 > 0) || !(cos_i > tiny)) {
    // Here q = cos θi, of which the square may be too small for a number.
    if (eta == 1) return {1, 1, 1, 0};
    if (!(q2 > 0) || !(cos_i > 0)) return {0, 0, 0, 0};
  }
  const T q = std::sqrt(q2);
  const T s = 1 / (cos_i + q), p = eta / (eta * eta * cos_i + q);
  const T power = 4 * cos_i * q;
  return {power * s * s, power * p * p, power * s * p, 0};
}

/// The Mueller block of given terms: S1 = Is − Ip, and S3's sign as said above.
template <SpectralValue V, FrameType F>
constexpr BlockMueller<V, incident, exitant, F> fresnel_block(const V& s, const V& p, const V& re,
                                                              const V& im, const F& enter,
                                                              const F& exit) {
  const V half = V(scalar_t<V>(0.5));
  const V sum = half * (s + p), difference = half * (s - p);
  return BlockMueller<V, incident, exitant, F>::block({sum, difference, difference, sum},
                                                      {re, im, -im, re}, enter, exit);
}
template <SpectralValue V, FrameType F>
constexpr BlockMueller<V, incident, exitant, F> fresnel_block(const FresnelTerms<scalar_t<V>>& f,
                                                              const F& enter, const F& exit) {
  return fresnel_block(V(f.s), V(f.p), V(f.re), V(f.im), enter, exit);
}

/// Specular reflection at a dielectric, one index for all channels.
template <SpectralValue V, FrameType F>
constexpr BlockMueller<V, incident, exitant, F> dielectric_reflection(scalar_t<V> cos_i,
                                                                      scalar_t<V> eta,
                                                                      const F& enter,
                                                                      const F& exit) {
  return fresnel_block<V>(fresnel_dielectric(cos_i, eta), enter, exit);
}

/// Refraction into a dielectric, as a ratio of powers. Radiance changes by a further factor η² (n²
/// radiance is conserved).
template <SpectralValue V, FrameType F>
constexpr BlockMueller<V, incident, exitant, F> dielectric_transmission(scalar_t<V> cos_i,
                                                                        scalar_t<V> eta,
                                                                        const F& enter,
                                                                        const F& exit) {
  return fresnel_block<V>(fresnel_transmission(cos_i, eta), enter, exit);
}

/// Specular reflection at a conductor of relative complex index eta + ik, one a channel.
template <SpectralValue V, FrameType F>
constexpr BlockMueller<V, incident, exitant, F> conductor_reflection(scalar_t<V> cos_i,
                                                                     const V& eta, const V& k,
                                                                     const F& enter,
                                                                     const F& exit) {
  const auto f = fresnel_conductor(cos_i, eta, k);
  return fresnel_block(f.s, f.p, f.re, f.im, enter, exit);
}

}  // namespace malus
