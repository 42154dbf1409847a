// SPDX-License-Identifier: MIT
// The $name parameters of a scene: values from the command line, which win, and <default> elements.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>

#include "element.hpp"

namespace renderer {

class Parameters {
 public:
  explicit Parameters(const std::map<std::string, std::string>& definitions);

  /// A name that already has a value keeps it.
  void set_default(const Element& element);

  /// Replaces every $name (letters, digits, underscores); "\$" is a dollar.
  /// What comes of it is of limited length, and so is all that it puts in: values that hold values
  /// that ... make as much of little as a bomb wants.
  std::string substitute(std::string_view text, const Location& where);

  /// Throws if the command line defines a name that the scene neither uses nor has a default of.
  void reject_unused(const std::string& file) const;

 private:
  void put_in(const std::string& name, const std::string& value, std::string& out,
              const Location& where);

  std::map<std::string, std::string, std::less<>> values_;
  std::set<std::string> defined_;  // on the command line
  std::set<std::string> known_;    // to the scene
  std::size_t put_in_ = 0;         // bytes, of all values
};

}  // namespace renderer
