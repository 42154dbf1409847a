// SPDX-License-Identifier: MIT
// tinyobjloader reads numbers it can't parse as zeros and doesn't check indices. So each line is
// checked here, where its number is known, and only checked vertex and face lines are handed on.
#include <tiny_obj_loader.h>

#include <algorithm>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <string_view>
#include <unordered_map>

#include "mesh_reader.hpp"
#include "text.hpp"
#include "xml_file.hpp"

namespace renderer {
namespace {

constexpr std::uintmax_t largest_mesh = std::uintmax_t{1} << 32;
constexpr std::size_t most_corners = 255;  // tinyobjloader counts them in a byte

class ObjChecker {
 public:
  explicit ObjChecker(std::string file) : where_{std::move(file), 0} {}

  /// The vertex and face lines of a valid file.
  std::string check(std::string_view text) {
    std::string kept;
    for (std::size_t at = 0; at < text.size();) {
      std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
      ++where_.line;
      check_line(text.substr(at, end - at), kept);
      if (text.substr(end, 2) == "\r\n") ++end;
      at = end + 1;
    }
    return kept;
  }

 private:
  [[noreturn]] void fail(const std::string& message) const { throw InputError(where_, message); }

  void check_line(std::string_view line, std::string& kept) {
    line = line.substr(0, line.find('#'));
    std::vector<std::string_view> words;
    for (const std::string_view word : split_words(line)) words.push_back(word);
    if (words.empty()) return;
    const std::string_view keyword = words[0];
    if (keyword == "v") {
      check_numbers(words, 3, 8);
      count(vertices_);
    } else if (keyword == "vt") {
      check_numbers(words, 1, 3);
      count(texcoords_);
    } else if (keyword == "vn") {
      check_numbers(words, 3, 3);
      check_normal(words);
      count(normals_);
    } else if (keyword == "f") {
      check_face(words);
    } else {
      check_ignored(keyword);
      return;
    }
    // A position's weight or colour is of no use here.
    if (keyword == "v") words.resize(4);
    for (const std::string_view word : words) (kept += word) += ' ';
    kept += '\n';
  }

  static std::vector<std::string_view> split_words(std::string_view line) {
    std::vector<std::string_view> words;
    constexpr std::string_view blanks = " \t\v\f";
    for (std::size_t at = line.find_first_not_of(blanks); at < line.size();) {
      const std::size_t end = std::min(line.find_first_of(blanks, at), line.size());
      words.push_back(line.substr(at, end - at));
      at = line.find_first_not_of(blanks, end);
    }
    return words;
  }

  void check_numbers(const std::vector<std::string_view>& words, std::size_t fewest,
                     std::size_t most) const {
    const std::size_t given = words.size() - 1;
    if (given < fewest || given > most) {
      const std::string allowed =
          std::to_string(fewest) + (most > fewest ? " to " + std::to_string(most) : "");
      fail(in_quotes(words[0]) + " with " + std::to_string(given) +
           " numbers; allowed: " + allowed);
    }
    for (std::size_t i = 1; i < words.size(); ++i) {
      const auto value = parse_number(words[i]);
      if (!value || !is_finite(static_cast<float>(*value))) {
        fail("not a number: " + in_quotes(words[i]) + "; allowed: a finite number of 32 bits");
      }
    }
  }

  void check_normal(const std::vector<std::string_view>& words) const {
    for (std::size_t i = 1; i < 4; ++i) {
      if (static_cast<float>(parse_number(words[i]).value_or(0.0)) != 0.0F) return;
    }
    fail("a normal of length zero; allowed: any other vector");
  }

  void count(long long& counter) const {
    if (++counter > std::numeric_limits<std::int32_t>::max() / 3) {
      fail("too many vertices; allowed: " +
           std::to_string(std::numeric_limits<std::int32_t>::max() / 3));
    }
  }

  void check_face(const std::vector<std::string_view>& words) const {
    const std::size_t corners = words.size() - 1;
    if (corners < 3 || corners > most_corners) {
      fail("a face of " + std::to_string(corners) + " corners; allowed: 3 to " +
           std::to_string(most_corners));
    }
    for (std::size_t i = 1; i < words.size(); ++i) check_corner(words[i]);
  }

  /// v, v/vt, v//vn or v/vt/vn.
  void check_corner(std::string_view corner) const {
    const std::size_t first = corner.find('/');
    check_index(corner.substr(0, first), vertices_, "vertex", corner);
    if (first == std::string_view::npos) return;
    const std::string_view rest = corner.substr(first + 1);
    const std::size_t second = rest.find('/');
    const std::string_view texcoord = rest.substr(0, second);
    const bool has_normal = second != std::string_view::npos;
    if (!texcoord.empty() || !has_normal) {
      check_index(texcoord, texcoords_, "texture coordinate", corner);
    }
    if (has_normal) check_index(rest.substr(second + 1), normals_, "normal", corner);
  }

  void check_index(std::string_view text, long long known, const char* what,
                   std::string_view corner) const {
    const auto index = parse_integer(text);
    if (index && ((*index >= 1 && *index <= known) || (*index <= -1 && *index >= -known))) return;
    const std::string allowed =
        known == 0 ? std::string("none, as none stands before this line")
                   : "1 to " + std::to_string(known) + ", or -" + std::to_string(known) + " to -1";
    fail(std::string("no such ") + what + ": " + in_quotes(text) + " in " + in_quotes(corner) +
         "; allowed: " + allowed);
  }

