// SPDX-License-Identifier: MIT
#include "chain.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include <malus/malus.hpp>

namespace stability {

namespace {

using Exact = long double;
using Complex = std::complex<long double>;
using Stokes = std::array<Exact, 4>;
using Rows = std::array<std::array<Exact, 4>, 4>;

/// splitmix64: small, fast and good enough for parameters.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  double unit() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }
  double between(double low, double high) { return low + (high - low) * unit(); }

 private:
  std::uint64_t state_;
};

using Double3 = glm::dvec3;

Double3 random_direction(Random& random) {
  const double z = random.between(-1, 1), phi = random.between(0, 2 * std::numbers::pi);
  const double r = std::sqrt((1 - z) * (1 + z));
  return {r * std::cos(phi), r * std::sin(phi), z};
}

template <class T>
malus::Frame<T> random_frame(const Double3& direction, Random& random) {
  const auto f = malus::Frame<double>::about(direction);
  const double angle = random.between(0, 2 * std::numbers::pi);
  const double c = std::cos(angle), s = std::sin(angle);
  const Double3 x = c * f.x() + s * f.y(), y = c * f.y() - s * f.x();
  return {glm::vec<3, T>(x), glm::vec<3, T>(y)};
}

template <class T>
Exact dot(const glm::vec<3, T>& a, const glm::vec<3, T>& b) {
  return static_cast<Exact>(a.x) * b.x + static_cast<Exact>(a.y) * b.y +
         static_cast<Exact>(a.z) * b.z;
}

template <class T>
void turn(const malus::Frame<T>& from, const malus::Frame<T>& to, Stokes& s) {
  const Exact c = dot(from.x(), to.x()), d = dot(from.y(), to.x()), n = c * c + d * d;
  const Exact cos2 = (c * c - d * d) / n, sin2 = 2 * c * d / n, s1 = s[1];
  s[1] = cos2 * s1 + sin2 * s[2];
  s[2] = cos2 * s[2] - sin2 * s1;
}

void apply(const Rows& m, Stokes& s) {
  const Stokes before = s;
  for (std::size_t r = 0; r < 4; ++r) {
    s[r] = 0;
    for (std::size_t k = 0; k < 4; ++k) s[r] += m[r][k] * before[k];
  }
}
Rows block(Exact a, Exact b, Exact c, Exact d, Exact e, Exact f) {
  return {{{a, b, 0, 0}, {b, c, 0, 0}, {0, 0, d, f}, {0, 0, -f, e}}};
}

/// The light of both sides and what is between an element's frames.
template <class T>
class Walk {
 public:
  Walk(std::uint64_t seed) : random_(seed) {
    direction_ = random_direction(random_);
    frame_ = random_frame<T>(direction_, random_);
    // Fully polarised: what rounding adds is unphysical at once.
    const Double3 p = random_direction(random_);
    const std::array<T, 3> s{static_cast<T>(p.x), static_cast<T>(p.y), static_cast<T>(p.z)};
    light_ = {T(1), s[0], s[1], s[2], frame_};
    exact_ = {1, s[0], s[1], s[2]};
  }

  void step(Kind kind) {
    switch (kind) {
      case Kind::rotations:
      case Kind::undivided:
        rotate(kind == Kind::rotations);
        break;
      case Kind::retarders:
        retard();
        break;
      case Kind::fresnel:
        reflect();
        break;
      case Kind::rayleigh:
        scatter();
        break;
      default:
        pass_full();
        break;
    }
    // By powers of two, which are exact: absorption must not end in subnormal numbers.
    if (exact_[0] < 0x1p-20L || exact_[0] > 0x1p20L) {
      const int exponent = -std::ilogb(exact_[0]);
      light_ *= static_cast<T>(std::ldexp(1.0, exponent));
      for (Exact& x : exact_) x = std::ldexp(x, exponent);
    }
  }

  Stokes light() const { return {light_[0], light_[1], light_[2], light_[3]}; }
  const Stokes& exact() const { return exact_; }

 private:
  T number(double low, double high) { return static_cast<T>(random_.between(low, high)); }

  void rotate(bool divided) {
    const auto to = random_frame<T>(direction_, random_);
    if (divided) {
      light_ = light_.expressed_in(to);
    } else {
      const T c = glm::dot(frame_.x(), to.x()), s = glm::dot(frame_.y(), to.x());
      light_ = light_.expressed_in(to, {(c - s) * (c + s), 2 * c * s});
    }
    turn(frame_, to, exact_);
    frame_ = to;
  }

  /// Into the matrix's enter frame, through it and on in its exit frame, in a new direction.
  template <class M>
  void pass(const M& matrix, const malus::Frame<T>& enter, const malus::Frame<T>& exit,
            const Rows& rows) {
    light_ = matrix * propagate(light_);
    turn(frame_, enter, exact_);
    apply(rows, exact_);
    frame_ = exit;
  }
  malus::Frame<T> enter_frame() { return random_frame<T>(direction_, random_); }
  malus::Frame<T> exit_frame() {
    direction_ = random_direction(random_);
    return random_frame<T>(direction_, random_);
  }

  void retard() {
    const auto frame = enter_frame();
    const T phase = number(0, 2 * std::numbers::pi);
    const Exact c = std::cos(static_cast<Exact>(phase)), s = std::sin(static_cast<Exact>(phase));
    pass(malus::linear_retarder(T(1), phase, frame), frame, frame, block(1, 0, 1, c, c, s));
  }

