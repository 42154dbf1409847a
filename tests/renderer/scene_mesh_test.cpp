// SPDX-License-Identifier: MIT
// Meshes arrive as their files say, and a file that says something impossible is an error.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "scene/mesh_reader.hpp"
#include "scene_files.hpp"

using namespace scene_test;
using renderer::TriangleMesh;

namespace {

using Triangle = std::array<std::uint32_t, 3>;

TriangleMesh obj(std::string_view text, bool flip = true) {
  const Folder folder;
  return renderer::read_obj(folder.write("m.obj", text), flip);
}
std::string obj_error(std::string_view text) {
  return error_of([&] { obj(text); });
}
TriangleMesh ply(std::string_view bytes, bool flip = false) {
  const Folder folder;
  return renderer::read_ply(folder.write("m.ply", bytes), flip);
}
std::string ply_error(std::string_view bytes) {
  return error_of([&] { ply(bytes); });
}

constexpr const char* corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

std::string ply_header(const std::string& format, const std::string& elements) {
  return "ply\nformat " + format + " 1.0\n" + elements + "end_header\n";
}

const std::string plain_elements =
    "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\n";

const std::string ascii_triangle =
    ply_header("ascii", plain_elements) + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

template <typename T>
void append(std::string& bytes, T value, bool big) {
  std::array<char, sizeof(T)> raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
  if (big) std::reverse(raw.begin(), raw.end());
  bytes.append(raw.data(), raw.size());
}

/// A triangle with normals, colours to skip, doubles and texture coordinates.
std::string binary_triangle(bool big) {
  std::string bytes =
      ply_header(big ? "binary_big_endian" : "binary_little_endian",
                 "comment made by a test\nelement vertex 3\nproperty double x\nproperty double y\n"
                 "property double z\nproperty uchar red\nproperty float nx\nproperty float ny\n"
                 "property float nz\nproperty float s\nproperty float t\nelement edge 1\n"
                 "property list uint8 int16 ends\nelement face 1\nproperty uint8 flags\n"
                 "property list uint16 uint32 vertex_index\n");
  const std::array<glm::dvec3, 3> positions = {glm::dvec3(0), glm::dvec3(1, 0, 0),
                                               glm::dvec3(0, 1, 0)};
  for (const glm::dvec3& p : positions) {
    for (int i = 0; i < 3; ++i) append(bytes, p[i], big);
    append(bytes, std::uint8_t{200}, big);
    for (const float n : {0.0F, 0.0F, 2.0F}) append(bytes, n, big);
    append(bytes, 0.25F, big);
    append(bytes, 0.75F, big);
  }
  append(bytes, std::uint8_t{2}, big);
  append(bytes, std::int16_t{-1}, big);
  append(bytes, std::int16_t{300}, big);
  append(bytes, std::uint8_t{9}, big);
  append(bytes, std::uint16_t{3}, big);
  for (const std::uint32_t i : {0U, 1U, 2U}) append(bytes, i, big);
  return bytes;
}

}  // namespace

TEST_CASE("scene mesh: an obj's polygons become fans and corners alike one vertex") {
  const TriangleMesh mesh = obj(std::string(corners) + "f 1 2 3 4\n");
  CHECK(mesh.positions.size() == 4);
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
  CHECK(mesh.normals.empty());
  CHECK(mesh.texcoords.empty());
  CHECK(mesh.positions[2] == glm::vec3(1, 1, 0));
}

TEST_CASE("scene mesh: an obj's vertices are parted where texture coordinates or normals differ") {
  const TriangleMesh mesh = obj(std::string(corners) +
                                "vt 0 0\nvt 0.25 0.125\nvn 0 0 2\nvn 0 3 0\n"
                                "f 1/1/1 2/2/1 3/1/1\nf 1/1/1 3/1/2 4/1/1\n");
  CHECK(mesh.positions.size() == 5);
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 3, 4}});
  CHECK(mesh.normals[0] == glm::vec3(0, 0, 1));
  CHECK(mesh.normals[3] == glm::vec3(0, 1, 0));
  CHECK(mesh.texcoords[1] == glm::vec2(0.25F, 0.875F));
  CHECK(obj(std::string(corners) + "vt 0.25 0.125\nf 1/1 2/1 3/1\n", false).texcoords[0] ==
        glm::vec2(0.25F, 0.125F));
}

