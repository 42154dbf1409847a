// SPDX-License-Identifier: MIT
#include "exr_header.hpp"

#include <cstdint>
#include <fstream>
#include <stdexcept>

namespace renderer {
namespace {

constexpr std::uint32_t multi_part = 0x1000;
constexpr std::size_t longest_name = 255;

class Headers {
 public:
  explicit Headers(const std::string& path) : in_(path, std::ios::binary | std::ios::ate) {
    size_ = static_cast<std::int64_t>(in_.tellg());
    in_.seekg(4);  // what every OpenEXR file begins with
  }

  void check() {
    const bool has_parts = (read_number() & multi_part) != 0;
    // Of several parts the last header is followed by an empty one.
    while (check_header() && has_parts) {
    }
  }

 private:
  /// False of a header without attributes.
  bool check_header() {
    for (bool is_empty = true;; is_empty = false) {
      const std::string name = read_name();
      if (name.empty()) return !is_empty;
      read_name();  // of its type
      skip(name, read_number());
    }
  }

  void skip(const std::string& name, std::uint32_t bytes) {
    const std::int64_t left = size_ - static_cast<std::int64_t>(in_.tellg());
    if (bytes > left)
      throw std::runtime_error("damaged: the attribute \"" + name + "\" claims " +
                               std::to_string(bytes) + " bytes, but only " + std::to_string(left) +
                               " are left");
    in_.seekg(bytes, std::ios::cur);
  }

  std::string read_name() {
    std::string name;
    for (char c = 0; in_.get(c) && c != '\0';) {
      name += c;
      if (name.size() > longest_name)
        throw std::runtime_error("damaged: a name in the header has more than " +
                                 std::to_string(longest_name) + " letters");
    }
    require_more();
    return name;
  }

  /// Little-endian.
  std::uint32_t read_number() {
    unsigned char bytes[4] = {};
    in_.read(reinterpret_cast<char*>(bytes), sizeof bytes);
    require_more();
    std::uint32_t number = 0;
    for (int i = 3; i >= 0; --i) number = number << 8 | bytes[i];
    return number;
  }

  void require_more() const {
    if (!in_) throw std::runtime_error("damaged: the file ends in its header");
  }

  std::ifstream in_;
  std::int64_t size_ = 0;
};

}  // namespace

void check_attribute_sizes(const std::string& path) { Headers(path).check(); }

}  // namespace renderer
