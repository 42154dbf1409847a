// SPDX-License-Identifier: MIT
#include <doctest/doctest.h>

#include <array>
#include <limits>

#include <malus/spectrum.hpp>

using malus::Rgb;
using malus::Spectrum;

TEST_CASE_TEMPLATE("arithmetic of a spectrum is that of its channels", S, Rgb, Spectrum<double, 3>,
                   Spectrum<float, 4>, Spectrum<float, 5>, Spectrum<double, 8>,
                   Spectrum<float, 16>) {
  using T = typename S::scalar_type;
  constexpr std::size_t n = S::channels;
  std::array<T, n> a_values, b_values;
  for (std::size_t i = 0; i < n; ++i) {
    a_values[i] = T(1) + static_cast<T>(i) / 4;
    b_values[i] = T(3) - static_cast<T>(i) / 8;
  }
  const S a(a_values), b(b_values);
  for (std::size_t i = 0; i < n; ++i) {
    CAPTURE(i);
    const T x = a_values[i], y = b_values[i];
    CHECK(a[i] == x);
    CHECK((a + b)[i] == x + y);
    CHECK((a - b)[i] == x - y);
    CHECK((a * b)[i] == x * y);
    CHECK((a / b)[i] == x / y);
    CHECK((-a)[i] == -x);
    CHECK((a * T(2))[i] == 2 * x);
    CHECK((T(2) * a)[i] == 2 * x);
    CHECK((a / T(2))[i] == x / 2);
    CHECK(S(T(7))[i] == T(7));
    CHECK(malus::map_channels([](T p, T q) { return p - 2 * q; }, a, b)[i] == x - 2 * y);
  }
  CHECK(a == a);
  CHECK_FALSE(a == b);
  CHECK(malus::max_channel(a) == a_values[n - 1]);
  CHECK(malus::mean_channel(a) == doctest::Approx((a_values[0] + a_values[n - 1]) / 2));
}

TEST_CASE("the padding of a spectrum is not seen") {
  // 1/0 in a padding lane, where the channels have none.
  const Rgb quotient = Rgb(1.f, 2.f, 3.f) / Rgb(1.f, 2.f, 4.f);
  CHECK(malus::is_finite(quotient));
  CHECK(malus::max_channel(quotient) == 1.f);
  CHECK(quotient == Rgb(1.f, 1.f, 0.75f));
  CHECK(malus::max_channel(Rgb(-1.f, -2.f, -3.f)) == -1.f);
}

TEST_CASE_TEMPLATE("is_finite finds an infinite channel and one that is no number", S, Rgb,
                   Spectrum<double, 4>, Spectrum<float, 1>) {
  using T = typename S::scalar_type;
  for (std::size_t i = 0; i < S::channels; ++i) {
    for (const T bad : {std::numeric_limits<T>::infinity(), -std::numeric_limits<T>::infinity(),
                        std::numeric_limits<T>::quiet_NaN()}) {
      S s(T(1));
      CHECK(malus::is_finite(s));
      s.set(i, bad);
      CHECK_FALSE(malus::is_finite(s));
    }
  }
  CHECK(malus::is_finite(std::numeric_limits<T>::max()));
  CHECK_FALSE(malus::is_finite(std::numeric_limits<T>::quiet_NaN()));
}
