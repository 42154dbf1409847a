// SPDX-License-Identifier: MIT
#include <string>
#include <string_view>

#include "../scene/text.hpp"
#include "../scene/xml_file.hpp"
#include "tabulated_phase.hpp"

namespace renderer {
namespace {

constexpr std::uintmax_t largest_file = std::uintmax_t{1} << 24;
constexpr std::size_t most_rows = 100000;
constexpr const char* columns[] = {"angle", "a1", "a2", "a3", "a4", "b1", "b2"};

class PhaseTable {
 public:
  explicit PhaseTable(std::string file) : where_{std::move(file), 0} {}

  TabulatedPhase read(std::string_view text) {
    for (std::size_t at = 0; at < text.size();) {
      std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
      ++where_.line;
      const std::string_view line = text.substr(at, end - at);
      const auto words = split_list(line.substr(0, line.find('#')));
      if (!words.empty()) add(words);
      if (text.substr(end, 2) == "\r\n") ++end;
      at = end + 1;
    }
    finish();
    return TabulatedPhase(angles_, rows_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw InputError(where_, message); }

  void add(const std::vector<std::string_view>& words) {
    if (words.size() != std::size(columns))
      fail(std::to_string(words.size()) +
           " numbers in a line; allowed: 7, angle a1 a2 a3 a4 b1 b2");
    if (rows_.size() == most_rows)
      fail("too many lines of numbers; allowed: at most " + std::to_string(most_rows));
    std::array<double, std::size(columns)> v{};
    for (std::size_t i = 0; i < v.size(); ++i) {
      const auto number = parse_number(words[i]);
      if (!number || std::abs(*number) > 1e30)
        fail(std::string(columns[i]) + " is " + in_quotes(words[i]) +
             "; allowed: a number of magnitude up to 1e30");
      v[i] = *number;
    }
    check_angle(v[0]);
    if (!(v[1] >= 0)) fail("a1 is " + shown(v[1]) + "; allowed: 0 and more");
    for (std::size_t i = 2; i < v.size(); ++i)
      // Rounding of what was printed.
      if (std::abs(v[i]) > v[1] * (1 + 1e-5))
        fail(std::string(columns[i]) + " is " + shown(v[i]) +
             ", of which light would be more than fully polarised; allowed: magnitudes up to a1, " +
             shown(v[1]));
    degrees_ = v[0];
    largest_ = std::max(largest_, v[1]);
    angles_.push_back(v[0] * (std::numbers::pi / 180));
    const malus::ScatteringElements<double> e{v[1], v[2], v[3], v[4], v[5], v[6]};
    rows_.push_back({e, e, e});
  }

  void check_angle(double degrees) const {
    if (rows_.empty() && degrees != 0)
      fail("the first angle is " + shown(degrees) + "; allowed: 0");
    if (rows_.empty()) return;
    if (!(degrees > degrees_ && degrees <= 180))
      fail("the angle " + shown(degrees) + " after " + shown(degrees_) +
           "; allowed: angles that increase, up to 180");
  }

  void finish() {
    if (rows_.empty()) {
      where_.line = 0;
      fail("no line of numbers; allowed: lines of angle a1 a2 a3 a4 b1 b2, from 0 to 180 degrees");
    }
    if (degrees_ != 180) fail("the last angle is " + shown(degrees_) + "; allowed: 180");
    if (!(largest_ >= 1e-30))
      fail("a1 is nowhere more than " + shown(largest_) + "; allowed: 1e-30 and more somewhere");
  }

  Location where_;
  double degrees_ = 0, largest_ = 0;
  std::vector<double> angles_;
  std::vector<TabulatedPhase::Row> rows_;
};

}  // namespace

TabulatedPhase read_tabulated_phase(const std::filesystem::path& path, const Location& asker) {
  return PhaseTable(path.string()).read(read_bytes(path, largest_file, asker));
}

}  // namespace renderer
