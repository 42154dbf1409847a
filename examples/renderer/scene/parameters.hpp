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
  std::string substitute(std::string_view text, const Location& where);

  /// Throws if the command line defines a name that the scene neither uses nor has a default of.
  void reject_unused(const std::string& file) const;

 private:
  std::map<std::string, std::string, std::less<>> values_;
  std::set<std::string> defined_;  // on the command line
  std::set<std::string> known_;    // to the scene
};

}  // namespace renderer
