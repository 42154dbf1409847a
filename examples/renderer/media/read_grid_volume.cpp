// SPDX-License-Identifier: MIT
#include "read_grid_volume.hpp"

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

#include "../image/finite.hpp"
#include "../scene/text.hpp"
#include "../scene/xml_file.hpp"

namespace renderer {

namespace {

constexpr std::size_t header_size = 48;
constexpr std::int64_t most_values = std::int64_t{1} << 27;
constexpr std::uintmax_t largest_file = header_size + 4 * std::uintmax_t{most_values};

class GridReader {
 public:
  GridReader(const std::filesystem::path& path, const Location& asker)
      : file_(path.string()), asker_(asker), bytes_(read_bytes(path, largest_file, asker)) {}

  GridVolume read() const {
    if (bytes_.size() < header_size)
      fail("has " + std::to_string(bytes_.size()) + " bytes; allowed: a header of " +
           std::to_string(header_size) + " bytes, and values");
    if (!bytes_.starts_with("VOL")) fail("doesn't start with \"VOL\": no grid volume");
    expect("version", static_cast<std::uint8_t>(bytes_[3]), 3, "3");
    expect("encoding", integer(4), 1, "1, 32-bit floats");
    GridVolume volume;
    read_size(volume.grid);
    for (int i = 0; i < 3; ++i) {
      volume.lowest[i] = static_cast<double>(number(24 + 4 * static_cast<std::size_t>(i)));
      volume.highest[i] = static_cast<double>(number(36 + 4 * static_cast<std::size_t>(i)));
    }
    read_values(volume.grid);
    return volume;
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const {
    if (asker_.file.empty()) throw InputError({file_, 0}, problem);
    throw InputError(asker_, "the file " + in_quotes(file_) + ": " + problem);
  }

  void expect(const std::string& what, std::int64_t found, std::int64_t wanted,
              const std::string& allowed) const {
    if (found != wanted)
      fail("the " + what + " is " + std::to_string(found) + "; allowed: " + allowed);
  }

  std::uint32_t word(std::size_t at) const {
    std::uint32_t w = 0;
    for (std::size_t i = 0; i < 4; ++i)
      w |= std::uint32_t{static_cast<std::uint8_t>(bytes_[at + i])} << (8 * i);
    return w;
  }
  std::int32_t integer(std::size_t at) const { return static_cast<std::int32_t>(word(at)); }
  float number(std::size_t at) const { return std::bit_cast<float>(word(at)); }

  void read_size(GridValues& grid) const {
    grid.channels = integer(20);
    if (grid.channels != 1 && grid.channels != 3)
      fail("has " + std::to_string(grid.channels) + " channels; allowed: 1 or 3");
    std::int64_t values = grid.channels;
    std::string sides;
    bool fits = true;
    for (int i = 0; i < 3; ++i) {
      const std::int64_t side = integer(8 + 4 * static_cast<std::size_t>(i));
      grid.size[i] = static_cast<int>(side);
      sides += (i ? " x " : "") + std::to_string(side);
      fits = fits && side >= 1 && side <= most_values / values;
      if (fits) values *= side;
    }
    if (!fits)
      fail("has " + sides + " cells of " + std::to_string(grid.channels) +
           " values; allowed: 1 or more along each axis, " + std::to_string(most_values) +
           " values at most");
    const std::size_t expected = header_size + 4 * static_cast<std::size_t>(values);
    if (bytes_.size() != expected)
      fail("has " + std::to_string(bytes_.size()) + " bytes, and its header speaks of " + sides +
           " cells of " + std::to_string(grid.channels) +
           " values; allowed: " + std::to_string(expected) + " bytes");
  }

  void read_values(GridValues& grid) const {
    const std::size_t count = (bytes_.size() - header_size) / 4;
    grid.values.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      const float v = number(header_size + 4 * i);
      if (!is_finite(v) || !(v >= 0))
        fail("value " + std::to_string(i + 1) + " of " + std::to_string(count) + " is " +
             shown(static_cast<double>(v)) + "; allowed: finite numbers, 0 or more");
      grid.values[i] = v;
    }
  }

  std::string file_;
  Location asker_;
  std::string bytes_;
};

}  // namespace

GridVolume read_grid_volume(const std::filesystem::path& path, const Location& asker) {
  return GridReader(path, asker).read();
}

}  // namespace renderer