TEST_CASE("scene mesh: an obj counts back from its end with negative indices") {
  const TriangleMesh mesh = obj(std::string(corners) + "vn 0 0 1\nf -4//-1 -3//-1 -2//-1\n");
  CHECK(mesh.positions[0] == glm::vec3(0, 0, 0));
  CHECK(mesh.positions[2] == glm::vec3(1, 1, 0));
}

TEST_CASE("scene mesh: corners without a normal get their faces' where others have one") {
  const TriangleMesh mesh = obj(std::string(corners) + "vn 1 0 0\nf 1//1 2 3\n");
  CHECK(mesh.normals[0] == glm::vec3(1, 0, 0));
  CHECK(mesh.normals[1] == glm::vec3(0, 0, 1));
}

TEST_CASE("scene mesh: an obj's comments, groups, colours and line endings do no harm") {
  const TriangleMesh mesh = obj(
      "# made by hand\r\nmtllib a.mtl\r\no thing\r\nv 0 0 0 1 0 0\r\nv 1 0 0 # x\r\n\tv 0 1 0 1\r\n"
      "usemtl b\r\ns off\r\nf 1 2 3");
  CHECK(mesh.triangles.size() == 1);
  CHECK(mesh.positions[1] == glm::vec3(1, 0, 0));
}

TEST_CASE("scene mesh: triangles without an area are dropped and counted") {
  const TriangleMesh mesh = obj(std::string(corners) + "v 2 0 0\nf 1 2 3\nf 1 1 2\nf 1 2 5\n");
  CHECK(mesh.triangles.size() == 1);
  CHECK(mesh.dropped == 2);
  CHECK_MESSAGE_HAS(obj_error(std::string(corners) + "f 1 1 2\n"), "m.obj: ", "(1 without)");
  // Small is not degenerate.
  CHECK(obj("v 0 0 0\nv 1e-30 0 0\nv 0 1e-30 0\nf 1 2 3\n").triangles.size() == 1);
}

TEST_CASE("scene mesh: what is wrong in an obj is told with its line and value") {
  const std::string v = corners;
  CHECK_MESSAGE_HAS(obj_error(""), "m.obj: ", "no triangle");
  CHECK_MESSAGE_HAS(obj_error(v), "no triangle");
  CHECK_MESSAGE_HAS(obj_error("v 0 0\n"), "m.obj:1: ", "\"v\" with 2 numbers", "allowed: 3");
  CHECK_MESSAGE_HAS(obj_error("\nv 0 nan 0\n"), "m.obj:2: ", "\"nan\"", "finite");
  CHECK_MESSAGE_HAS(obj_error("v 0 1e300 0\n"), "\"1e300\"");
  CHECK_MESSAGE_HAS(obj_error("v 0 0 a\n"), "\"a\"");
  CHECK_MESSAGE_HAS(obj_error("vn 0 0 0\n"), "length zero");
  CHECK_MESSAGE_HAS(obj_error(v + "f 1 2 5\n"), "m.obj:5: ", "vertex: \"5\"", "1 to 4");
  CHECK_MESSAGE_HAS(obj_error(v + "f 0 1 2\n"), "\"0\"", "-4 to -1");
  CHECK_MESSAGE_HAS(obj_error(v + "f -5 1 2\n"), "\"-5\"");
  CHECK_MESSAGE_HAS(obj_error(v + "f 1/1 2/1 3/1\n"), "texture coordinate: \"1\" in \"1/1\"",
                    "none");
  CHECK_MESSAGE_HAS(obj_error(v + "f 1//2 2//1 3//1\n"), "normal: \"2\"");
  CHECK_MESSAGE_HAS(obj_error(v + "f 1/ 2/ 3/\n"), "texture coordinate: \"\"");
  CHECK_MESSAGE_HAS(obj_error(v + "f 1///1 2 3\n"), "normal");
  CHECK_MESSAGE_HAS(obj_error(v + "f 1 2 99999999999999999999\n"), "vertex");
  CHECK_MESSAGE_HAS(obj_error(v + "f 1 2\n"), "m.obj:5: ", "face of 2 corners", "3 to 255");
  CHECK_MESSAGE_HAS(obj_error(v + "f 1 2 x\n"), "\"x\"");
  CHECK_MESSAGE_HAS(obj_error("hello\n"), "m.obj:1: ", "\"hello\"", "allowed: v, vt, vn, f");
  std::string many = v + "f";
  for (int i = 0; i < 256; ++i) many += " 1";
  CHECK_MESSAGE_HAS(obj_error(many + "\n"), "face of 256 corners");
}

