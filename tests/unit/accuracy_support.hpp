// SPDX-License-Identifier: MIT
// What the tests of accuracy share: errors in units in the last place of the largest component of a
// result, against long double, and the bounds that docs/accuracy.md states, which are the ones
// asserted.
#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <fstream>
#include <map>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <malus/spectrum.hpp>

namespace accuracy_test {

using Exact = long double;
using Complex = std::complex<long double>;
inline constexpr Exact pi = std::numbers::pi_v<long double>;

/// The same numbers with every standard library, none of which is a number of a narrower type.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  /// Between two positive numbers, evenly by magnitude.
  double magnitude(double low, double high) {
    return std::exp(between(std::log(low), std::log(high)));
  }
  double sign() { return unit() < 0.5 ? -1.0 : 1.0; }
  std::array<double, 3> direction() {
    const double z = between(-1, 1), phi = between(0, 2 * std::numbers::pi);
    const double r = std::sqrt((1 - z) * (1 + z));
    return {r * std::cos(phi), r * std::sin(phi), z};
  }

 private:
  std::mt19937_64 engine_;
};

/// The last place of numbers of T as large as x.
template <class T>
Exact last_place(Exact x) {
  return std::ldexp(1.0L, std::ilogb(x) - (std::numeric_limits<T>::digits - 1));
}

/// Read by its bits: -ffast-math believes that there is no NaN.
template <class T>
bool is_number(T x) {
  return malus::is_finite(x);
}

/// The bounds that docs/accuracy.md states, and how near to them what was measured comes. A row is
/// | `name` … | domain | bound in float | bound in double | outside |, the bounds numbers of units
/// in the last place, or `exact`, which is 0, or a dash where there is no such function.
class Bounds {
 public:
  /// Those under one heading.
  explicit Bounds(const std::string& heading) {
    std::ifstream file(MALUS_DOCS_DIR "/accuracy.md");
    REQUIRE_MESSAGE(file.good(), "docs/accuracy.md can be read");
    bool here = false;
    for (std::string line; std::getline(file, line);) {
      if (line.starts_with("#")) here = line == "## " + heading;
      if (here && line.starts_with("| `")) add(line);
    }
    REQUIRE_MESSAGE(!stated_.empty(), heading << " has a table");
  }

  /// A result of one quantity, in units in the last place of its largest component, or of `scale`
  /// where that is larger: of what cancelled in it.
  template <class T, std::size_t N>
  void compare(const std::string& name, const std::array<T, N>& got,
               const std::array<Exact, N>& exact, Exact scale = 0) {
    for (const Exact x : exact) scale = std::max(scale, std::abs(x));
    if (!(scale > 0)) scale = static_cast<Exact>(std::numeric_limits<T>::min());
    Exact worst = 0;
    bool finite = true;
    for (std::size_t i = 0; i < N; ++i) {
      finite = finite && is_number(got[i]);
      worst = std::max(worst, std::abs(static_cast<Exact>(got[i]) - exact[i]));
    }
    record<T>(name, finite, static_cast<double>(worst / last_place<T>(scale)));
  }
  template <class T>
  void compare(const std::string& name, T got, Exact exact, Exact scale = 0) {
    compare(name, std::array<T, 1>{got}, std::array<Exact, 1>{exact}, scale);
  }
  template <class T>
  void record(const std::string& name, bool finite, double ulps) {
    const auto found = stated_.find(name);
    if (found == stated_.end()) FAIL("docs/accuracy.md has no row `" << name << "`");
    Row& row = found->second;
    const std::size_t which = sizeof(T) == 4 ? 0 : 1;
    row.measured[which] = std::max(row.measured[which], ulps);
    row.finite = row.finite && finite;
    row.seen = true;
  }

  void check() const {
    for (const auto& [name, row] : stated_) {
      INFO(name, ": ", row.measured[0], " of ", row.bound[0], " in float, ", row.measured[1],
           " of ", row.bound[1], " in double");
      CHECK_MESSAGE(row.seen, "a row that nothing measures");
      CHECK(row.finite);
      CHECK(row.measured[0] <= malus::config::error_factor * row.bound[0]);
      CHECK(row.measured[1] <= malus::config::error_factor * row.bound[1]);
      if (std::getenv("MALUS_PRINT_ACCURACY") != nullptr)
        std::printf("| %s | %.3g of %g | %.3g of %g |\n", name.c_str(), row.measured[0],
                    row.bound[0], row.measured[1], row.bound[1]);
    }
  }

 private:
  struct Row {
    std::array<double, 2> bound{}, measured{};
    bool finite = true, seen = false;
  };

  void add(const std::string& line) {
    std::vector<std::string> cell(1);
    for (const char c : line.substr(1)) {
      if (c == '|')
        cell.emplace_back();
      else
        cell.back() += c;
    }
    REQUIRE_MESSAGE(cell.size() == 6, line);
    const std::size_t from = cell[0].find('`') + 1;
    Row row;
    for (const std::size_t i : {0u, 1u}) {
      const std::string& text = cell[2 + i];
      if (text.find("exact") != std::string::npos || text.find("—") != std::string::npos) continue;
      std::istringstream number(text);
      REQUIRE_MESSAGE(static_cast<bool>(number >> row.bound[i]), line);
    }
    stated_[cell[0].substr(from, cell[0].find('`', from) - from)] = row;
  }

  std::map<std::string, Row> stated_;
};

}  // namespace accuracy_test
