// SPDX-License-Identifier: MIT
#include "element.hpp"

#include <algorithm>

#include "text.hpp"
#include "transform.hpp"

namespace renderer {
namespace {

constexpr std::string_view number_rule = "; allowed: a finite number such as 0.5 or -1e3";

std::string list_of(std::initializer_list<std::string_view> required,
                    std::initializer_list<std::string_view> optional) {
  std::vector<std::string> names(required.begin(), required.end());
  names.insert(names.end(), optional.begin(), optional.end());
  return names.empty() ? "none" : joined(names);
}

bool parse_boolean(const Element& element) {
  std::string text = element.text("value");
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  if (text == "true") return true;
  if (text == "false") return false;
  element.fail("not a boolean: " + in_quotes(element.text("value")) + "; allowed: true, false");
}

glm::dvec3 parse_rgb(const Element& element) {
  const std::vector<double> values = element.numbers("value");
  if (values.size() == 1) return glm::dvec3(values[0]);
  if (values.size() == 3) return {values[0], values[1], values[2]};
  element.fail(std::to_string(values.size()) + " values in " + in_quotes(element.text("value")) +
               "; allowed: 1 or 3 numbers");
}

/// A constant spectrum gives its value; one with wavelengths stays text, for the error of who
/// cannot use it.
void parse_spectrum(const Element& element, Property& property) {
  if (element.has("value") == element.has("filename")) {
    element.fail("needs exactly one of its attributes value, filename");
  }
  if (element.has("filename")) {
    property.text = element.text("filename");
    return;
  }
  if (property.text.find(':') == std::string::npos) property.value = element.number("value");
}

void check_space_attributes(const Element& element, std::initializer_list<std::string_view> other) {
  for (const auto& [attribute, value] : element.attributes) {
    const bool is_other = std::find(other.begin(), other.end(), attribute) != other.end();
    if (is_other || attribute == "value" || attribute == "x" || attribute == "y" ||
        attribute == "z") {
      continue;
    }
    element.fail("unknown attribute " + in_quotes(attribute) + "; allowed: " + list_of(other, {}) +
                 (other.size() ? ", " : "") + "value, or x, y, z");
  }
  for (const std::string_view needed : other) element.text(needed);
  if (element.has("value") && (element.has("x") || element.has("y") || element.has("z"))) {
    element.fail("has both value and x, y, z; allowed: one of them");
  }
}

glm::dmat4 parse_matrix(const Element& element) {
  element.check({"value"}, {});
  const std::vector<double> values = element.numbers("value");
  if (values.size() != 9 && values.size() != 16) {
    element.fail(std::to_string(values.size()) + " values; allowed: 9 or 16, by rows");
  }
  const std::size_t side = values.size() == 16 ? 4 : 3;
  glm::dmat4 matrix(1.0);
  for (std::size_t i = 0; i < values.size(); ++i) {
    matrix[static_cast<int>(i % side)][static_cast<int>(i / side)] = values[i];
  }
  if (is_affine(matrix)) return matrix;
  element.fail("the last row is " + shown(matrix[0][3]) + " " + shown(matrix[1][3]) + " " +
               shown(matrix[2][3]) + " " + shown(matrix[3][3]) + "; allowed: 0 0 0 1");
}

glm::dmat4 parse_look_at(const Element& element) {
  element.check({"origin", "target"}, {"up"});
  const glm::dvec3 origin = element.triple("origin");
  const glm::dvec3 target = element.triple("target");
  if (origin == target) {
    element.fail("origin and target are both " + in_quotes(element.text("target")) +
                 "; allowed: two different points");
  }
  glm::dvec3 up(0.0);
  if (element.has("up")) up = element.triple("up");
  // As in Mitsuba, any direction across the line of sight will do where none is given.
  if (up == glm::dvec3(0.0)) up = coordinate_system(glm::normalize(target - origin)).first;
  if (const auto matrix = look_at(origin, target, up)) return *matrix;
  element.fail("up " + in_quotes(element.text_or_empty("up")) +
               " lies along the direction from origin to target; allowed: any other direction");
}

}  // namespace

void Element::fail(const std::string& message) const {
  std::string description = "<" + tag;
  const auto name = attributes.find("name");
  if (name != attributes.end()) description += " name=" + in_quotes(name->second);
  throw InputError(where, description + ">: " + message);
}

const std::string& Element::text(std::string_view attribute) const {
  const auto at = attributes.find(attribute);
  if (at == attributes.end()) fail("the attribute " + in_quotes(attribute) + " is missing");
  return at->second;
}

std::string Element::text_or_empty(std::string_view attribute) const {
  const auto at = attributes.find(attribute);
  return at == attributes.end() ? std::string() : at->second;
}

void Element::check(std::initializer_list<std::string_view> required,
                    std::initializer_list<std::string_view> optional) const {
  for (const auto& [attribute, value] : attributes) {
    const bool known = std::find(required.begin(), required.end(), attribute) != required.end() ||
                       std::find(optional.begin(), optional.end(), attribute) != optional.end();
    if (!known) {
      fail("unknown attribute " + in_quotes(attribute) +
           "; allowed: " + list_of(required, optional));
    }
  }
  for (const std::string_view attribute : required) {
    if (!has(attribute)) {
      fail("the attribute " + in_quotes(attribute) +
           " is missing; required: " + list_of(required, {}));
    }
  }
}

double Element::number(std::string_view attribute) const {
  if (const auto value = parse_number(text(attribute))) return *value;
  fail("not a number: " + std::string(attribute) + "=" + in_quotes(text(attribute)) +
       std::string(number_rule));
}

std::vector<double> Element::numbers(std::string_view attribute) const {
  std::vector<double> values;
  for (const std::string_view part : split_list(text(attribute))) {
    const auto value = parse_number(part);
    if (!value) {
      fail("not a number: " + in_quotes(part) + " in " + std::string(attribute) + "=" +
           in_quotes(text(attribute)) + std::string(number_rule));
    }
    values.push_back(*value);
  }
  return values;
}

glm::dvec3 Element::triple(std::string_view attribute) const {
  const std::vector<double> values = numbers(attribute);
  if (values.size() == 3) return {values[0], values[1], values[2]};
  fail(std::to_string(values.size()) + " values in " + std::string(attribute) + "=" +
       in_quotes(text(attribute)) + "; allowed: 3 numbers");
}

glm::dvec3 Element::components(double otherwise) const {
  if (has("value")) {
    const std::vector<double> values = numbers("value");
    if (values.size() == 1) return glm::dvec3(values[0]);
    if (values.size() == 3) return {values[0], values[1], values[2]};
    fail(std::to_string(values.size()) + " values in value=" + in_quotes(text("value")) +
         "; allowed: 1 or 3 numbers");
  }
  return {has("x") ? number("x") : otherwise, has("y") ? number("y") : otherwise,
          has("z") ? number("z") : otherwise};
}

const std::vector<std::string>& property_tags() {
  static const std::vector<std::string> tags = {"boolean",  "integer", "float",  "string",   "rgb",
                                                "spectrum", "point",   "vector", "transform"};
  return tags;
}

bool is_property(std::string_view tag) {
  return std::find(property_tags().begin(), property_tags().end(), tag) != property_tags().end();
}

Property read_property(const Element& element) {
  Property property;
  property.name = element.text("name");
  if (property.name.empty()) element.fail("an empty name; allowed: the name of a parameter");
  property.where = element.where;
  property.text = element.text_or_empty("value");
  const std::string& tag = element.tag;
  if (tag == "point" || tag == "vector") {
    property.kind = tag == "point" ? ValueKind::point : ValueKind::vector;
    check_space_attributes(element, {"name"});
    if (!element.has("value")) {
      property.text = element.text("x") + ", " + element.text("y") + ", " + element.text("z");
    }
    property.value = element.components(0.0);
    return property;
  }
  if (tag == "spectrum") {
    element.check({"name"}, {"value", "filename"});
    property.kind = ValueKind::spectrum;
    parse_spectrum(element, property);
    return property;
  }
  element.check({"name", "value"}, {});
  if (tag == "boolean") {
    property.kind = ValueKind::boolean;
    property.value = parse_boolean(element);
  } else if (tag == "integer") {
    property.kind = ValueKind::integer;
    const auto value = parse_integer(property.text);
    if (!value) {
      element.fail("not an integer: " + in_quotes(property.text) +
                   "; allowed: a whole number such as -3 or 64");
    }
    property.value = *value;
  } else if (tag == "float") {
    property.kind = ValueKind::number;
    property.value = element.number("value");
  } else if (tag == "rgb") {
    property.kind = ValueKind::rgb;
    property.value = parse_rgb(element);
  } else {
    property.value = property.text;
  }
  return property;
}

glm::dmat4 read_transform_step(const Element& element) {
  const std::string& tag = element.tag;
  if (tag == "lookat") return parse_look_at(element);
  if (tag == "matrix") return parse_matrix(element);
  if (tag == "translate") {
    check_space_attributes(element, {});
    return translation(element.components(0.0));
  }
  if (tag == "scale") {
    check_space_attributes(element, {});
    return scaling(element.components(1.0));
  }
  if (tag == "rotate") {
    check_space_attributes(element, {"angle"});
    const glm::dvec3 axis = element.components(0.0);
    if (axis == glm::dvec3(0.0)) element.fail("the axis is zero; allowed: any other vector");
    return rotation(axis, element.number("angle"));
  }
  element.fail(
      "unknown element in a <transform>; allowed: translate, rotate, scale, lookat, matrix");
}

}  // namespace renderer
