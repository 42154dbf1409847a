// SPDX-License-Identifier: MIT
// The ids of a scene's objects and who refers to them. References may precede what they name, as in
// Mitsuba; they are tied only when all is read and known to be free of cycles, so that the tree of
// shared pointers never owns itself.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "element.hpp"
#include "object.hpp"

namespace renderer {

class References {
 public:
  /// Takes the object's id, if it has one; a second object of the same id is an error.
  void declare(const std::shared_ptr<Object>& object);
  /// <alias id="known" as="another">: the id must have been declared before.
  void alias(const Element& element);
  /// <ref id="..."/> in `parent`.
  void refer(Object& parent, const Element& element);

  /// Ties all references. Errors: an unknown id, a cycle, a chain of more than `deepest` objects.
  void resolve(const Object& root, int deepest);

 private:
  struct Reference {
    std::size_t child;  // its place among the parent's nested objects
    std::string id;
    Location where;
  };
  struct Visit {
    bool open = false;  // on the way down from the root
    int height = 0;     // 0 until known
  };

  const std::shared_ptr<Object>& find(const std::string& id, const Location& where) const;
  int height_of(const Object& object, const Location& asker, int depth, int deepest);

  std::map<std::string, std::shared_ptr<Object>> objects_;
  std::map<const Object*, std::pair<Object*, std::vector<Reference>>> references_;
  std::map<const Object*, Visit> visits_;
};

}  // namespace renderer