TEST_CASE("scene mesh: a mesh file that isn't there is an error where it is asked for") {
  const renderer::Location asker{"scene.xml", 7};
  CHECK_MESSAGE_HAS(error_of([&] { renderer::read_obj("/no/such.obj", true, asker); }),
                    "scene.xml:7: ", "/no/such.obj", "no such file");
  CHECK_MESSAGE_HAS(error_of([&] { renderer::read_ply("/tmp", false); }), "/tmp: is a folder");
}

TEST_CASE("scene mesh: an ascii ply is read, with its polygons as fans") {
  const TriangleMesh mesh = ply(ascii_triangle);
  CHECK(mesh.positions ==
        std::vector<glm::vec3>{glm::vec3(0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)});
  CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}});
  CHECK(mesh.normals.empty());
  const TriangleMesh pentagon =
      ply(ply_header("ascii",
                     "element face 1\nproperty list uchar int vertex_indices\nelement vertex 5\n"
                     "property float x\nproperty float y\nproperty float z\nproperty float u\n"
                     "property float v\n") +
              "5 0 1 2 3 4\n0 0 0 0 0\n2 0 0 1 0.25\n3 2 0 0 0\n1 3 0 0 0\n-1 2 0 0 0",
          true);
  CHECK(pentagon.triangles == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}});
  CHECK(pentagon.texcoords[1] == glm::vec2(1, 0.75));
}

TEST_CASE("scene mesh: a binary ply of either byte order is read, unknown properties skipped") {
  for (const bool big : {false, true}) {
    const TriangleMesh mesh = ply(binary_triangle(big));
    CHECK(mesh.positions[1] == glm::vec3(1, 0, 0));
    CHECK(mesh.normals == std::vector<glm::vec3>(3, glm::vec3(0, 0, 1)));
    CHECK(mesh.texcoords[2] == glm::vec2(0.25F, 0.75F));
    CHECK(mesh.triangles == std::vector<Triangle>{{0, 1, 2}});
  }
}

TEST_CASE("scene mesh: a ply cut off anywhere is an error, never a crash") {
  for (const std::string& whole : {ascii_triangle, binary_triangle(false)}) {
    for (std::size_t length = 0; length < whole.size() - 2; ++length) {
      CAPTURE(length);
      CHECK(contains(ply_error(whole.substr(0, length)), "m.ply"));
    }
  }
}

TEST_CASE("scene mesh: a ply's header is not believed beyond the file's size") {
  const auto vertices = [](const std::string& count, const std::string& format) {
    return ply_header(format, "element vertex " + count +
                                  "\nproperty float x\nproperty float y\nproperty float z\n");
  };
  for (const char* format : {"ascii", "binary_little_endian"}) {
    CHECK_MESSAGE_HAS(ply_error(vertices("9000000000000000000", format) + "0 0 0\n"),
                      "9000000000000000000 of \"vertex\"", "truncated");
  }
  CHECK_MESSAGE_HAS(ply_error(vertices("99999999999999999999", "ascii")), "m.ply:3: ", "count");
  CHECK_MESSAGE_HAS(ply_error(vertices("-1", "ascii")), "\"-1\"");
  CHECK_MESSAGE_HAS(ply_error(ply_header("ascii", "element edge 1000000000000\n")),
                    "no properties");
  std::string list =
      ply_header("binary_little_endian", "element face 1\nproperty list uint int vertex_indices\n");
  append(list, std::uint32_t{4000000000U}, false);
  CHECK_MESSAGE_HAS(ply_error(list), "list of 4000000000", "allowed: 0 to 0");
}

