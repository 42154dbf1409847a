// SPDX-License-Identifier: MIT
#include "xml_file.hpp"

#include <algorithm>
#include <fstream>
#include <string_view>
#include <system_error>

#include "../io/digest.hpp"
#include "text.hpp"

namespace renderer {
namespace {

constexpr std::uintmax_t largest_scene = std::uintmax_t{1} << 30;

/// The entities XML itself defines, and character references.
bool is_known_entity(std::string_view name) {
  for (const std::string_view known : {"amp", "lt", "gt", "quot", "apos"}) {
    if (name == known) return true;
  }
  if (name.size() < 2 || name[0] != '#') return false;
  name.remove_prefix(1);
  const bool hexadecimal = name[0] == 'x';
  if (hexadecimal) name.remove_prefix(1);
  const std::string_view digits = hexadecimal ? "0123456789abcdefABCDEF" : "0123456789";
  return !name.empty() && name.find_first_not_of(digits) == std::string_view::npos;
}

/// Where a comment or CDATA section that opens at `i` ends (they know no entities); `i` if none
/// opens there.
std::size_t end_of_verbatim(const std::string& text, std::size_t i) {
  if (text.compare(i, 4, "<!--") == 0) return text.find("-->", i + 4);
  if (text.compare(i, 9, "<![CDATA[") == 0) return text.find("]]>", i + 9);
  return i;
}

}  // namespace

std::string read_bytes(const std::filesystem::path& path, std::uintmax_t largest,
                       const Location& asker) {
  const std::string name = path.string();
  const auto fail = [&](const std::string& problem) {
    if (asker.file.empty()) throw InputError({name, 0}, problem);
    throw InputError(asker, "the file " + in_quotes(name) + ": " + problem);
  };
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) fail("no such file");
  if (std::filesystem::is_directory(status)) fail("is a folder; allowed: a file");
  if (!std::filesystem::is_regular_file(status)) fail("is not a regular file");
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) fail("cannot be read: " + error.message());
  if (size > largest) {
    fail("has " + std::to_string(size) + " bytes; allowed: at most " + std::to_string(largest));
  }
  std::ifstream in(path, std::ios::binary);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  if (!in || !in.read(bytes.data(), static_cast<std::streamsize>(size))) {
    fail("cannot be read; is reading permitted?");
  }
  DigestOfReading::note(bytes);
  return bytes;
}

XmlFile::XmlFile(const std::filesystem::path& path, const Location& asker) : name_(path.string()) {
  const std::string text = read_bytes(path, largest_scene, asker);
  size_ = text.size();
  find_lines(text);
  if (trimmed(text).empty()) fail(0, "the file is empty; allowed: a <scene>");
  if (const std::size_t nul = text.find('\0'); nul != std::string::npos) {
    fail(static_cast<std::ptrdiff_t>(nul), "a zero byte; allowed: XML text in UTF-8");
  }
  reject_entities(text);
  // Positions are only exact in UTF-8, where nothing is converted. Document-level text shows up as
  // a fragment.
  const unsigned options = pugi::parse_default | pugi::parse_doctype | pugi::parse_fragment;
  const pugi::xml_parse_result result =
      document_.load_buffer(text.data(), text.size(), options, pugi::encoding_utf8);
  if (!result) {
    if (result.offset + 1 >= static_cast<std::ptrdiff_t>(text.size())) {
      fail(result.offset,
           std::string("malformed XML: the file ends too early: ") + result.description());
    }
    fail(result.offset, std::string("malformed XML: ") + result.description());
  }
  check_document();
}

void XmlFile::find_lines(const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool lone_return = text[i] == '\r' && (i + 1 == text.size() || text[i + 1] != '\n');
    if (text[i] == '\n' || lone_return) line_ends_.push_back(static_cast<std::ptrdiff_t>(i));
  }
}

int XmlFile::line_of(std::ptrdiff_t offset) const {
  if (offset < 0) return 0;
  const auto after = std::lower_bound(line_ends_.begin(), line_ends_.end(), offset);
  return static_cast<int>(after - line_ends_.begin()) + 1;
}

Location XmlFile::at(const pugi::xml_node& node) const {
  int line = line_of(node.offset_debug());
  if (node.type() != pugi::node_element) {
    // Text begins at the end of the tag before it, possibly lines above its first letter.
    const std::string_view text = node.value();
    const std::size_t blanks = std::min(text.find_first_not_of(" \t\r\n"), text.size());
    line += static_cast<int>(std::count(text.begin(), text.begin() + blanks, '\n'));
  }
  return {name_, line};
}

void XmlFile::fail(std::ptrdiff_t offset, const std::string& message) const {
  throw InputError({name_, line_of(offset)}, message);
}

void XmlFile::reject_entities(const std::string& text) const {
  for (std::size_t i = text.find_first_of("<&"); i != std::string::npos;
       i = text.find_first_of("<&", i + 1)) {
    if (text[i] == '<') {
      i = end_of_verbatim(text, i);
      if (i == std::string::npos) return;
      continue;
    }
    const std::size_t end = text.find_first_of("; \t\r\n\"'<>", i);
    const bool closed = end != std::string::npos && text[end] == ';';
    const std::string_view name = std::string_view(text).substr(i + 1, end - i - 1);
    if (closed && is_known_entity(name)) continue;
    fail(static_cast<std::ptrdiff_t>(i),
         "unknown entity " + in_quotes(std::string("&").append(name).append(closed ? ";" : "")) +
             "; allowed: &amp; &lt; &gt; &quot; &apos; &#number;");
  }
}

void XmlFile::check_document() {
  for (const pugi::xml_node node : document_.children()) {
    if (node.type() == pugi::node_doctype) {
      fail(node.offset_debug(), "a DOCTYPE; allowed: elements and comments only");
    }
    if (node.type() == pugi::node_pcdata || node.type() == pugi::node_cdata) {
      throw InputError(at(node),
                       "text outside of the root element: " + in_quotes(trimmed(node.value())));
    }
    if (node.type() != pugi::node_element) continue;
    if (root_) {
      fail(node.offset_debug(),
           "a second root element <" + std::string(node.name()) + ">; allowed: one");
    }
    root_ = node;
  }
  if (!root_) fail(0, "the file has no element; allowed: a <scene>");
}

}  // namespace renderer
