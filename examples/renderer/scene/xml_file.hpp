// SPDX-License-Identifier: MIT
// One XML file in memory, with the line of every element. Refuses what a scene needs not have and
// what parsers are attacked with: DOCTYPE and entities, a missing or second root, text outside it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <pugixml.hpp>
#include <string>
#include <vector>

#include "../io/input_error.hpp"

namespace renderer {

/// The bytes of a regular file of at most `largest` bytes; an InputError at `asker` (or the file)
/// if that fails.
std::string read_bytes(const std::filesystem::path& path, std::uintmax_t largest,
                       const Location& asker = {});

class XmlFile {
 public:
  /// `asker` is the place that asks for the file, to be named if it isn't there.
  explicit XmlFile(const std::filesystem::path& path, const Location& asker = {});

  pugi::xml_node root() const { return root_; }
  const std::string& name() const { return name_; }
  std::uintmax_t size() const { return size_; }
  Location at(const pugi::xml_node& node) const;

 private:
  int line_of(std::ptrdiff_t offset) const;
  [[noreturn]] void fail(std::ptrdiff_t offset, const std::string& message) const;
  void find_lines(const std::string& text);
  void reject_entities(const std::string& text) const;
  void check_document();

  std::string name_;
  std::uintmax_t size_ = 0;
  std::vector<std::ptrdiff_t> line_ends_;
  pugi::xml_document document_;
  pugi::xml_node root_;
};

}  // namespace renderer