TEST_CASE("scene mesh: what is wrong in a ply is told with its line and value") {
  const auto body = [](const std::string& text) {
    return ply_header("ascii", plain_elements) + text;
  };
  CHECK_MESSAGE_HAS(ply_error("plx\n"), "m.ply:1: ", "not a PLY file");
  CHECK_MESSAGE_HAS(ply_error("ply\nformat binary 1.0\n"), "m.ply:2: ", "\"binary\"",
                    "allowed: ascii");
  CHECK_MESSAGE_HAS(ply_error("ply\nformat ascii 2.0\n"), "m.ply:2: ", "format ascii 1.0");
  CHECK_MESSAGE_HAS(ply_error("ply\nend_header\n"), "no format");
  CHECK_MESSAGE_HAS(ply_error("ply\nelement vertex 1\nproperty half x\n"), "m.ply:3: ", "\"half\"",
                    "float64");
  CHECK_MESSAGE_HAS(ply_error("ply\nproperty float x\n"), "before the first element");
  CHECK_MESSAGE_HAS(ply_error("ply\nfoo\n"), "m.ply:2: ", "\"foo\"");
  CHECK_MESSAGE_HAS(ply_error(body("0 0 0\n1 0 0\n0 nan 0\n3 0 1 2\n")), "m.ply:12: ", "\"nan\"");
  CHECK_MESSAGE_HAS(ply_error(body("0 0 0\n1 0 0\n0 1e300 0\n3 0 1 2\n")),
                    "m.ply:12: ", "vertex 2 has the value 1e+300");
  CHECK_MESSAGE_HAS(ply_error(body("0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n")), "index 3",
                    "allowed: 0 to 2");
  CHECK_MESSAGE_HAS(ply_error(body("0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n")),
                    "m.ply:13: ", "face 0 has the index -1");
  CHECK_MESSAGE_HAS(ply_error(body("0 0 0\n1 0 0\n0 1 0\n3 0 1 1.5\n")), "\"1.5\"", "whole");
  CHECK_MESSAGE_HAS(ply_error(body("0 0 0\n1 0 0\n0 1 0\n2 0 1 2\n")), "2 corners");
  CHECK_MESSAGE_HAS(ply_error(ascii_triangle + "7\n"), "m.ply:14: ", "more values", "\"7\"");
  CHECK_MESSAGE_HAS(ply_error(body("0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n")), "no triangle with an area");
  CHECK_MESSAGE_HAS(
      ply_error(ply_header("ascii", "element vertex 1\nproperty float x\nproperty float y\n") +
                "0 0\n"),
      "x, y, z");
  std::string infinite = ply_header("binary_little_endian", plain_elements);
  for (int i = 0; i < 9; ++i) append(infinite, std::bit_cast<float>(0x7f800000U), false);
  infinite += std::string("\3", 1) + std::string(12, '\0');
  CHECK_MESSAGE_HAS(ply_error(infinite), "vertex 0 has the value inf");
}

TEST_CASE("scene mesh: vertex normals are weighted by the angle, not by how a face is cut") {
  // A cube's corner: one face is two triangles there, the others one each.
  const TriangleMesh mesh =
      obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 4 3\nf 1 2 5\nf 1 5 4\n");
  const glm::vec3 expected = -glm::normalize(glm::vec3(1, 1, 1));
  CHECK(glm::length(renderer::vertex_normals(mesh)[0] - expected) < 1e-6F);
}
