// SPDX-License-Identifier: MIT
// Scattering by a homogeneous sphere of any size: Lorenz and Mie's solution (Bohren & Huffman 1983,
// Absorption and Scattering of Light by Small Particles, chapter 4), by Wiscombe's algorithms
// (1980, "Improved Mie scattering algorithms", Applied Optics 19, 1505). In double precision.
//
// Fields exp(−iωt) and a relative index n + ik, k ≥ 0, as everywhere in Malus; with exp(+iωt) and n
// − ik, as Wiscombe has it, indices and amplitudes are conjugate. Elements and the signs of
// amplitudes are those of optics/scattering_matrix.hpp.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <span>
#include <vector>

#include <malus/optics/scattering_matrix.hpp>

namespace malus {

/// S1 across the scattering plane and S2 parallel to it: with the wave number k, the scattered
/// intensity is |S|²/(kr)² at a distance r.
struct MieAmplitudes {
  std::complex<double> s1, s2;
};

/// A sphere with the coefficients a_n, b_n of its series.
class MieSphere {
 public:
  using Complex = std::complex<double>;

  /// `size` is the circumference over the wavelength outside, x = 2πr/λ > 0; `index` that of the
  /// sphere over that of what surrounds it, n + ik with n > 0, k ≥ 0.
  MieSphere(double size, Complex index) : size_(size) {
    find_coefficients(index);
    find_efficiencies();
  }

  double size() const { return size_; }
  /// How many terms the series has.
  std::size_t terms() const { return terms_.size(); }

  // Cross-sections over the geometric one, πr²

  double extinction() const { return extinction_; }
  double scattering() const { return scattering_; }
  /// The mean of cos Θ of what is scattered.
  double asymmetry() const { return asymmetry_; }

  /// At an angle between the directions of propagation before and after, of this cosine.
  MieAmplitudes amplitudes(double cosine) const {
    MieAmplitudes sum{};
    double pi = 1, before = 0;
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      const double n = static_cast<double>(i + 1), s = cosine * pi, t = s - before;
      const double tau = n * t - before, factor = (2 * n + 1) / (n * (n + 1));
      sum.s1 += factor * (terms_[i].a * pi + terms_[i].b * tau);
      sum.s2 += factor * (terms_[i].a * tau + terms_[i].b * pi);
      before = pi;
      pi = s + (n + 1) / n * t;
    }
    return sum;
  }

  /// The phase matrix there, normalised: the mean of a1 over the sphere is 1.
  ScatteringElements<double> elements(double cosine) const {
    const auto [s1, s2] = amplitudes(cosine);
    return scattering_elements(s1, s2) * normalization();
  }

  /// Adds `weight` times the elements of the amplitudes at many angles, not normalised. Much faster
  /// than one angle after the other.
  void add_elements(std::span<const double> cosines, double weight,
                    std::span<ScatteringElements<double>> sums) const {
    for (std::size_t first = 0; first < cosines.size(); first += block) {
      const std::size_t count = std::min(block, cosines.size() - first);
      add_block(cosines.subspan(first, count), weight, sums.subspan(first, count));
    }
  }

  /// What makes the mean of a1 over the sphere 1.
  double normalization() const { return scattering_ > 0 ? 4 / (size_ * size_ * scattering_) : 0.0; }

 private:
  struct Term {
    Complex a, b;
  };
  static constexpr std::size_t block = 64;

  /// Wiscombe's number of terms and two more, without which small spheres lose a ten-millionth at
  /// right angles, where the first term gives S2 nothing.
  static std::size_t count_of_terms(double x) {
    const double root = std::cbrt(x);
    const double n = x <= 8 ? x + 4 * root + 1 : x < 4200 ? x + 4.05 * root + 2 : x + 4 * root + 2;
    return static_cast<std::size_t>(n) + 2;
  }

  /// The logarithmic derivatives ψ_n'(z)/ψ_n(z), n = 1 … count, by recurrence downward. It forgets
  /// a wrong start only where n is well above |z|; the transition is some |z|^⅓ wide.
  static std::vector<Complex> logarithmic_derivatives(Complex z, std::size_t count) {
    const double size = std::abs(z);
    const auto above = static_cast<std::size_t>(size + 8 * std::cbrt(size)) + 16;
    std::vector<Complex> d(count + 1);
    Complex at = 0;
    for (std::size_t n = std::max(count, above) + 1; n > 1; --n) {
      const Complex ratio = static_cast<double>(n) / z;
      at = ratio - 1.0 / (at + ratio);
      if (n - 1 <= count) d[n - 1] = at;
    }
    return d;
  }