  void reflect() {
    const auto enter = enter_frame(), exit = exit_frame();
    const T cosine = number(0.05, 1), denser = number(1.1, 3);
    // An index of 1 would reflect nothing.
    const T eta = random_.unit() < 0.5 ? denser : 1 / denser;
    const bool metal = random_.unit() < 0.5;
    const T k = metal ? number(0.5, 6) : T(0);
    const Exact c = cosine;
    const Complex n(eta, k);
    Complex q = std::sqrt((n - 1.0L) * (n + 1.0L) + c * c);
    if (q.imag() < 0) q = -q;
    const Complex s = (c - q) / (c + q), p = (n * n * c - q) / (n * n * c + q);
    const Exact rs = std::norm(s), rp = std::norm(p);
    const Complex both = std::conj(s) * p;
    const Exact sum = (rs + rp) / 2, difference = (rs - rp) / 2;
    const Rows rows = block(sum, difference, sum, both.real(), both.real(), both.imag());
    if (metal)
      pass(malus::conductor_reflection(cosine, eta, k, enter, exit), enter, exit, rows);
    else
      pass(malus::dielectric_reflection<T>(cosine, eta, enter, exit), enter, exit, rows);
  }

  void scatter() {
    const auto enter = enter_frame(), exit = exit_frame();
    const T rho = number(0, 0.3), cosine = number(-1, 1);
    const Exact r = rho, m = cosine, d = (1 - r) / (1 + r / 2), dc = (1 - 2 * r) / (1 + r / 2);
    const Exact linear = 0.75L * d * (1 + m * m);
    pass(malus::scattering_matrix(malus::RayleighScattering<T>(rho).elements(cosine), enter, exit),
         enter, exit,
         block(linear + 1 - d, -0.75L * d * (1 - m) * (1 + m), linear, 1.5L * d * m, 1.5L * dc * m,
               0));
  }

  void pass_full() {
    const auto frame = enter_frame(), exit = exit_frame();
    const T phase = number(0, 2 * std::numbers::pi), weak = number(0.8, 1);
    const Double3 v = random_direction(random_),
                  w = random_.between(0, 0.5) * random_direction(random_);
    const std::array<T, 3> fast{static_cast<T>(v.x), static_cast<T>(v.y), static_cast<T>(v.z)};
    const std::array<T, 3> dichroic{static_cast<T>(w.x), static_cast<T>(w.y), static_cast<T>(w.z)};
    struct Own;
    const malus::StaticFrame<Own> own;
    const auto matrix = malus::partial_depolarizer<T, malus::StaticFrame<Own>>(T(1), weak) *
                        propagate(malus::elliptical_retarder(T(1), fast, phase, own) *
                                  propagate(malus::elliptical_diattenuator(T(1), dichroic, own)));
    // The matrix is rounded before it is met; that is an error of its making, not of the chain's.
    Rows rows;
    std::array<std::array<T, 4>, 4> values;
    for (std::size_t r = 0; r < 4; ++r)
      for (std::size_t c = 0; c < 4; ++c)
        rows[r][c] = values[r][c] = matrix(static_cast<int>(r), static_cast<int>(c));
    pass(malus::FullMueller<T>::from_rows(values, frame, exit), frame, exit, rows);
  }

  Random random_;
  Double3 direction_;
  malus::Frame<T> frame_;
  malus::Stokes<T> light_;
  Stokes exact_;
};

Exact degree(const Stokes& s) { return std::sqrt(s[1] * s[1] + s[2] * s[2] + s[3] * s[3]) / s[0]; }

template <class T>
Chain run(Kind kind, std::uint64_t length, std::uint64_t seed) {
  Chain chain;
  Walk<T> walk(seed);
  const auto looks = checkpoints(length);
  for (std::uint64_t n = 1; n <= length; ++n) {
    walk.step(kind);
    const Stokes light = walk.light();
    const Exact reached = degree(light);
    ++chain.states;
    if (!std::isfinite(reached)) ++chain.not_finite;
    if (light[0] < 0) ++chain.negative;
    if (reached > 1) ++chain.beyond_one;
    chain.largest_degree = std::max(chain.largest_degree, static_cast<double>(reached));
    if (n != looks[chain.error.size()]) continue;
    Exact worst = 0;
    for (std::size_t i = 0; i < 4; ++i)
      worst = std::max(worst, std::abs(light[i] - walk.exact()[i]));
    chain.error.push_back({static_cast<double>(worst / walk.exact()[0]),
                           static_cast<double>(reached / degree(walk.exact()) - 1)});
    if (chain.error.size() == looks.size()) break;
  }
  return chain;
}

}  // namespace

std::vector<std::uint64_t> checkpoints(std::uint64_t length) {
  std::vector<std::uint64_t> list;
  for (int half = 2;; ++half) {
    const auto n = static_cast<std::uint64_t>(std::llround(std::pow(10.0, half / 2.0)));
    if (n > length) return list;
    list.push_back(n);
  }
}

Chain run_chain(Kind kind, bool is_double, std::uint64_t length, std::uint64_t seed) {
  return is_double ? run<double>(kind, length, seed) : run<float>(kind, length, seed);
}

}  // namespace stability
