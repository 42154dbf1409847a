// SPDX-License-Identifier: MIT
#include "references.hpp"

#include <algorithm>

#include "text.hpp"

namespace renderer {

void References::declare(const std::shared_ptr<Object>& object) {
  if (object->id().empty()) return;
  const auto [at, is_new] = objects_.emplace(object->id(), object);
  if (is_new) return;
  const Location& first = at->second->location();
  object->fail("the id " + in_quotes(object->id()) + " is given twice, first in line " +
               std::to_string(first.line) + " of " + first.file + "; allowed: each id once");
}

const std::shared_ptr<Object>& References::find(const std::string& id,
                                                const Location& where) const {
  const auto at = objects_.find(id);
  if (at != objects_.end()) return at->second;
  std::vector<std::string> ids;
  for (const auto& entry : objects_) ids.push_back(entry.first);
  const std::string known = ids.empty() ? "none" : joined(nearest(id, ids));
  throw InputError(where, "unknown id " + in_quotes(id) + "; allowed: " + known +
                              (ids.size() > 8 ? ", ..." : ""));
}

void References::alias(const Element& element) {
  const std::shared_ptr<Object>& object = find(element.text("id"), element.where);
  const std::string& name = element.text("as");
  if (name.empty()) element.fail("an empty id in as=\"\"");
  if (!objects_.emplace(name, object).second) {
    element.fail("the id " + in_quotes(name) + " is taken; allowed: each id once");
  }
}

void References::refer(Object& parent, const Element& element) {
  auto& [owner, list] = references_[&parent];
  owner = &parent;
  list.push_back({parent.nested().size(), element.text("id"), element.where});
  parent.add(Object::Child{element.text_or_empty("name"), element.where, nullptr});
}

int References::height_of(const Object& object, const Location& asker, int depth, int deepest) {
  Visit& visit = visits_[&object];
  if (visit.open) {
    throw InputError(asker, "the reference to " + in_quotes(object.id()) +
                                " closes a cycle: the object would contain itself");
  }
  if (depth + std::max(visit.height, 1) > deepest + 1) {
    throw InputError(asker, "references nested more than " + std::to_string(deepest) +
                                " levels deep; allowed: " + std::to_string(deepest));
  }
  if (visit.height > 0) return visit.height;
  visit.open = true;
  int highest = 0;
  for (const Object::Child& child : object.nested()) {
    if (child.object) {
      highest = std::max(highest, height_of(*child.object, child.where, depth + 1, deepest));
    }
  }
  if (const auto list = references_.find(&object); list != references_.end()) {
    for (const Reference& reference : list->second.second) {
      const auto& target = find(reference.id, reference.where);
      highest = std::max(highest, height_of(*target, reference.where, depth + 1, deepest));
    }
  }
  visit.open = false;
  visit.height = highest + 1;
  return visit.height;
}

void References::resolve(const Object& root, int deepest) {
  height_of(root, root.location(), 1, deepest);
  for (auto& [parent, entry] : references_) {
    for (const Reference& reference : entry.second) {
      entry.first->set_child(reference.child, find(reference.id, reference.where));
    }
  }
}

}  // namespace renderer
