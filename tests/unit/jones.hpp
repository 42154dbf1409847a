// SPDX-License-Identifier: MIT
// Jones calculus, written without the library, to check its Mueller matrices against: fields of
// two complex components E(z, t) = Re[(Ex x + Ey y) exp(i(kz - wt))] in a right-handed frame
// (x, y, k).
//
// The sign of S3. Right circular in the receiver's view turns clockwise, from x towards -y as the
// receiver sees the axes: Ex(t) = cos wt, Ey(t) = -sin wt = Re[-i exp(-iwt)], so Ey = -i Ex. That
// shall be S3 = +S0, hence S3 = -2 Im(Ex* Ey). With Phi = E E^+, S_i = Tr(sigma_i Phi), where
// sigma_3 = (0 i; -i 0): Tr = i Ey Ex* - i Ex Ey* = -2 Im(Ex* Ey). E -> J E is Phi -> J Phi J^+,
// and Phi = 1/2 sum S_j sigma_j, so that M_ij = 1/2 Tr(sigma_i J sigma_j J^+).
#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>

namespace jones {

using Complex = std::complex<double>;
using Rows = std::array<std::array<double, 4>, 4>;
using Vector = std::array<Complex, 3>;

struct Field {
  Complex x, y;
};

/// By rows: x' = xx x + xy y, y' = yx x + yy y.
struct Matrix {
  Complex xx, xy, yx, yy;
};

inline Matrix operator*(const Matrix& a, const Matrix& b) {
  return {a.xx * b.xx + a.xy * b.yx, a.xx * b.xy + a.xy * b.yy, a.yx * b.xx + a.yy * b.yx,
          a.yx * b.xy + a.yy * b.yy};
}
inline Matrix operator*(Complex k, const Matrix& a) {
  return {k * a.xx, k * a.xy, k * a.yx, k * a.yy};
}
inline Matrix operator+(const Matrix& a, const Matrix& b) {
  return {a.xx + b.xx, a.xy + b.xy, a.yx + b.yx, a.yy + b.yy};
}
inline Field operator*(const Matrix& a, const Field& e) {
  return {a.xx * e.x + a.xy * e.y, a.yx * e.x + a.yy * e.y};
}
inline Matrix conjugate_transpose(const Matrix& a) {
  return {std::conj(a.xx), std::conj(a.yx), std::conj(a.xy), std::conj(a.yy)};
}
inline Complex trace(const Matrix& a) { return a.xx + a.yy; }

inline Matrix sigma(std::size_t i) {
  constexpr Complex j(0, 1);
  const Matrix all[4] = {{1, 0, 0, 1}, {1, 0, 0, -1}, {0, 1, 1, 0}, {0, j, -j, 0}};
  return all[i];
}

inline std::array<double, 4> stokes(const Field& e) {
  const Complex z = std::conj(e.x) * e.y;
  return {std::norm(e.x) + std::norm(e.y), std::norm(e.x) - std::norm(e.y), 2 * z.real(),
          -2 * z.imag()};
}

inline Rows mueller(const Matrix& j, double transmittance = 1) {
  Rows m{};
  for (std::size_t r = 0; r < 4; ++r)
    for (std::size_t c = 0; c < 4; ++c)
      m[r][c] =
          0.5 * transmittance * trace(sigma(r) * j * sigma(c) * conjugate_transpose(j)).real();
  return m;
}

/// The projection on the field (cos theta, sin theta).
inline Matrix polarizer(double theta) {
  const double c = std::cos(theta), s = std::sin(theta);
  return {c * c, c * s, s * c, s * s};
}

/// What is polarised across the fast axis comes `phase` later: exp(-iw(t - dt)) is a factor
/// exp(+i phase).
inline Matrix retarder(double theta, double phase) {
  return polarizer(theta) + std::polar(1.0, phase) * polarizer(theta + std::acos(-1.0) / 2);
}

/// The projection on the polarisation of the unit Stokes vector (1, n).
inline Matrix projector(const std::array<double, 3>& n) {
  return Complex(0.5) * (sigma(0) + Complex(n[0]) * sigma(1) + Complex(n[1]) * sigma(2) +
                         Complex(n[2]) * sigma(3));
}
inline std::array<double, 3> opposite(const std::array<double, 3>& n) {
  return {-n[0], -n[1], -n[2]};
}

/// Turns the field counter-clockwise by an angle.
inline Matrix rotator(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c, -s, s, c};
}

/// Components in a frame turned counter-clockwise by an angle.
inline Matrix turned_frame(double angle) { return rotator(-angle); }

// a plane interface, from Maxwell's boundary conditions alone

struct Amplitudes {
  Complex rs, rp, ts, tp;
  Complex root;  // k_t's normal component over the wave number before the interface
};

inline Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// i + r·reflected = t·transmitted of a tangential component of E (a) and of one of H (b).
inline void solve_boundary(const std::array<Complex, 3>& a, const std::array<Complex, 3>& b,
                           Complex& r, Complex& t) {
  const Complex determinant = a[2] * b[1] - a[1] * b[2];
  r = (a[0] * b[2] - a[2] * b[0]) / determinant;
  t = (a[0] * b[1] - a[1] * b[0]) / determinant;
}

/// Amplitudes in the frames (s, p = k × s, k) with a common s at an interface to a relative index
/// n + ik: E and H (along k × E) are continuous along the interface z = 0; the incident wave goes
/// to +z, and what is behind the interface decays there.
inline Amplitudes interface(double cos_i, Complex index) {
  const double sin_i = std::sqrt((1 - cos_i) * (1 + cos_i));
  Complex q = std::sqrt(index * index - sin_i * sin_i);
  if (q.imag() < 0 || (q.imag() == 0 && q.real() < 0)) q = -q;
  const Vector s = {0, 1, 0};
  const Vector wave[3] = {{sin_i, 0, cos_i}, {sin_i, 0, -cos_i}, {sin_i, 0, q}};
  std::array<Complex, 3> s_electric, s_magnetic, p_electric, p_magnetic;
  for (std::size_t w = 0; w < 3; ++w) {
    Vector p = cross(wave[w], s);
    if (w == 2)
      for (Complex& component : p) component /= index;
    s_electric[w] = s[1];
    s_magnetic[w] = cross(wave[w], s)[0];
    p_electric[w] = p[0];
    p_magnetic[w] = cross(wave[w], p)[1];
  }
  Amplitudes a;
  solve_boundary(s_electric, s_magnetic, a.rs, a.ts);
  solve_boundary(p_electric, p_magnetic, a.rp, a.tp);
  a.root = q;
  return a;
}

inline Rows reflection(double cos_i, Complex index) {
  const Amplitudes a = interface(cos_i, index);
  return mueller({a.rs, 0, 0, a.rp});
}

/// Power, not field: times the ratio of both sides' power per area of the interface.
inline Rows transmission(double cos_i, double eta) {
  const Amplitudes a = interface(cos_i, eta);
  return mueller({a.ts, 0, 0, a.tp}, a.root.real() / cos_i);
}

}  // namespace jones
