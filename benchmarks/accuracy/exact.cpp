// SPDX-License-Identifier: MIT
#include "exact.hpp"

#include <array>
#include <cmath>

namespace accuracy {

namespace {

/// One step of Newton's from long double's root doubles its digits.
Exact square_root(Exact value) {
  if (!(value > 0)) return 0;
  const Exact root = static_cast<Exact>(std::sqrt(static_cast<long double>(value)));
  return (root + value / root) / 2;
}

struct Complex {
  Exact re = 0, im = 0;

  friend Complex operator+(Complex a, Complex b) { return {a.re + b.re, a.im + b.im}; }
  friend Complex operator-(Complex a, Complex b) { return {a.re - b.re, a.im - b.im}; }
  friend Complex operator*(Complex a, Complex b) {
    return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
  }
  friend Complex operator/(Complex a, Complex b) {
    const Exact n = b.re * b.re + b.im * b.im;
    return {(a.re * b.re + a.im * b.im) / n, (a.im * b.re - a.re * b.im) / n};
  }
  Complex conjugate() const { return {re, -im}; }
};

/// The root in the upper half plane.
Complex square_root(Complex z) {
  const Exact modulus = square_root(z.re * z.re + z.im * z.im);
  const Exact re = square_root((modulus + z.re) / 2), im = square_root((modulus - z.re) / 2);
  return {z.im < 0 ? -re : re, im};
}

struct Turn {
  Exact cos2, sin2;
};

Exact dot(const double (&a)[3], const double (&b)[3]) {
  Exact sum = 0;
  for (int i = 0; i < 3; ++i) sum += static_cast<Exact>(a[i]) * static_cast<Exact>(b[i]);
  return sum;
}

Turn turn_between(const Axes& from, const Axes& to) {
  const Exact c = dot(from.x, to.x), s = dot(from.y, to.x), n = c * c + s * s;
  return {(c * c - s * s) / n, 2 * c * s / n};
}

using Stokes = std::array<Exact, 4>;
using Matrix = std::array<Stokes, 4>;

Stokes turned(const Turn& t, const Stokes& s) {
  return {s[0], t.cos2 * s[1] + t.sin2 * s[2], t.cos2 * s[2] - t.sin2 * s[1], s[3]};
}

Stokes operator*(const Matrix& m, const Stokes& s) {
  Stokes result{};
  for (std::size_t r = 0; r < 4; ++r)
    for (std::size_t k = 0; k < 4; ++k) result[r] += m[r][k] * s[k];
  return result;
}

Matrix matrix_of(const double (&rows)[16][channels], std::size_t channel) {
  Matrix m;
  for (std::size_t i = 0; i < 16; ++i) m[i / 4][i % 4] = static_cast<Exact>(rows[i][channel]);
  return m;
}

Stokes light_of(const Operands& o, std::size_t channel) {
  Stokes s;
  for (std::size_t i = 0; i < 4; ++i) s[i] = static_cast<Exact>(o.light[i][channel]);
  return s;
}

/// left · R · right, column by column.
Matrix product(const Matrix& left, const Turn& t, const Matrix& right) {
  Matrix result;
  for (std::size_t c = 0; c < 4; ++c) {
    const Stokes column =
        left * turned(t, Stokes{right[0][c], right[1][c], right[2][c], right[3][c]});
    for (std::size_t r = 0; r < 4; ++r) result[r][c] = column[r];
  }
  return result;
}

/// m00 m01 m10 m11 m22 m23 m32 m33 of a reflection, by the amplitudes in Verdet's signs.
std::array<Exact, 8> fresnel(double cosine, Complex eta) {
  const Complex c{static_cast<Exact>(cosine), 0}, eta2 = eta * eta;
  const Complex q = square_root(eta2 - Complex{1, 0} + c * c);
  const Complex s = (c - q) / (c + q), p = (eta2 * c - q) / (eta2 * c + q);
  const Exact rs = (s * s.conjugate()).re, rp = (p * p.conjugate()).re;
  const Complex both = s.conjugate() * p;
  const Exact sum = (rs + rp) / 2, difference = (rs - rp) / 2;
  return {sum, difference, difference, sum, both.re, both.im, -both.im, both.re};
}

Stokes through_chain(const Operands& o, std::size_t channel, const Element* elements,
                     std::size_t length) {
  Stokes s = light_of(o, channel);
  for (std::size_t i = 0; i < length; ++i) {
    const Element& e = elements[i];
    // The first is entered in its own frame, whose axes are off by rounding, too.
    s = turned(turn_between(i > 0 ? elements[i - 1].exit : e.enter, e.enter), s);
    Matrix m{};
    for (std::size_t k = 0; k < 4; ++k) {
      m[k / 2][k % 2] = static_cast<Exact>(e.upper[k][channel]);
      m[2 + k / 2][2 + k % 2] = static_cast<Exact>(e.lower[k][channel]);
    }
    s = m * s;
  }
  return s;
}

}  // namespace

std::vector<Exact> compute_exactly(Operation operation, const Operands& o, const Element* elements,
                                   std::size_t chain_length) {
  std::vector<Exact> out(result_count(operation));
  const Turn turn = turn_between(o.from, o.to);
  if (operation == Operation::coefficients) return {turn.cos2, turn.sin2};
  for (std::size_t c = 0; c < channels; ++c) {
    const auto put = [&](const auto& values) {
      for (std::size_t i = 0; i < values.size(); ++i) out[channels * i + c] = values[i];
    };
    switch (operation) {
      case Operation::rotate_stokes:
        put(turned(turn, light_of(o, c)));
        break;
      case Operation::mueller_stokes:
        put(matrix_of(o.left, c) * turned(turn, light_of(o, c)));
        break;
      case Operation::mueller_mueller: {
        const Matrix m = product(matrix_of(o.left, c), turn, matrix_of(o.right, c));
        for (std::size_t i = 0; i < 16; ++i) out[channels * i + c] = m[i / 4][i % 4];
        break;
      }
      case Operation::dielectric:
        put(fresnel(o.cosine, {static_cast<Exact>(o.eta), 0}));
        break;
      case Operation::conductor:
        put(fresnel(o.cosine,
                    {static_cast<Exact>(o.metal_eta[c]), static_cast<Exact>(o.metal_k[c])}));
        break;
      default:
        put(through_chain(o, c, elements, chain_length));
        break;
    }
  }
  return out;
}

}  // namespace accuracy
