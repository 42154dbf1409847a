// SPDX-License-Identifier: MIT
// Long chains of rotations against long double: errors add up like a random walk, and the degree of
// polarisation does not drift. (benchmarks/stability has more of them, and the law of growth.)
#include <malus/malus.hpp>

#include "unit/accuracy_support.hpp"

namespace {

using namespace accuracy_test;

struct Errors {
  Exact worst = 0;  ///< of a component, root of the mean square over chains
  Exact drift = 0;  ///< of the degree of polarisation, mean over chains
};

/// Fully polarised light through frames of any angle whose axes are off by their rounding.
template <class T>
Errors rotate_often(int chains, int length, std::uint64_t seed) {
  Random random(seed);
  Errors errors;
  for (int chain = 0; chain < chains; ++chain) {
    const auto d = random.direction();
    const auto base = malus::Frame<double>::about(d);
    const auto any = [&] {
      const double angle = random.between(0, 2 * std::numbers::pi), c = std::cos(angle),
                   s = std::sin(angle);
      const auto x = c * base.x() + s * base.y(), y = c * base.y() - s * base.x();
      return malus::Frame<T>(x, y);
    };
    auto frame = any();
    malus::Stokes<T> light(1, T(0.6), 0, T(0.8), frame);
    Exact s1 = light[1];
    Exact s2 = 0;
    for (int i = 0; i < length; ++i) {
      const auto to = any();
      light = light.expressed_in(to);
      const auto dot = [](const auto& a, const auto& b) {
        return static_cast<Exact>(a.x) * b.x + static_cast<Exact>(a.y) * b.y +
               static_cast<Exact>(a.z) * b.z;
      };
      const Exact c = dot(frame.x(), to.x()), s = dot(frame.y(), to.x()), n = c * c + s * s;
      const Exact cos2 = (c * c - s * s) / n, sin2 = 2 * c * s / n, before = s1;
      s1 = cos2 * before + sin2 * s2;
      s2 = cos2 * s2 - sin2 * before;
      frame = to;
    }
    const Exact e1 = light[1] - s1, e2 = light[2] - s2, s3 = light[3];
    const Exact got =
        static_cast<Exact>(light[1]) * light[1] + static_cast<Exact>(light[2]) * light[2] + s3 * s3;
    errors.worst += (e1 * e1 + e2 * e2) / chains;
    errors.drift += (std::sqrt(got) - std::sqrt(s1 * s1 + s2 * s2 + s3 * s3)) / chains;
  }
  errors.worst = std::sqrt(errors.worst);
  return errors;
}

TEST_CASE_TEMPLATE("stability: errors of 20000 rotations are those of a random walk", T, float,
                   double) {
  constexpr int chains = 16, length = 20000;
  const auto errors = rotate_often<T>(chains, length, 1);
  const Exact unit = std::numeric_limits<T>::epsilon(),
              walk = unit * std::sqrt(static_cast<Exact>(length));
  // A step's error is about 0.4 units: the mean of 16 chains' drift has a standard error of a tenth
  // of the walk. A drift of 0.002 units a step would be as much as is allowed.
  CHECK(errors.worst <= walk);
  CHECK(std::abs(errors.drift) <= 0.25L * walk);
}

}  // namespace
