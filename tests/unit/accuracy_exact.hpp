// SPDX-License-Identifier: MIT
// What the accuracy of optical elements, media, rough surfaces and spheres is measured against, in
// long double: matrices and their exponential, the formulas of facets, Mie's series.
#pragma once

#include "unit/accuracy_support.hpp"

namespace accuracy_test {

using Rows = std::array<std::array<Exact, 4>, 4>;

inline std::array<Exact, 16> flat(const Rows& m, Exact factor = 1) {
  std::array<Exact, 16> out;
  for (std::size_t i = 0; i < 16; ++i) out[i] = factor * m[i / 4][i % 4];
  return out;
}
template <class M>
auto flat(const M& m) {
  std::array<typename M::scalar_type, 16> out;
  for (int i = 0; i < 16; ++i) out[static_cast<std::size_t>(i)] = m(i / 4, i % 4);
  return out;
}
inline Rows multiply(const Rows& a, const Rows& b) {
  Rows out{};
  for (std::size_t r = 0; r < 4; ++r)
    for (std::size_t c = 0; c < 4; ++c)
      for (std::size_t k = 0; k < 4; ++k) out[r][c] += a[r][k] * b[k][c];
  return out;
}

template <class T, std::size_t N>
double ulps(const std::array<T, N>& got, const std::array<Exact, N>& exact, Exact scale) {
  Exact worst = 0;
  for (std::size_t i = 0; i < N; ++i)
    worst = std::max(worst, std::abs(static_cast<Exact>(got[i]) - exact[i]));
  return static_cast<double>(worst / (scale * last_place<T>(1)));
}
template <class T, std::size_t N>
bool are_numbers(const std::array<T, N>& values) {
  for (const T x : values)
    if (!is_number(x)) return false;
  return true;
}

/// exp(−K l) by its series at a small stretch, squared again and again.
inline Rows exponential(const Rows& k) {
  constexpr int halvings = 6;
  Rows step = k, sum{}, power{};
  for (std::size_t i = 0; i < 4; ++i) sum[i][i] = power[i][i] = 1;
  for (auto& row : step)
    for (Exact& x : row) x = std::ldexp(x, -halvings);
  for (int n = 1; n < 50; ++n) {
    power = multiply(power, step);
    for (std::size_t r = 0; r < 4; ++r)
      for (std::size_t c = 0; c < 4; ++c) {
        power[r][c] /= -n;
        sum[r][c] += power[r][c];
      }
  }
  for (int i = 0; i < halvings; ++i) sum = multiply(sum, sum);
  return sum;
}

/// Of facets: Walter et al.'s formulas as they are printed.
struct Facets {
  bool ggx;
  Exact ax, ay;

  Exact density(const std::array<Exact, 3>& m) const {
    const Exact n2 = m[0] * m[0] + m[1] * m[1] + m[2] * m[2];
    const Exact x = m[0] / m[2] / ax, y = m[1] / m[2] / ay, slopes = x * x + y * y;
    const Exact c2 = m[2] * m[2] / n2;
    const Exact shape = ggx ? 1 / ((1 + slopes) * (1 + slopes)) : std::exp(-slopes);
    return shape / (pi * ax * ay * c2 * c2);
  }
  Exact masking(const std::array<Exact, 3>& v) const {
    const Exact tan2 = (ax * ax * v[0] * v[0] + ay * ay * v[1] * v[1]) / (v[2] * v[2]);
    if (ggx) return 2 / (1 + std::sqrt(1 + tan2));
    if (tan2 == 0) return 1;
    const Exact a = 1 / std::sqrt(tan2);
    return 2 * a / (a * (1 + std::erf(a)) + std::exp(-a * a) / std::sqrt(pi));
  }
};

/// The series with long double's coefficients: ψ downward from far above, normalised by
/// Σ (2n + 1) ψ²/x² = 1, χ upward, the logarithmic derivative downward.
struct ExactSphere {
  Exact size;
  std::vector<Complex> a, b;

  ExactSphere(Exact x, Complex index) : size(x) {
    const auto count = static_cast<std::size_t>(x + 6 * std::cbrt(x)) + 8;
    const std::size_t start = count + 60 + static_cast<std::size_t>(std::abs(index) * x);
    std::vector<Exact> psi(start + 2);
    psi[start] = 1e-2000L;
    std::vector<Complex> d(start + 2);
    for (std::size_t n = start; n > 0; --n) {
      const Exact order = static_cast<Exact>(n);
      psi[n - 1] = (2 * order + 1) / x * psi[n] - psi[n + 1];
      d[n - 1] = order / (index * x) - 1.0L / (d[n] + order / (index * x));
    }
    Exact norm = 0;
    for (std::size_t n = 0; n <= start; ++n) {
      const Exact part = psi[n] / psi[0];
      norm += (2 * static_cast<Exact>(n) + 1) * part * part;
    }
    const Exact scale = std::copysign(x / std::sqrt(norm), std::sin(x)) / psi[0];
    Exact before = -std::sin(x), chi = std::cos(x);
    for (std::size_t i = 1; i <= count; ++i) {
      const Exact n = static_cast<Exact>(i), next = (2 * n - 1) / x * chi - before;
      before = chi, chi = next;
      const Complex xi(scale * psi[i], -chi), xi_before(scale * psi[i - 1], -before);
      const Complex p = d[i] / index + n / x, q = d[i] * index + n / x;
      a.push_back((p * scale * psi[i] - scale * psi[i - 1]) / (p * xi - xi_before));
      b.push_back((q * scale * psi[i] - scale * psi[i - 1]) / (q * xi - xi_before));
    }
  }
  Exact extinction() const {
    Exact sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
      sum += static_cast<Exact>(2 * i + 3) * (a[i] + b[i]).real();
    return 2 * sum / (size * size);
  }
  Exact scattering() const {
    Exact sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
      sum += static_cast<Exact>(2 * i + 3) * (std::norm(a[i]) + std::norm(b[i]));
    return 2 * sum / (size * size);
  }
  std::array<Complex, 2> amplitudes(Exact cosine) const {
    Complex s1 = 0, s2 = 0;
    Exact now = 1, before = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const Exact n = static_cast<Exact>(i + 1), tau = n * cosine * now - (n + 1) * before;
      const Exact factor = (2 * n + 1) / (n * (n + 1));
      s1 += factor * (a[i] * now + b[i] * tau);
      s2 += factor * (a[i] * tau + b[i] * now);
      const Exact next = ((2 * n + 1) * cosine * now - (n + 1) * before) / n;
      before = now, now = next;
    }
    return {s1, s2};
  }
};

}  // namespace accuracy_test
