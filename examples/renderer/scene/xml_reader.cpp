// SPDX-License-Identifier: MIT
#include "xml_reader.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "element.hpp"
#include "parameters.hpp"
#include "references.hpp"
#include "text.hpp"
#include "transform.hpp"
#include "xml_file.hpp"

namespace renderer {
namespace {

constexpr int deepest_nesting = 64;
constexpr std::size_t deepest_include = 15;  // Mitsuba's limit
/// A file that includes another ten times, which includes ... makes as many as a bomb wants.
constexpr std::size_t most_includes = 10000;
/// Of all files, each as often as it is included: few files, included often, make much as well.
constexpr std::size_t most_elements = 2'000'000;
constexpr std::uintmax_t most_bytes = std::uintmax_t{1} << 28;

const std::vector<std::string>& object_tags() {
  static const std::vector<std::string> tags = {"bsdf",   "emitter", "film",    "integrator",
                                                "medium", "phase",   "rfilter", "sampler",
                                                "sensor", "shape",   "texture", "volume"};
  return tags;
}

bool is_object(std::string_view tag) {
  return std::find(object_tags().begin(), object_tags().end(), tag) != object_tags().end();
}

bool is_transform_step(std::string_view tag) {
  return tag == "translate" || tag == "rotate" || tag == "scale" || tag == "lookat" ||
         tag == "matrix";
}

/// A file while it is read, and the folders its file names are looked up in.
struct OpenFile {
  XmlFile xml;
  std::filesystem::path canonical;
  std::shared_ptr<SearchPath> search;
};

class Reader {
 public:
  Reader(const std::map<std::string, std::string>& definitions, std::shared_ptr<Premises> premises)
      : parameters_(definitions), premises_(std::move(premises)) {}

  std::shared_ptr<const Object> read(const std::filesystem::path& path) {
    const OpenFile file = open(path, SearchPath(premises_), {});
    const Element element = element_of(file, file.xml.root());
    if (element.tag != "scene") {
      element.fail("not the root of a scene; allowed: <scene version=\"3.0.0\">");
    }
    const auto scene = make_root(element);
    scene->set_premises(premises_);
    references_.declare(scene);
    read_children(file, file.xml.root(), *scene, 1);
    parameters_.reject_unused(file.xml.name());
    references_.resolve(*scene, deepest_nesting);
    return scene;
  }

 private:
  OpenFile open(const std::filesystem::path& path, const SearchPath& outer,
                const Location& asker) const {
    auto search = std::make_shared<SearchPath>(outer);
    search->put_first(path.parent_path());
    std::error_code ignored;
    return {XmlFile(path, asker), std::filesystem::weakly_canonical(path, ignored), search};
  }

  Element element_of(const OpenFile& file, const pugi::xml_node& node) {
    Element element{node.name(), file.xml.at(node), {}};
    if (++elements_ > most_elements) {
      element.fail("the scene has more than " + std::to_string(most_elements) +
                   " elements, those of included files among them; allowed: " +
                   std::to_string(most_elements));
    }
    for (const pugi::xml_attribute attribute : node.attributes()) {
      std::string value = parameters_.substitute(attribute.value(), element.where);
      if (!element.attributes.emplace(attribute.name(), std::move(value)).second) {
        element.fail("the attribute " + in_quotes(attribute.name()) + " is given twice");
      }
    }
    return element;
  }

  static void check_version(const Element& element) {
    const std::string& version = element.text("version");
    int parts = 1;
    bool well_formed = !version.empty();
    for (std::size_t i = 0; i < version.size(); ++i) {
      if (version[i] == '.') {
        ++parts;
      } else if (version[i] < '0' || version[i] > '9') {
        well_formed = false;
      }
    }
    if (!well_formed || parts != 3 || version.substr(0, 2) != "3.") {
      element.fail("version " + in_quotes(version) + "; allowed: 3.x.y, such as 3.0.0");
    }
  }

