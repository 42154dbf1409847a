// SPDX-License-Identifier: MIT
#include "inputs.hpp"

#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>

namespace accuracy {

namespace {

using Complex = std::complex<long double>;
using Direction = std::array<long double, 3>;
using Matrices = std::array<std::array<long double, channels>, 16>;
using Jones = std::array<std::array<Complex, 2>, 2>;

constexpr long double pi = std::numbers::pi_v<long double>;

class Source {
 public:
  Source(bool is_double, std::uint64_t seed) : generator_(seed), is_double_(is_double) {}

  long double uniform(long double from, long double to) {
    return std::uniform_real_distribution<long double>(from, to)(generator_);
  }
  double round(long double value) const {
    return is_double_ ? static_cast<double>(value) : static_cast<double>(static_cast<float>(value));
  }
  /// Rounded, and off by up to one unit in the last place.
  double round_off(long double value) {
    if (value == 0) return 0;
    const int exponent = std::ilogb(value) - (is_double_ ? 52 : 23);
    return round(value + std::ldexp(uniform(-1, 1), exponent));
  }

  /// A frame about a unit direction, x turned from an arbitrary one.
  Axes frame(const Direction& d, long double turn) {
    // Duff et al. 2017, "Building an orthonormal basis, revisited"
    const long double sign = std::copysign(1.0L, d[2]), a = -1 / (sign + d[2]), b = d[0] * d[1] * a;
    const long double u[3] = {1 + sign * d[0] * d[0] * a, sign * b, -sign * d[0]};
    const long double v[3] = {b, sign + d[1] * d[1] * a, -d[1]};
    const long double c = std::cos(turn), s = std::sin(turn);
    Axes axes;
    for (int i = 0; i < 3; ++i) {
      axes.x[i] = round_off(c * u[i] + s * v[i]);
      axes.y[i] = round_off(c * v[i] - s * u[i]);
    }
    return axes;
  }

  Direction direction() {
    const long double z = uniform(-1, 1), r = std::sqrt(1 - z * z);
    const long double phi = uniform(0, 2 * pi);
    return {r * std::cos(phi), r * std::sin(phi), z};
  }

  long double angle_between() {
    const long double any = uniform(0, 2 * pi), kind = uniform(0, 1);
    const long double small = std::pow(10.0L, uniform(-8, -1));
    return kind < 0.5 ? any : kind < 0.75 ? small : pi / 2 + small;
  }

  /// Adds `part` of ½ tr(σᵢ J σⱼ J†), the Mueller matrix of a random Jones matrix.
  void add_matrix(long double part, std::size_t channel, Matrices& rows) {
    static const std::array<Jones, 4> pauli{{{{{1, 0}, {0, 1}}},
                                             {{{1, 0}, {0, -1}}},
                                             {{{0, 1}, {1, 0}}},
                                             {{{0, Complex(0, -1)}, {Complex(0, 1), 0}}}}};
    Jones j;
    for (auto& row : j)
      for (auto& value : row) value = {uniform(-0.7, 0.7), uniform(-0.7, 0.7)};
    for (std::size_t r = 0; r < 4; ++r)
      for (std::size_t c = 0; c < 4; ++c) {
        Complex trace = 0;
        for (std::size_t a = 0; a < 2; ++a)
          for (std::size_t b = 0; b < 2; ++b)
            for (std::size_t e = 0; e < 2; ++e)
              for (std::size_t f = 0; f < 2; ++f)
                trace += pauli[r][a][b] * j[b][e] * pauli[c][e][f] * std::conj(j[a][f]);
        rows[4 * r + c][channel] += part * 0.5L * trace.real();
      }
  }

  void fill_matrix(double (&rounded)[16][channels]) {
    Matrices rows{};
    for (std::size_t c = 0; c < channels; ++c) {
      const long double part = uniform(0.5, 1);
      add_matrix(part, c, rows);
      add_matrix(1 - part, c, rows);
    }
    for (std::size_t i = 0; i < 16; ++i)
      for (std::size_t c = 0; c < channels; ++c) rounded[i][c] = round(rows[i][c]);
  }

  void fill_light(double (&light)[4][channels]) {
    for (std::size_t c = 0; c < channels; ++c) {
      const auto d = direction();
      const long double s0 = uniform(0.1L, 2), degree = uniform(0, 1);
      light[0][c] = round(s0);
      for (std::size_t i = 0; i < 3; ++i) light[i + 1][c] = round(s0 * degree * d[i]);
    }
  }

 private:
  std::mt19937_64 generator_;
  bool is_double_;
};

}  // namespace

std::vector<Operands> random_operands(std::size_t count, bool is_double, std::uint64_t seed) {
  Source source(is_double, seed);
  std::vector<Operands> list(count);
  for (Operands& o : list) {
    const auto d = source.direction();
    const long double turn = source.uniform(0, 2 * pi);
    o.from = source.frame(d, turn);
    o.to = source.frame(d, turn + source.angle_between());
    source.fill_light(o.light);
    source.fill_matrix(o.left);
    source.fill_matrix(o.right);
    o.cosine = source.round(source.uniform(0, 1));
    const long double eta = source.uniform(1.05L, 2.5L);
    o.eta = source.round(source.uniform(0, 1) < 0.5 ? eta : 1 / eta);
    for (std::size_t c = 0; c < channels; ++c) {
      o.metal_eta[c] = source.round(source.uniform(0.05L, 4));
      o.metal_k[c] = source.round(source.uniform(0, 8));
    }
  }
  return list;
}

std::vector<Element> random_chains(std::size_t chains, std::size_t length, bool is_double,
                                   std::uint64_t seed) {
  Source source(is_double, seed);
  std::vector<Element> list;
  for (std::size_t chain = 0; chain < chains; ++chain) {
    const auto d = source.direction();
    for (std::size_t i = 0; i < length; ++i) {
      Element e{};
      const long double turn = source.uniform(0, 2 * pi);
      e.enter = source.frame(d, turn);
      e.exit = source.frame(d, turn);
      for (std::size_t c = 0; c < channels; ++c) {
        const long double phase = source.uniform(0, 2 * pi);
        e.upper[0][c] = e.upper[3][c] = 1;
        e.lower[0][c] = e.lower[3][c] = source.round(std::cos(phase));
        e.lower[1][c] = source.round(std::sin(phase));
        e.lower[2][c] = -e.lower[1][c];
      }
      list.push_back(e);
    }
  }
  return list;
}

}  // namespace accuracy
