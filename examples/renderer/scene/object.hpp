// SPDX-License-Identifier: MIT
// One object of a scene file (a shape, a BSDF, ...): its typed parameters and the objects nested in
// it or referred to.
//
// A factory reads what its plugin knows and then calls `reject_unknown`: every getter remembers the
// name it was asked for, so what is left over is what the user misspelt, and what was asked for is
// the list of what is allowed. Every value is finite and of the type the getter promises, or the
// getter throws an InputError with the parameter's line. Objects referred to from several places
// are one object (compare pointers to build each only once). The memory of names is not
// synchronised: read a scene from one thread.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <initializer_list>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "../io/input_error.hpp"
#include "search_path.hpp"

namespace renderer {

enum class ValueKind { boolean, integer, number, string, rgb, spectrum, point, vector, transform };

/// The tag that writes a value of this kind: "<float>", ...
std::string_view tag_of(ValueKind kind);

struct Property {
  std::string name;
  ValueKind kind = ValueKind::string;
  std::string text;  // as written, parameters substituted: what errors show
  Location where;
  /// A spectrum holds a double where it is constant and nothing where it lists wavelengths.
  std::variant<std::monostate, bool, long long, double, std::string, glm::dvec3, glm::dmat4> value;
  std::shared_ptr<const SearchPath> search = {};
};

class Object {
 public:
  using Pointer = std::shared_ptr<const Object>;

  struct Child {
    std::string name;  // empty where the file gives none
    Location where;    // of the element or of the reference
    Pointer object;
  };

  Object(std::string element, std::string type, std::string id, Location where);

  /// "shape", "bsdf", ...; a <spectrum type="..."> is a "texture", as in Mitsuba.
  const std::string& element() const { return element_; }
  /// The plugin's name: the attribute `type`.
  const std::string& type() const { return type_; }
  const std::string& id() const { return id_; }
  const Location& location() const { return where_; }
  /// How errors name it: <shape type="sphere">.
  std::string description() const;

  /// A parameter or a nested object of that name is there. Counts as asking for it.
  bool has(std::string_view name) const;
  /// The kind of the parameter, nothing if there is none. Counts as asking for it.
  std::optional<ValueKind> kind_of(std::string_view name) const;

  // Without a default a parameter is required. A <float> may be written as an <integer>, not the
  // other way round.
  double number(std::string_view name) const;
  double number(std::string_view name, double otherwise) const;
  /// lowest <= value <= highest.
  double number_in(std::string_view name, double otherwise, double lowest, double highest) const;
  /// value > 0.
  double positive(std::string_view name, double otherwise) const;
  long long integer(std::string_view name) const;
  long long integer(std::string_view name, long long otherwise) const;
  long long integer_in(std::string_view name, long long otherwise, long long lowest,
                       long long highest) const;
  bool boolean(std::string_view name, bool otherwise) const;
  std::string string(std::string_view name) const;
  std::string string(std::string_view name, std::string_view otherwise) const;
  std::string one_of(std::string_view name, std::string_view otherwise,
                     std::initializer_list<std::string_view> allowed) const;
  /// A required file name, looked up beside the scene file that wrote it (or in its <path>
  /// folders).
  std::filesystem::path file(std::string_view name) const;

  glm::dvec3 point(std::string_view name) const;
  glm::dvec3 point(std::string_view name, const glm::dvec3& otherwise) const;
  glm::dvec3 vector(std::string_view name) const;
  glm::dvec3 vector(std::string_view name, const glm::dvec3& otherwise) const;
  /// Finite, affine and invertible.
  glm::dmat4 transform(std::string_view name, const glm::dmat4& otherwise = glm::dmat4(1.0)) const;

  /// <rgb>, or a <float>, <integer> or constant <spectrum>, which mean grey.
  glm::dvec3 color(std::string_view name) const;
  glm::dvec3 color(std::string_view name, const glm::dvec3& otherwise) const;
  glm::dvec3 color_in(std::string_view name, const glm::dvec3& otherwise, double lowest,
                      double highest) const;
  /// One number for every wavelength, which Mitsuba also lets people write as <spectrum> or grey
  /// <rgb>.
  double uniform(std::string_view name, double otherwise) const;
  /// The <texture> given in place of a colour; null where a plain value or nothing stands.
  Pointer texture(std::string_view name) const;

  /// All nested objects, in the file's order.
  std::vector<Pointer> children() const;
  /// All nested objects of one element, whatever their names.
  std::vector<Pointer> children(std::string_view element) const;
  /// The nested object of that element, null if there is none; more than one is an error.
  Pointer only_child(std::string_view element) const;
  /// The nested object of that name, null if there is none; one of another element is an error.
  Pointer child(std::string_view name, std::string_view element) const;

  /// Throws at the first parameter or nested object that nobody asked for.
  void reject_unknown() const;
  [[noreturn]] void fail(const std::string& message) const;
  /// The same at the line of a parameter or nested object (at the object's own if it isn't there).
  [[noreturn]] void fail(std::string_view name, const std::string& message) const;

  // For the reader, while the tree is built.
  void add(Property property);
  void add(Child child);
  void set_child(std::size_t index, Pointer object) { children_[index].object = std::move(object); }
  const std::vector<Child>& nested() const { return children_; }
  void set_premises(std::shared_ptr<const Premises> premises) { premises_ = std::move(premises); }
  /// Of the files that the tree and its readers have asked for so far; of the root alone.
  std::vector<std::string> file_warnings() const {
    return premises_ ? premises_->warnings() : std::vector<std::string>();
  }

 private:
  const Property* find(std::string_view name) const;
  const Child* find_child(std::string_view name) const;
  /// The parameter, remembered as asked for; throws if a nested object has the name.
  const Property* ask(std::string_view name, std::string_view allowed) const;
  const Property& require(std::string_view name, std::string_view allowed) const;
  [[noreturn]] void wrong_kind(const Property& property, std::string_view allowed) const;
  void claim(std::string_view name, const Location& where);
  void remember(std::string_view name, std::string_view shown) const;

  double number_of(const Property& property) const;
  long long integer_of(const Property& property) const;
  glm::dvec3 triple_of(const Property& property, std::string_view allowed) const;
  glm::dvec3 color_of(const Property& property) const;

  std::string element_;
  std::string type_;
  std::string id_;
  Location where_;
  std::vector<Property> properties_;
  std::vector<Child> children_;
  std::map<std::string, Location, std::less<>> names_;
  std::shared_ptr<const Premises> premises_;
  mutable std::vector<std::string> asked_;           // names
  mutable std::vector<std::string> asked_elements_;  // elements whose every child was asked for
  mutable std::vector<std::string> allowed_;         // both, as shown
};

}  // namespace renderer
