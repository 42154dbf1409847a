// SPDX-License-Identifier: MIT
// One XML element with its attributes checked and its $parameters substituted, and the values its
// attributes spell.
#pragma once

#include <glm/glm.hpp>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "object.hpp"

namespace renderer {

struct Element {
  std::string tag;
  Location where;
  std::map<std::string, std::string, std::less<>> attributes;

  [[noreturn]] void fail(const std::string& message) const;
  bool has(std::string_view attribute) const { return attributes.count(attribute) != 0; }
  const std::string& text(std::string_view attribute) const;
  /// Empty where the attribute isn't there.
  std::string text_or_empty(std::string_view attribute) const;
  /// Throws unless all of `required` and nothing but those and `optional` is there.
  void check(std::initializer_list<std::string_view> required,
             std::initializer_list<std::string_view> optional) const;

  double number(std::string_view attribute) const;
  std::vector<double> numbers(std::string_view attribute) const;
  /// Three numbers separated by blanks or commas.
  glm::dvec3 triple(std::string_view attribute) const;
  /// value="x, y, z", value="s" (all three) or x= y= z=, of which those left out are `otherwise`.
  glm::dvec3 components(double otherwise) const;
};

/// The tags of parameters, in the order errors list them.
const std::vector<std::string>& property_tags();
bool is_property(std::string_view tag);

/// Any parameter but <transform>.
Property read_property(const Element& element);

/// One of translate, rotate, scale, lookat, matrix.
glm::dmat4 read_transform_step(const Element& element);

}  // namespace renderer
