// SPDX-License-Identifier: MIT
#include "object.hpp"

#include <algorithm>
#include <utility>

#include "text.hpp"

namespace renderer {
namespace {

constexpr std::string_view number_tags = "<float>";
constexpr std::string_view color_tags = "<rgb>, <float>, <integer>, <spectrum> with a single value";

bool contains(const std::vector<std::string>& list, std::string_view name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

std::string tagged(std::string_view element) {
  return std::string("<").append(element).append(">");
}

std::string range(const std::string& lowest, const std::string& highest) {
  return "allowed: " + lowest + " to " + highest;
}

}  // namespace

std::string_view tag_of(ValueKind kind) {
  switch (kind) {
    case ValueKind::boolean:
      return "<boolean>";
    case ValueKind::integer:
      return "<integer>";
    case ValueKind::number:
      return "<float>";
    case ValueKind::string:
      return "<string>";
    case ValueKind::rgb:
      return "<rgb>";
    case ValueKind::spectrum:
      return "<spectrum>";
    case ValueKind::point:
      return "<point>";
    case ValueKind::vector:
      return "<vector>";
    case ValueKind::transform:
      break;
  }
  return "<transform>";
}

Object::Object(std::string element, std::string type, std::string id, Location where)
    : element_(std::move(element)),
      type_(std::move(type)),
      id_(std::move(id)),
      where_(std::move(where)) {}

std::string Object::description() const {
  return element_ == "scene" ? "<scene>" : "<" + element_ + " type=" + in_quotes(type_) + ">";
}

void Object::fail(const std::string& message) const {
  throw InputError(where_, description() + ": " + message);
}

void Object::fail(std::string_view name, const std::string& message) const {
  const auto at = names_.find(name);
  throw InputError(at == names_.end() ? where_ : at->second, description() + ": " + message);
}

void Object::claim(std::string_view name, const Location& where) {
  if (name.empty()) return;
  const auto [at, is_new] = names_.emplace(name, where);
  if (is_new) return;
  throw InputError(where, description() + ": the name " + in_quotes(name) +
                              " is given twice, first in line " + std::to_string(at->second.line) +
                              " of " + at->second.file + "; allowed: each name once");
}

void Object::add(Property property) {
  claim(property.name, property.where);
  properties_.push_back(std::move(property));
}

void Object::add(Child child) {
  claim(child.name, child.where);
  children_.push_back(std::move(child));
}

const Property* Object::find(std::string_view name) const {
  if (names_.find(name) == names_.end()) return nullptr;
  for (const Property& property : properties_) {
    if (property.name == name) return &property;
  }
  return nullptr;
}

const Object::Child* Object::find_child(std::string_view name) const {
  if (names_.find(name) == names_.end()) return nullptr;
  for (const Child& child : children_) {
    if (child.name == name) return &child;
  }
  return nullptr;
}

void Object::remember(std::string_view name, std::string_view as_shown) const {
  if (contains(asked_, name)) return;
  asked_.emplace_back(name);
  allowed_.emplace_back(as_shown);
}

const Property* Object::ask(std::string_view name, std::string_view allowed) const {
  remember(name, name);
  if (const Child* child = find_child(name)) {
    fail(name, "the parameter " + in_quotes(name) + " is a " + child->object->description() +
                   "; allowed: " + std::string(allowed));
  }
  return find(name);
}

const Property& Object::require(std::string_view name, std::string_view allowed) const {
  if (const Property* property = ask(name, allowed)) return *property;
  fail("the required parameter " + in_quotes(name) +
       " is missing; allowed: " + std::string(allowed));
}

void Object::wrong_kind(const Property& property, std::string_view allowed) const {
  throw InputError(property.where, description() + ": the parameter " + in_quotes(property.name) +
                                       " is a " + std::string(tag_of(property.kind)) +
                                       " of value " + in_quotes(property.text) +
                                       "; allowed: " + std::string(allowed));
}

bool Object::has(std::string_view name) const {
  remember(name, name);
  return names_.find(name) != names_.end();
}

std::optional<ValueKind> Object::kind_of(std::string_view name) const {
  remember(name, name);
  const Property* property = find(name);
  return property ? std::optional(property->kind) : std::nullopt;
}

double Object::number_of(const Property& property) const {
  if (const auto* value = std::get_if<long long>(&property.value)) {
    return static_cast<double>(*value);
  }
  if (property.kind != ValueKind::number) wrong_kind(property, number_tags);
  return std::get<double>(property.value);
}

double Object::number(std::string_view name) const { return number_of(require(name, number_tags)); }

double Object::number(std::string_view name, double otherwise) const {
  const Property* property = ask(name, number_tags);
  return property ? number_of(*property) : otherwise;
}

double Object::number_in(std::string_view name, double otherwise, double lowest,
                         double highest) const {
  const double value = number(name, otherwise);
  if (value >= lowest && value <= highest) return value;
  fail(name, "the parameter " + in_quotes(name) + " is " + shown(value) + "; " +
                 range(shown(lowest), shown(highest)));
}

double Object::positive(std::string_view name, double otherwise) const {
  const double value = number(name, otherwise);
  if (value > 0) return value;
  fail(name, "the parameter " + in_quotes(name) + " is " + shown(value) + "; allowed: more than 0");
}

long long Object::integer_of(const Property& property) const {
  if (property.kind != ValueKind::integer) wrong_kind(property, "<integer>");
  return std::get<long long>(property.value);
}

long long Object::integer(std::string_view name) const {
  return integer_of(require(name, "<integer>"));
}

long long Object::integer(std::string_view name, long long otherwise) const {
  const Property* property = ask(name, "<integer>");
  return property ? integer_of(*property) : otherwise;
}

long long Object::integer_in(std::string_view name, long long otherwise, long long lowest,
                             long long highest) const {
  const long long value = integer(name, otherwise);
  if (value >= lowest && value <= highest) return value;
  fail(name, "the parameter " + in_quotes(name) + " is " + std::to_string(value) + "; " +
                 range(std::to_string(lowest), std::to_string(highest)));
}

bool Object::boolean(std::string_view name, bool otherwise) const {
  const Property* property = ask(name, "<boolean>");
  if (!property) return otherwise;
  if (property->kind != ValueKind::boolean) wrong_kind(*property, "<boolean>");
  return std::get<bool>(property->value);
}

std::string Object::string(std::string_view name) const {
  const Property& property = require(name, "<string>");
  if (property.kind != ValueKind::string) wrong_kind(property, "<string>");
  return std::get<std::string>(property.value);
}

std::string Object::string(std::string_view name, std::string_view otherwise) const {
  return ask(name, "<string>") ? string(name) : std::string(otherwise);
}

std::string Object::one_of(std::string_view name, std::string_view otherwise,
                           std::initializer_list<std::string_view> allowed) const {
  std::string value = string(name, otherwise);
  if (std::find(allowed.begin(), allowed.end(), value) != allowed.end()) return value;
  fail(name, "the parameter " + in_quotes(name) + " is " + in_quotes(value) +
                 "; allowed: " + joined(std::vector<std::string>(allowed.begin(), allowed.end())));
}

std::filesystem::path Object::file(std::string_view name) const {
  const std::string text = string(name);
  if (text.empty()) fail(name, "the parameter " + in_quotes(name) + " is an empty file name");
  const Property& property = *find(name);
  if (!property.search) return text;
  return property.search->find_to_read(text, property.where);
}

glm::dvec3 Object::triple_of(const Property& property, std::string_view allowed) const {
  // Mitsuba takes a <point> for a <vector> and the other way round.
  if (property.kind != ValueKind::point && property.kind != ValueKind::vector) {
    wrong_kind(property, allowed);
  }
  return std::get<glm::dvec3>(property.value);
}

glm::dvec3 Object::point(std::string_view name) const {
  return triple_of(require(name, "<point>"), "<point>");
}

glm::dvec3 Object::point(std::string_view name, const glm::dvec3& otherwise) const {
  const Property* property = ask(name, "<point>");
  return property ? triple_of(*property, "<point>") : otherwise;
}

glm::dvec3 Object::vector(std::string_view name) const {
  return triple_of(require(name, "<vector>"), "<vector>");
}

glm::dvec3 Object::vector(std::string_view name, const glm::dvec3& otherwise) const {
  const Property* property = ask(name, "<vector>");
  return property ? triple_of(*property, "<vector>") : otherwise;
}

glm::dmat4 Object::transform(std::string_view name, const glm::dmat4& otherwise) const {
  const Property* property = ask(name, "<transform>");
  if (!property) return otherwise;
  if (property->kind != ValueKind::transform) wrong_kind(*property, "<transform>");
  return std::get<glm::dmat4>(property->value);
}

glm::dvec3 Object::color_of(const Property& property) const {
  switch (property.kind) {
    case ValueKind::rgb:
      return std::get<glm::dvec3>(property.value);
    case ValueKind::spectrum:
      if (!std::holds_alternative<double>(property.value)) break;
      return glm::dvec3(std::get<double>(property.value));
    case ValueKind::number:
    case ValueKind::integer:
      return glm::dvec3(number_of(property));
    default:
      break;
  }
  wrong_kind(property, color_tags);
}

glm::dvec3 Object::color(std::string_view name) const {
  return color_of(require(name, color_tags));
}

glm::dvec3 Object::color(std::string_view name, const glm::dvec3& otherwise) const {
  const Property* property = ask(name, color_tags);
  return property ? color_of(*property) : otherwise;
}

glm::dvec3 Object::color_in(std::string_view name, const glm::dvec3& otherwise, double lowest,
                            double highest) const {
  const glm::dvec3 value = color(name, otherwise);
  for (int channel = 0; channel < 3; ++channel) {
    if (value[channel] >= lowest && value[channel] <= highest) continue;
    fail(name, "the parameter " + in_quotes(name) + " has the value " + shown(value[channel]) +
                   "; " + range(shown(lowest), shown(highest)));
  }
  return value;
}

double Object::uniform(std::string_view name, double otherwise) const {
  const glm::dvec3 value = color(name, glm::dvec3(otherwise));
  if (value.x == value.y && value.y == value.z) return value.x;
  fail(name, "the parameter " + in_quotes(name) + " is coloured: " + in_quotes(find(name)->text) +
                 "; allowed: one value for every wavelength");
}

Object::Pointer Object::texture(std::string_view name) const {
  remember(name, name);
  const Child* found = find_child(name);
  if (!found) return nullptr;
  if (found->object->element() == "texture") return found->object;
  fail(name, "the parameter " + in_quotes(name) + " is a " + found->object->description() +
                 "; allowed: " + std::string(color_tags) + ", <texture>");
}

std::vector<Object::Pointer> Object::children() const {
  std::vector<Pointer> all;
  for (const Child& child : children_) {
    if (!contains(asked_elements_, child.object->element())) {
      asked_elements_.push_back(child.object->element());
    }
    all.push_back(child.object);
  }
  return all;
}

std::vector<Object::Pointer> Object::children(std::string_view element) const {
  if (!contains(asked_elements_, element)) {
    asked_elements_.emplace_back(element);
    allowed_.push_back(tagged(element));
  }
  std::vector<Pointer> found;
  for (const Child& child : children_) {
    if (child.object->element() == element) found.push_back(child.object);
  }
  return found;
}

Object::Pointer Object::only_child(std::string_view element) const {
  const std::vector<Pointer> found = children(element);
  if (found.size() <= 1) return found.empty() ? nullptr : found.front();
  const auto second = std::find_if(children_.begin(), children_.end(), [&](const Child& child) {
    return child.object->element() == element && child.object != found.front();
  });
  const Location& where = second == children_.end() ? where_ : second->where;
  throw InputError(where, description() + ": " + std::to_string(found.size()) + " nested " +
                              tagged(element) + "; allowed: one");
}

Object::Pointer Object::child(std::string_view name, std::string_view element) const {
  remember(name, std::string("<").append(element).append(" name=" + in_quotes(name) + ">"));
  if (const Property* property = find(name)) wrong_kind(*property, tagged(element));
  const Child* found = find_child(name);
  if (!found) return nullptr;
  if (found->object->element() == element) return found->object;
  fail(name, "the nested object " + in_quotes(name) + " is a " + found->object->description() +
                 "; allowed: " + tagged(element));
}

void Object::reject_unknown() const {
  const std::string allowed =
      allowed_.empty() ? "; allowed: none" : "; allowed: " + joined(allowed_);
  for (const Property& property : properties_) {
    if (contains(asked_, property.name)) continue;
    throw InputError(property.where,
                     description() + ": unknown parameter " + in_quotes(property.name) + allowed);
  }
  for (const Child& child : children_) {
    if (contains(asked_elements_, child.object->element())) continue;
    if (!child.name.empty() && contains(asked_, child.name)) continue;
    std::string name = child.object->description();
    if (!child.name.empty()) name += " of name " + in_quotes(child.name);
    throw InputError(child.where, description() + ": unexpected " + name + allowed);
  }
}

}  // namespace renderer
