// SPDX-License-Identifier: MIT
// The Stanford PLY format (Turk 1994): a text header that lists elements and their properties, then
// the values in that order as text or binary.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "mesh_reader.hpp"
#include "ply_stream.hpp"
#include "text.hpp"
#include "xml_file.hpp"

namespace renderer {
namespace {

constexpr std::uintmax_t largest_mesh = std::uintmax_t{1} << 32;

/// Where the properties of a vertex that matter are in its row; -1 where there is none.
struct VertexLayout {
  std::array<int, 3> position = {-1, -1, -1};
  std::array<int, 3> normal = {-1, -1, -1};
  std::array<int, 2> texcoord = {-1, -1};

  bool has_normals() const { return normal[0] >= 0 && normal[1] >= 0 && normal[2] >= 0; }
  bool has_texcoords() const { return texcoord[0] >= 0 && texcoord[1] >= 0; }
};

VertexLayout layout_of(const PlyElement& element, const PlyStream& in) {
  VertexLayout layout;
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    const PlyProperty& property = element.properties[i];
    if (property.is_list) continue;
    const int at = static_cast<int>(i);
    const std::string& name = property.name;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const char letter = static_cast<char>('x' + axis);
      if (name == std::string(1, letter)) layout.position[axis] = at;
      if (name == std::string("n") + letter) layout.normal[axis] = at;
    }
    if (name == "u" || name == "s") layout.texcoord[0] = at;
    if (name == "v" || name == "t") layout.texcoord[1] = at;
  }
  if (std::count(layout.position.begin(), layout.position.end(), -1) != 0) {
    in.fail("the element vertex lacks one of its properties x, y, z");
  }
  return layout;
}

class PlyReader {
 public:
  PlyReader(PlyStream& in, bool flip) : in_(in), flip_(flip) {}

  TriangleMesh read() {
    for (const PlyElement& element : in_.elements()) {
      if (element.name == "vertex") {
        read_vertices(element);
      } else if (element.name == "face") {
        read_faces(element);
      } else {
        skip(element);
      }
    }
    in_.expect_end();
    check_indices();
    drop_degenerate_triangles(mesh_);
    if (mesh_.triangles.empty()) {
      in_.fail("no triangle with an area (" + std::to_string(mesh_.dropped) +
               " without); allowed: one or more");
    }
    return std::move(mesh_);
  }

 private:
  static std::string row_name(const PlyElement& element, std::size_t row) {
    return element.name + " " + std::to_string(row);
  }

  void read_vertices(const PlyElement& element) {
    const VertexLayout layout = layout_of(element, in_);
    if (element.count > std::numeric_limits<std::uint32_t>::max()) {
      in_.fail(std::to_string(element.count) + " vertices; allowed: fewer than 2^32");
    }
    // The stream has checked that the file is long enough for so many rows.
    mesh_.positions.reserve(element.count);
    std::vector<double> row(element.properties.size());
    for (std::size_t i = 0; i < element.count; ++i) {
      for (std::size_t p = 0; p < row.size(); ++p) {
        const PlyProperty& property = element.properties[p];
        if (property.is_list) {
          in_.skip_list(property);
        } else {
          row[p] = in_.next(property.type);
        }
      }
      add_vertex(layout, row, row_name(element, i));
    }
  }

  float value_of(const std::vector<double>& row, int at, const std::string& name) const {
    const double value = row[static_cast<std::size_t>(at)];
    const float narrow = static_cast<float>(value);
    if (!is_finite(value) || !is_finite(narrow)) {
      in_.fail(name + " has the value " + shown(value) + "; allowed: finite numbers of 32 bits");
    }
    return narrow;
  }

  void add_vertex(const VertexLayout& layout, const std::vector<double>& row,
                  const std::string& name) {
    const auto get = [&](int at) { return value_of(row, at, name); };
    mesh_.positions.emplace_back(get(layout.position[0]), get(layout.position[1]),
                                 get(layout.position[2]));
    if (layout.has_normals()) {
      const glm::dvec3 normal(get(layout.normal[0]), get(layout.normal[1]), get(layout.normal[2]));
      if (normal == glm::dvec3(0.0)) in_.fail(name + " has a normal of length zero");
      mesh_.normals.emplace_back(glm::normalize(normal));
    }
    if (layout.has_texcoords()) {
      glm::vec2 uv(get(layout.texcoord[0]), get(layout.texcoord[1]));
      if (flip_) uv.y = 1.0F - uv.y;
      mesh_.texcoords.push_back(uv);
    }
  }

  void read_faces(const PlyElement& element) {
    const auto indices = std::find_if(
        element.properties.begin(), element.properties.end(), [](const PlyProperty& property) {
          return property.is_list &&
                 (property.name == "vertex_indices" || property.name == "vertex_index");
        });
    if (indices == element.properties.end()) {
      in_.fail("the element face has no list of indices; allowed: vertex_indices, vertex_index");
    }
    if (is_fraction(indices->type))
      in_.fail("the list of indices is of fractions; allowed: integers");
    mesh_.triangles.reserve(element.count);
    for (std::size_t i = 0; i < element.count; ++i) {
      for (const PlyProperty& property : element.properties) {
        if (&property == &*indices) {
          read_face(property, row_name(element, i));
        } else if (property.is_list) {
          in_.skip_list(property);
        } else {
          in_.next(property.type);
        }
      }
    }
  }

  void read_face(const PlyProperty& property, const std::string& name) {
    const std::size_t corners = in_.list_size(property);
    if (corners < 3) {
      in_.fail(name + " has " + std::to_string(corners) + " corners; allowed: 3 or more");
    }
    std::array<std::uint32_t, 3> triangle{};
    for (std::size_t i = 0; i < corners; ++i) {
      const double index = in_.next(property.type);
      if (index < 0) in_.fail(name + " has the index " + shown(index) + "; allowed: 0 or more");
      const auto corner = static_cast<std::uint32_t>(index);
      if (i < 2) {
        triangle[i] = corner;
        continue;
      }
      triangle[2] = corner;
      mesh_.triangles.push_back(triangle);
      triangle[1] = corner;
    }
  }

  void skip(const PlyElement& element) {
    for (std::size_t i = 0; i < element.count; ++i) {
      for (const PlyProperty& property : element.properties) {
        if (property.is_list) {
          in_.skip_list(property);
        } else {
          in_.next(property.type);
        }
      }
    }
  }

  /// Only now, since a file may list faces before vertices.
  void check_indices() const {
    for (const auto& triangle : mesh_.triangles) {
      for (const std::uint32_t index : triangle) {
        if (index < mesh_.positions.size()) continue;
        in_.fail_whole("a face has the index " + std::to_string(index) + "; allowed: " +
                       (mesh_.positions.empty()
                            ? "none, as there are no vertices"
                            : "0 to " + std::to_string(mesh_.positions.size() - 1)));
      }
    }
  }

  PlyStream& in_;
  bool flip_;
  TriangleMesh mesh_;
};

}  // namespace

TriangleMesh read_ply(const std::filesystem::path& path, bool flip_tex_coords,
                      const Location& asker) {
  PlyStream in(path.string(), read_bytes(path, largest_mesh, asker));
  return PlyReader(in, flip_tex_coords).read();
}

}  // namespace renderer
