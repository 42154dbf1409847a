// SPDX-License-Identifier: MIT
// The header of a PLY file, and its values one after another, whatever their encoding.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "../io/input_error.hpp"

namespace renderer {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

bool is_fraction(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  bool is_list = false;
  PlyType count_type = PlyType::uint8;
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
};

class PlyStream {
 public:
  /// Reads the header. Each element's count is then known to fit into the file.
  PlyStream(std::string file, std::string bytes);

  const std::vector<PlyElement>& elements() const { return elements_; }

  /// The next value; a double holds every type exactly.
  double next(PlyType type);
  /// The length of a list, of which so many values are there.
  std::size_t list_size(const PlyProperty& property);
  void skip_list(const PlyProperty& property);
  /// Throws if a text file goes on. Padding after binary values does no harm.
  void expect_end();

  [[noreturn]] void fail(const std::string& message) const;
  [[noreturn]] void fail_whole(const std::string& message) const;

 private:
  enum class Encoding { ascii, little, big };

  void read_header();
  std::vector<std::string_view> header_line();
  void read_format(const std::vector<std::string_view>& words);
  void read_element(const std::vector<std::string_view>& words);
  void read_property(const std::vector<std::string_view>& words);
  PlyType type_named(std::string_view name) const;
  void check_counts() const;
  std::size_t smallest_row(const PlyElement& element) const;
  double next_text(PlyType type);
  double next_binary(PlyType type);
  std::string_view next_word();

  std::string file_;
  std::string bytes_;
  std::size_t at_ = 0;
  int line_ = 0;  // of what was read last; 0 in binary values
  Encoding encoding_ = Encoding::ascii;
  bool has_format_ = false;
  std::vector<PlyElement> elements_;
};

}  // namespace renderer