  static std::shared_ptr<Object> make_root(const Element& element) {
    if (element.tag == "scene") {
      element.check({"version"}, {"type", "id", "name"});
      if (element.has("type") && element.text("type") != "scene") {
        element.fail("type " + in_quotes(element.text("type")) + "; allowed: scene");
      }
    } else {
      element.check({"version", "type"}, {"id", "name"});
    }
    check_version(element);
    return make_object(element);
  }

  static std::shared_ptr<Object> make_object(const Element& element) {
    // As in Mitsuba a <spectrum> with a type is a texture.
    const std::string kind = element.tag == "spectrum" ? "texture" : element.tag;
    const std::string type = kind == "scene" ? kind : element.text("type");
    if (type.empty()) element.fail("an empty type; allowed: the name of a plugin");
    if (element.has("id") && element.text("id").empty()) element.fail("an empty id");
    return std::make_shared<Object>(kind, type, element.text_or_empty("id"), element.where);
  }

  void read_children(const OpenFile& file, const pugi::xml_node& node, Object& parent, int depth) {
    for (const pugi::xml_node child : node.children()) {
      if (child.type() == pugi::node_element) {
        read_child(file, child, parent, depth);
      } else {
        reject_text(file, child);
      }
    }
  }

  static void reject_text(const OpenFile& file, const pugi::xml_node& node) {
    throw InputError(file.xml.at(node), "<" + std::string(node.parent().name()) + ">: stray text " +
                                            in_quotes(trimmed(node.value())) +
                                            "; allowed: elements and comments");
  }

  void read_child(const OpenFile& file, const pugi::xml_node& node, Object& parent, int depth) {
    const Element element = element_of(file, node);
    const std::string& tag = element.tag;
    if (is_object(tag) || (tag == "spectrum" && element.has("type"))) {
      element.check({"type"}, {"id", "name"});
      add_object(file, node, make_object(element), element, parent, depth);
    } else if (tag == "transform") {
      parent.add(read_transform(file, node, element));
    } else if (is_property(tag)) {
      reject_content(file, node);
      Property property = read_property(element);
      property.search = file.search;
      parent.add(std::move(property));
    } else {
      read_directive(file, node, element, parent, depth);
    }
  }

  void add_object(const OpenFile& file, const pugi::xml_node& node, std::shared_ptr<Object> object,
                  const Element& element, Object& parent, int depth) {
    if (depth >= deepest_nesting) {
      element.fail("nested more than " + std::to_string(deepest_nesting) +
                   " levels deep; allowed: " + std::to_string(deepest_nesting));
    }
    references_.declare(object);
    parent.add(Object::Child{element.text_or_empty("name"), element.where, object});
    read_children(file, node, *object, depth + 1);
  }

  Property read_transform(const OpenFile& file, const pugi::xml_node& node,
                          const Element& element) {
    element.check({"name"}, {});
    if (element.text("name").empty()) element.fail("an empty name");
    glm::dmat4 matrix(1.0);
    for (const pugi::xml_node child : node.children()) {
      if (child.type() != pugi::node_element) reject_text(file, child);
      const Element step = element_of(file, child);
      // Later steps act on what the earlier ones give.
      matrix = read_transform_step(step) * matrix;
      reject_content(file, child);
      if (!is_finite(matrix)) step.fail("the transform overflows; allowed: finite numbers");
      if (is_singular(matrix)) {
        step.fail("the transform cannot be inverted; allowed: no zero scale, independent axes");
      }
    }
    return {element.text("name"), ValueKind::transform, "(matrix)", element.where, matrix};
  }

  static void reject_content(const OpenFile& file, const pugi::xml_node& node) {
    const pugi::xml_node content = node.first_child();
    if (!content) return;
    if (content.type() != pugi::node_element) reject_text(file, content);
    throw InputError(file.xml.at(content), "<" + std::string(content.name()) + "> inside of <" +
                                               node.name() + ">; allowed: nothing");
  }

