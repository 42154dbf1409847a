// SPDX-License-Identifier: MIT
#include "ply_stream.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>

#include "text.hpp"

namespace renderer {
namespace {

struct TypeName {
  std::string_view name;
  PlyType type;
};
constexpr std::array<TypeName, 16> type_names = {{{"char", PlyType::int8},
                                                  {"uchar", PlyType::uint8},
                                                  {"short", PlyType::int16},
                                                  {"ushort", PlyType::uint16},
                                                  {"int", PlyType::int32},
                                                  {"uint", PlyType::uint32},
                                                  {"float", PlyType::float32},
                                                  {"double", PlyType::float64},
                                                  {"int8", PlyType::int8},
                                                  {"uint8", PlyType::uint8},
                                                  {"int16", PlyType::int16},
                                                  {"uint16", PlyType::uint16},
                                                  {"int32", PlyType::int32},
                                                  {"uint32", PlyType::uint32},
                                                  {"float32", PlyType::float32},
                                                  {"float64", PlyType::float64}}};

std::size_t size_of(PlyType type) {
  switch (type) {
    case PlyType::int8:
    case PlyType::uint8:
      return 1;
    case PlyType::int16:
    case PlyType::uint16:
      return 2;
    case PlyType::int32:
    case PlyType::uint32:
    case PlyType::float32:
      return 4;
    case PlyType::float64:
      break;
  }
  return 8;
}

struct Limits {
  double lowest;
  double highest;
};

Limits limits_of(PlyType type) {
  switch (type) {
    case PlyType::int8:
      return {-128, 127};
    case PlyType::uint8:
      return {0, 255};
    case PlyType::int16:
      return {-32768, 32767};
    case PlyType::uint16:
      return {0, 65535};
    case PlyType::int32:
      return {-2147483648.0, 2147483647.0};
    case PlyType::uint32:
      return {0, 4294967295.0};
    case PlyType::float32:
    case PlyType::float64:
      break;
  }
  return {std::numeric_limits<double>::lowest(), std::numeric_limits<double>::max()};
}

double value_of(PlyType type, std::uint64_t bits) {
  switch (type) {
    case PlyType::int8:
      return static_cast<std::int8_t>(bits);
    case PlyType::uint8:
      return static_cast<std::uint8_t>(bits);
    case PlyType::int16:
      return static_cast<std::int16_t>(bits);
    case PlyType::uint16:
      return static_cast<std::uint16_t>(bits);
    case PlyType::int32:
      return static_cast<std::int32_t>(bits);
    case PlyType::uint32:
      return static_cast<std::uint32_t>(bits);
    case PlyType::float32:
      return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
    case PlyType::float64:
      break;
  }
  return std::bit_cast<double>(bits);
}

}  // namespace

bool is_fraction(PlyType type) { return type == PlyType::float32 || type == PlyType::float64; }

PlyStream::PlyStream(std::string file, std::string bytes)
    : file_(std::move(file)), bytes_(std::move(bytes)) {
  read_header();
  check_counts();
}

void PlyStream::fail(const std::string& message) const {
  throw InputError({file_, line_}, message);
}

void PlyStream::fail_whole(const std::string& message) const {
  throw InputError({file_, 0}, message);
}

std::vector<std::string_view> PlyStream::header_line() {
  ++line_;
  if (at_ >= bytes_.size()) fail("the file ends in its header; allowed: a header up to end_header");
  const std::string_view rest = std::string_view(bytes_).substr(at_);
  // Binary values follow the header at once, so that a lone carriage return can't count as a line's
  // end there.
  const std::size_t length = std::min(rest.find('\n'), rest.size());
  at_ += std::min(length + 1, rest.size());
  return split_list(rest.substr(0, length));
}

void PlyStream::read_header() {
  const std::vector<std::string_view> magic = header_line();
  if (magic.size() != 1 || magic[0] != "ply") fail("not a PLY file; allowed: \"ply\" in line 1");
  while (true) {
    const std::vector<std::string_view> words = header_line();
    if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
    if (words[0] == "end_header") break;
    if (words[0] == "format") {
      read_format(words);
    } else if (words[0] == "element") {
      read_element(words);
    } else if (words[0] == "property") {
      read_property(words);
    } else {
      fail("unknown header line " + in_quotes(words[0]) +
           "; allowed: format, comment, obj_info, element, property, end_header");
    }
  }
  if (!has_format_) fail("the header has no format line");
  // The values begin in the line after the header; binary ones are in none.
  line_ = encoding_ == Encoding::ascii ? line_ + 1 : 0;
}

void PlyStream::read_format(const std::vector<std::string_view>& words) {
  const std::string_view name = words.size() == 3 ? words[1] : std::string_view();
  if (has_format_ || name.empty() || words[2] != "1.0") {
    fail("malformed or second format line; allowed: one, such as \"format ascii 1.0\"");
  }
  has_format_ = true;
  if (name == "ascii") {
    encoding_ = Encoding::ascii;
  } else if (name == "binary_little_endian") {
    encoding_ = Encoding::little;
  } else if (name == "binary_big_endian") {
    encoding_ = Encoding::big;
  } else {
    fail("unknown format " + in_quotes(name) +
         "; allowed: ascii, binary_little_endian, binary_big_endian");
  }
}

void PlyStream::read_element(const std::vector<std::string_view>& words) {
  if (words.size() != 3) fail("malformed line; allowed: element <name> <count>");
  const auto count = parse_integer(words[2]);
  if (!count || *count < 0) {
    fail("not a count: " + in_quotes(words[2]) + "; allowed: a whole number from 0");
  }
  for (const PlyElement& element : elements_) {
    if (element.name == words[1]) fail("a second element " + in_quotes(words[1]));
  }
  elements_.push_back({std::string(words[1]), static_cast<std::size_t>(*count), {}});
}

void PlyStream::read_property(const std::vector<std::string_view>& words) {
  if (elements_.empty()) fail("a property before the first element");
  PlyProperty property;
  property.is_list = words.size() > 1 && words[1] == "list";
  if (words.size() != (property.is_list ? 5U : 3U)) {
    fail("malformed line; allowed: property <type> <name>, property list <type> <type> <name>");
  }
  if (property.is_list) {
    property.count_type = type_named(words[2]);
    if (is_fraction(property.count_type)) {
      fail("a list counted by " + in_quotes(words[2]) + "; allowed: an integer type");
    }
  }
  property.type = type_named(words[words.size() - 2]);
  property.name = words.back();
  for (const PlyProperty& other : elements_.back().properties) {
    if (other.name == property.name) fail("a second property " + in_quotes(property.name));
  }
  elements_.back().properties.push_back(property);
}

PlyType PlyStream::type_named(std::string_view name) const {
  std::vector<std::string> allowed;
  for (const TypeName& entry : type_names) {
    if (entry.name == name) return entry.type;
    allowed.emplace_back(entry.name);
  }
  fail("unknown type " + in_quotes(name) + "; allowed: " + joined(allowed));
}

std::size_t PlyStream::smallest_row(const PlyElement& element) const {
  std::size_t size = 0;
  for (const PlyProperty& property : element.properties) {
    // A digit, and the blank or line end before the next value.
    if (encoding_ == Encoding::ascii) {
      size += 2;
    } else {
      size += size_of(property.is_list ? property.count_type : property.type);
    }
  }
  return size;
}

void PlyStream::check_counts() const {
  std::size_t left = bytes_.size() - at_;
  // The last value of a text may lack its line end.
  if (encoding_ == Encoding::ascii) ++left;
  for (const PlyElement& element : elements_) {
    if (element.count == 0) continue;
    const std::size_t row = smallest_row(element);
    if (row == 0) {
      fail_whole("the element " + in_quotes(element.name) +
                 " has no properties; allowed: 1 or more");
    }
    if (element.count > left / row) {
      fail_whole("the header promises " + std::to_string(element.count) + " of " +
                 in_quotes(element.name) + ", the file has bytes for at most " +
                 std::to_string(left / row) + ": is it truncated?");
    }
    left -= element.count * row;
  }
}

std::string_view PlyStream::next_word() {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; };
  while (at_ < bytes_.size() && is_blank(bytes_[at_])) {
    if (bytes_[at_] == '\n') ++line_;
    ++at_;
  }
  const std::size_t start = at_;
  while (at_ < bytes_.size() && !is_blank(bytes_[at_])) ++at_;
  return std::string_view(bytes_).substr(start, at_ - start);
}

