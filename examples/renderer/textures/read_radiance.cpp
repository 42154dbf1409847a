// SPDX-License-Identifier: MIT
#include "read_radiance.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "../scene/text.hpp"

namespace renderer {

namespace {

constexpr long long largest_side = 1 << 16;

class RadianceReader {
 public:
  explicit RadianceReader(std::string_view bytes) : rest_(bytes) {}

  Texels read(const std::function<void(int, int)>& check) {
    read_header();
    Texels texels = read_size();
    const auto width = static_cast<std::size_t>(texels.width);
    // Every pixel takes 4 bytes, or a run of 127 of them takes 8 at least.
    if (width * static_cast<std::size_t>(texels.height) > 64 * rest_.size()) fail_at_end();
    check(texels.width, texels.height);
    texels.values.reserve(width * static_cast<std::size_t>(texels.height));
    std::vector<Pixel> line(width);
    for (int y = 0; y < texels.height; ++y) {
      read_line(line);
      for (const Pixel& p : line) texels.values.push_back(decode(p));
    }
    return texels;
  }

 private:
  using Pixel = std::array<std::uint8_t, 4>;

  [[noreturn]] static void fail_at_end() { throw std::runtime_error("the file ends too early"); }

  std::uint8_t next() {
    if (rest_.empty()) fail_at_end();
    const auto byte = static_cast<std::uint8_t>(rest_.front());
    rest_.remove_prefix(1);
    return byte;
  }

  std::string_view next_text_line() {
    const std::size_t end = rest_.find('\n');
    if (end == std::string_view::npos) fail_at_end();
    const std::string_view line = trimmed(rest_.substr(0, end));
    rest_.remove_prefix(end + 1);
    return line;
  }

  void read_header() {
    bool known = false;
    for (auto line = next_text_line(); !line.empty(); line = next_text_line())
      if (line.starts_with("FORMAT=")) known = line == "FORMAT=32-bit_rle_rgbe";
    if (!known) throw std::runtime_error("the format is not 32-bit_rle_rgbe");
  }

  Texels read_size() {
    const std::string_view line = next_text_line();
    const auto parts = split_list(line);
    if (parts.size() == 4 && parts[0] == "-Y" && parts[2] == "+X") {
      const auto height = parse_integer(parts[1]), width = parse_integer(parts[3]);
      if (height && width && *height > 0 && *width > 0 && *height <= largest_side &&
          *width <= largest_side)
        return {static_cast<int>(*width), static_cast<int>(*height), {}};
    }
    throw std::runtime_error("the size is " + in_quotes(line) +
                             "; allowed: -Y height +X width, up to " +
                             std::to_string(largest_side));
  }

  void read_line(std::vector<Pixel>& line) {
    const std::size_t width = line.size();
    Pixel first;
    for (auto& byte : first) byte = next();
    const bool in_runs = width >= 8 && width < 32768 && first[0] == 2 && first[1] == 2 &&
                         first[2] * 256u + first[3] == width;
    if (in_runs) {
      for (std::size_t component = 0; component < 4; ++component) read_runs(line, component);
      return;
    }
    line[0] = first;
    for (std::size_t x = 1; x < width; ++x)
      for (auto& byte : line[x]) byte = next();
  }

  /// One component of all pixels of a line: a count above 128 repeats the byte that follows, one
  /// below is of as many bytes.
  void read_runs(std::vector<Pixel>& line, std::size_t component) {
    for (std::size_t x = 0; x < line.size();) {
      const std::uint8_t count = next();
      const bool repeats = count > 128;
      const std::size_t length = repeats ? count - 128u : count;
      if (length == 0 || length > line.size() - x)
        throw std::runtime_error("damaged: a run does not fit into its line");
      std::uint8_t byte = 0;
      for (std::size_t i = 0; i < length; ++i) {
        if (i == 0 || !repeats) byte = next();
        line[x++][component] = byte;
      }
    }
  }

  static Rgb decode(const Pixel& p) {
    if (p[3] == 0) return Rgb(0.0f);
    const float unit = std::ldexp(1.0f, p[3] - 136);
    return {unit * p[0], unit * p[1], unit * p[2]};
  }

  std::string_view rest_;
};

}  // namespace

bool is_radiance(std::string_view bytes) {
  return bytes.starts_with("#?RADIANCE\n") || bytes.starts_with("#?RGBE\n");
}

Texels read_radiance(std::string_view bytes, const std::function<void(int, int)>& check) {
  return RadianceReader(bytes).read(check);
}

}  // namespace renderer