  void check_ignored(std::string_view keyword) const {
    for (const std::string_view ignored :
         {"o", "g", "s", "mg", "usemtl", "mtllib", "usemap", "maplib", "l", "p", "vp", "vw", "lod",
          "bevel", "c_interp", "d_interp", "shadow_obj", "trace_obj"}) {
      if (keyword == ignored) return;
    }
    fail("unknown statement " + in_quotes(keyword) +
         "; allowed: v, vt, vn, f, and passed over: o, g, s, usemtl, mtllib, l, p");
  }

  Location where_;
  long long vertices_ = 0;
  long long texcoords_ = 0;
  long long normals_ = 0;
};

/// Gives each different corner one vertex.
class Weld {
 public:
  Weld(const tinyobj::attrib_t& attributes, bool flip, TriangleMesh& mesh)
      : attributes_(attributes), flip_(flip), mesh_(mesh) {}

  std::uint32_t vertex(const tinyobj::index_t& corner) {
    const Key key{corner.vertex_index, corner.texcoord_index, corner.normal_index};
    const auto [at, is_new] =
        known_.emplace(key, static_cast<std::uint32_t>(mesh_.positions.size()));
    if (is_new) add(corner);
    return at->second;
  }

  /// Fills in what only some corners have, and leaves out what none has.
  void finish() {
    if (!has_texcoords_) mesh_.texcoords.clear();
    if (without_normal_.size() == mesh_.positions.size()) {
      mesh_.normals.clear();
    } else if (!without_normal_.empty()) {
      const std::vector<glm::vec3> computed = vertex_normals(mesh_);
      for (const std::size_t i : without_normal_) mesh_.normals[i] = computed[i];
    }
  }

 private:
  using Key = std::array<int, 3>;
  struct Hash {
    std::size_t operator()(const Key& key) const {
      std::uint64_t sum = 0;
      for (const int part : key) {
        sum = (sum ^ static_cast<std::uint32_t>(part)) * 0x9e3779b97f4a7c15U;
        sum ^= sum >> 29;
      }
      return static_cast<std::size_t>(sum);
    }
  };

  static float at(const std::vector<tinyobj::real_t>& list, int width, int index, int part) {
    return static_cast<float>(
        list.at(static_cast<std::size_t>(index) * static_cast<std::size_t>(width) +
                static_cast<std::size_t>(part)));
  }

  void add(const tinyobj::index_t& corner) {
    const auto& v = attributes_.vertices;
    const int i = corner.vertex_index;
    mesh_.positions.emplace_back(at(v, 3, i, 0), at(v, 3, i, 1), at(v, 3, i, 2));
    glm::vec2 uv(0.0F);
    if (const int t = corner.texcoord_index; t >= 0) {
      has_texcoords_ = true;
      uv = {at(attributes_.texcoords, 2, t, 0), at(attributes_.texcoords, 2, t, 1)};
      if (flip_) uv.y = 1.0F - uv.y;
    }
    mesh_.texcoords.push_back(uv);
    glm::dvec3 normal(0.0, 0.0, 1.0);
    if (const int n = corner.normal_index; n >= 0) {
      const auto& list = attributes_.normals;
      normal = glm::normalize(glm::dvec3(at(list, 3, n, 0), at(list, 3, n, 1), at(list, 3, n, 2)));
    } else {
      without_normal_.push_back(mesh_.positions.size() - 1);
    }
    mesh_.normals.emplace_back(normal);
  }

  const tinyobj::attrib_t& attributes_;
  bool flip_;
  TriangleMesh& mesh_;
  std::unordered_map<Key, std::uint32_t, Hash> known_;
  std::vector<std::size_t> without_normal_;
  bool has_texcoords_ = false;
};

}  // namespace

TriangleMesh read_obj(const std::filesystem::path& path, bool flip_tex_coords,
                      const Location& asker) {
  const Location whole{path.string(), 0};
  std::istringstream checked(ObjChecker(whole.file).check(read_bytes(path, largest_mesh, asker)));
  tinyobj::attrib_t attributes;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> materials;
  std::string warning;
  std::string error;
  if (!tinyobj::LoadObj(&attributes, &shapes, &materials, &warning, &error, &checked, nullptr,
                        /*triangulate=*/false, /*default_vcols_fallback=*/false)) {
    throw InputError(whole, "malformed OBJ: " + std::string(trimmed(error)));
  }
  TriangleMesh mesh;
  Weld weld(attributes, flip_tex_coords, mesh);
  for (const tinyobj::shape_t& shape : shapes) {
    std::size_t first = 0;
    for (const unsigned corners : shape.mesh.num_face_vertices) {
      for (std::size_t i = 2; i < corners; ++i) {
        mesh.triangles.push_back({weld.vertex(shape.mesh.indices.at(first)),
                                  weld.vertex(shape.mesh.indices.at(first + i - 1)),
                                  weld.vertex(shape.mesh.indices.at(first + i))});
      }
      first += corners;
    }
  }
  drop_degenerate_triangles(mesh);
  weld.finish();
  if (mesh.triangles.empty()) {
    throw InputError(whole, "no triangle with an area (" + std::to_string(mesh.dropped) +
                                " without); allowed: one or more");
  }
  return mesh;
}

}  // namespace renderer