  /// The Riccati–Bessel functions ψ_n(x), n = 0 … count: upward where they oscillate, n < x, and
  /// beyond, where they fall and rounding would grow, by the ratios ψ_{n−1}/ψ_n from above.
  static std::vector<double> riccati_bessel(double x, std::size_t count) {
    std::vector<double> psi(count + 1);
    psi[0] = std::sin(x);
    std::size_t n = 1;
    for (double before = std::cos(x); n <= count && static_cast<double>(n) < x; ++n) {
      psi[n] = (2 * static_cast<double>(n) - 1) / x * psi[n - 1] - before;
      before = psi[n - 1];
    }
    double ratio = (2 * static_cast<double>(count) + 31) / x;
    std::vector<double> ratios(count + 1);
    for (std::size_t i = count + 14; i >= n; --i) {
      ratio = (2 * static_cast<double>(i) + 1) / x - 1 / ratio;
      if (i <= count) ratios[i] = ratio;
    }
    for (; n <= count; ++n) psi[n] = psi[n - 1] / ratios[n];
    return psi;
  }

  /// Bohren & Huffman, eq. 4.88, with ξ_n = ψ_n − iχ_n. Numerators and denominators' real parts are
  /// the same: where the index is real, Re a = |a|² to rounding, however small the sphere.
  void find_coefficients(Complex index) {
    const std::size_t count = count_of_terms(size_);
    const std::vector<Complex> d = logarithmic_derivatives(index * size_, count);
    const std::vector<double> psi = riccati_bessel(size_, count);
    terms_.resize(count);
    double chi_before = std::cos(size_), chi = std::cos(size_) / size_ + std::sin(size_);
    for (std::size_t i = 1; i <= count; ++i) {
      const double n = static_cast<double>(i);
      const auto coefficient = [&](const Complex& t) {
        const Complex p = t * psi[i] - psi[i - 1], q = t * chi - chi_before;
        // p/(p − iq), of which |p − iq|² may be beyond double's range.
        return p / Complex(p.real() + q.imag(), p.imag() - q.real());
      };
      terms_[i - 1] = {coefficient(d[i] / index + n / size_),
                       coefficient(d[i] * index + n / size_)};
      const double next = (2 * n + 1) / size_ * chi - chi_before;
      chi_before = chi;
      chi = next;
    }
  }

  /// Bohren & Huffman, eqs. 4.61, 4.62 and section 4.5.
  void find_efficiencies() {
    double extinguished = 0, scattered = 0, forward = 0;
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      const double n = static_cast<double>(i + 1);
      const auto [a, b] = terms_[i];
      extinguished += (2 * n + 1) * (a + b).real();
      scattered += (2 * n + 1) * (std::norm(a) + std::norm(b));
      forward += (2 * n + 1) / (n * (n + 1)) * (a * std::conj(b)).real();
      if (i + 1 < terms_.size()) {
        const Term& next = terms_[i + 1];
        forward += n * (n + 2) / (n + 1) * (a * std::conj(next.a) + b * std::conj(next.b)).real();
      }
    }
    const double scale = 2 / (size_ * size_);
    extinction_ = scale * extinguished;
    scattering_ = scale * scattered;
    asymmetry_ = scattered > 0 ? 2 * forward / scattered : 0;
  }

  /// By the sums S1 ± S2 = Σ (a ± b)(π ± τ), whose terms take the fewest operations.
  void add_block(std::span<const double> cosines, double weight,
                 std::span<ScatteringElements<double>> sums) const {
    std::array<double, block> mu{}, pi{}, before{}, plus_re{}, plus_im{}, minus_re{}, minus_im{};
    std::copy(cosines.begin(), cosines.end(), mu.begin());
    pi.fill(1);
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      const double n = static_cast<double>(i + 1), ratio = (n + 1) / n;
      const double factor = (2 * n + 1) / (n * (n + 1));
      const Complex p = factor * (terms_[i].a + terms_[i].b);
      const Complex m = factor * (terms_[i].a - terms_[i].b);
      const double pr = p.real(), pj = p.imag(), mr = m.real(), mj = m.imag();
      for (std::size_t j = 0; j < block; ++j) {
        const double s = mu[j] * pi[j], t = s - before[j], tau = n * t - before[j];
        const double sum = pi[j] + tau, difference = pi[j] - tau;
        plus_re[j] += pr * sum;
        plus_im[j] += pj * sum;
        minus_re[j] += mr * difference;
        minus_im[j] += mj * difference;
        before[j] = pi[j];
        pi[j] = s + ratio * t;
      }
    }
    for (std::size_t j = 0; j < cosines.size(); ++j) {
      const Complex p(plus_re[j], plus_im[j]), m(minus_re[j], minus_im[j]);
      sums[j] += scattering_elements(0.5 * (p + m), 0.5 * (p - m)) * weight;
    }
  }

  double size_;
  std::vector<Term> terms_;
  double extinction_ = 0, scattering_ = 0, asymmetry_ = 0;
};

}  // namespace malus