  void read_directive(const OpenFile& file, const pugi::xml_node& node, const Element& element,
                      Object& parent, int depth) {
    const std::string& tag = element.tag;
    const bool known =
        tag == "default" || tag == "include" || tag == "ref" || tag == "alias" || tag == "path";
    if (!known) reject_element(element);
    reject_content(file, node);
    if (tag == "default") {
      element.check({"name", "value"}, {});
      parameters_.set_default(element);
    } else if (tag == "include") {
      element.check({"filename"}, {"name"});
      include(file, element, parent, depth);
    } else if (tag == "ref") {
      element.check({"id"}, {"name"});
      references_.refer(parent, element);
    } else if (tag == "alias") {
      element.check({"id", "as"}, {});
      references_.alias(element);
    } else {
      element.check({"value"}, {});
      add_path(file, node, element);
    }
  }

  [[noreturn]] static void reject_element(const Element& element) {
    if (element.tag == "scene") element.fail("inside of an object; allowed: as a file's root only");
    if (is_transform_step(element.tag)) element.fail("outside of a <transform>");
    element.fail("unknown element; allowed: " + joined(object_tags()) + ", " +
                 joined(property_tags()) + ", ref, include, default, alias, path");
  }

  void add_path(const OpenFile& file, const pugi::xml_node& node, const Element& element) {
    if (node.parent() != file.xml.root()) element.fail("inside of an object; allowed: in <scene>");
    const std::filesystem::path folder = file.search->find(element.text("value"), own_folder(file));
    std::error_code ignored;
    if (!std::filesystem::is_directory(folder, ignored)) {
      element.fail("no such folder: " + in_quotes(folder.string()));
    }
    file.search->put_first(folder);
  }

  static std::filesystem::path own_folder(const OpenFile& file) {
    return std::filesystem::path(file.xml.name()).parent_path();
  }

  void include(const OpenFile& outer, const Element& element, Object& parent, int depth) {
    if (element.text("filename").empty()) element.fail("an empty file name");
    if (including_.size() + 1 >= deepest_include) {
      element.fail("more than " + std::to_string(deepest_include) +
                   " files deep; allowed: " + std::to_string(deepest_include));
    }
    if (++includes_ > most_includes) {
      element.fail("more than " + std::to_string(most_includes) + " files are included in all");
    }
    const auto path = outer.search->find_to_read(element.text("filename"), element.where);
    const OpenFile file = open(path, *outer.search, element.where);
    if ((bytes_ += file.xml.size()) > most_bytes) {
      element.fail("with the file " + in_quotes(file.xml.name()) + " the included files have " +
                   std::to_string(bytes_) + " bytes; allowed: " + std::to_string(most_bytes) +
                   " in all");
    }
    including_.push_back(outer.canonical);
    if (std::find(including_.begin(), including_.end(), file.canonical) != including_.end()) {
      element.fail("the file " + in_quotes(file.xml.name()) + " includes itself");
    }
    read_included(file, element, parent, depth);
    including_.pop_back();
  }

  /// What is in a <scene> joins the parent; another root is itself an object in it.
  void read_included(const OpenFile& file, const Element& include, Object& parent, int depth) {
    const pugi::xml_node root = file.xml.root();
    Element element = element_of(file, root);
    const bool is_scene = element.tag == "scene";
    if (!is_scene && !is_object(element.tag)) {
      element.fail("not the root of a file to include; allowed: scene, " + joined(object_tags()));
    }
    const auto object = make_root(element);
    if (is_scene) {
      if (include.has("name")) include.fail("a whole <scene> takes no name");
      read_children(file, root, parent, depth);
      return;
    }
    if (include.has("name")) element.attributes["name"] = include.text("name");
    add_object(file, root, object, element, parent, depth);
  }

  Parameters parameters_;
  References references_;
  std::shared_ptr<Premises> premises_;
  std::vector<std::filesystem::path> including_;
  std::size_t includes_ = 0, elements_ = 0;
  std::uintmax_t bytes_ = 0;  // of included files
};

}  // namespace

std::shared_ptr<const Object> read_scene(const std::filesystem::path& path,
                                         const std::map<std::string, std::string>& definitions,
                                         OutsideFiles outside) {
  return Reader(definitions, std::make_shared<Premises>(path, outside)).read(path);
}

}  // namespace renderer