double PlyStream::next_text(PlyType type) {
  const std::string_view word = next_word();
  if (word.empty()) fail("the file ends before all its values: is it truncated?");
  const auto value = parse_number(word);
  if (!value) fail("not a finite number: " + in_quotes(word));
  const Limits limits = limits_of(type);
  const bool whole = is_fraction(type) || std::floor(*value) == *value;
  if (!whole || *value < limits.lowest || *value > limits.highest) {
    fail("not of its type: " + in_quotes(word) + "; allowed: whole numbers " +
         shown(limits.lowest) + " to " + shown(limits.highest));
  }
  return *value;
}

double PlyStream::next_binary(PlyType type) {
  const std::size_t size = size_of(type);
  if (bytes_.size() - at_ < size) fail("the file ends before all its values: is it truncated?");
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t byte = encoding_ == Encoding::little ? size - 1 - i : i;
    bits = bits << 8 | static_cast<unsigned char>(bytes_[at_ + byte]);
  }
  at_ += size;
  return value_of(type, bits);
}

double PlyStream::next(PlyType type) {
  return encoding_ == Encoding::ascii ? next_text(type) : next_binary(type);
}

std::size_t PlyStream::list_size(const PlyProperty& property) {
  const double count = next(property.count_type);
  const std::size_t left = bytes_.size() - at_;
  const std::size_t each = encoding_ == Encoding::ascii ? 2 : size_of(property.type);
  if (count < 0 || count > static_cast<double>(left / each)) {
    fail("a list of " + shown(count) + " values; allowed: 0 to " + std::to_string(left / each) +
         ", for which the file has bytes");
  }
  return static_cast<std::size_t>(count);
}

void PlyStream::skip_list(const PlyProperty& property) {
  for (std::size_t left = list_size(property); left > 0; --left) next(property.type);
}

void PlyStream::expect_end() {
  if (encoding_ != Encoding::ascii) return;
  const std::string_view word = next_word();
  if (!word.empty()) fail("more values than the header promises: " + in_quotes(word));
}

}  // namespace renderer
