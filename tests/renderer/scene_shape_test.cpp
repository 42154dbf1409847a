// SPDX-License-Identifier: MIT
// Shapes are where their transforms put them, and their fronts and normals face where they should.
#include <doctest/doctest.h>

#include "core/affine.hpp"
#include "render_scenes.hpp"

using namespace render_test;
using renderer::Hit;
using renderer::Vec3;

namespace {

const std::string eye = meter({0, 0, -90}, {0, 0, 0}, {1, 0, 0});

std::string mesh(const scene_test::Folder& folder, const std::string& name,
                 const std::string& faces) {
  const auto path = folder.write(
      name,
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
      "z\nproperty float nx\nproperty float ny\nproperty float nz\nelement face 2\nproperty list "
      "uchar int vertex_indices\nend_header\n-1 -1 0 0.6 0 0.8\n1 -1 0 0.6 0 0.8\n1 1 0 0.6 0 "
      "0.8\n-1 1 0 0.6 0 0.8\n" +
          faces);
  return "<string name=\"filename\" value=\"" + path.string() + "\"/>";
}
const std::string forward = "3 0 1 2\n3 0 2 3\n", backward = "3 0 2 1\n3 0 3 2\n";

Hit hit(const std::string& type, const std::string& content, const Vec3& from, const Vec3& to) {
  const auto scene = build(eye + sky + "<shape type=\"" + type + "\">" + content + "</shape>");
  Hit h;
  REQUIRE(scene.intersect({from, glm::normalize(to - from), renderer::infinity}, h));
  return h;
}
/// Above the middle of what is in the plane z = 0.
Hit seen(const std::string& type, const std::string& content) {
  return hit(type, content, {0.02f, 0.01f, 3}, {0.1f, 0.05f, 0});
}
std::string transform(const std::string& steps) {
  return "<transform name=\"to_world\">" + steps + "</transform>";
}
bool near(const Vec3& a, const Vec3& b) { return glm::length(a - b) < 1e-5f; }

}  // namespace

TEST_CASE("scene shape: a rectangle's and a cube's front stays the front in a mirror") {
  const Vec3 up(0, 0, 1);
  for (const std::string mirror :
       {"<scale x=\"-1\"/>", "<scale y=\"-2\"/>", "<scale x=\"-1\" y=\"-1\"/>"}) {
    CAPTURE(mirror);
    CHECK(near(seen("rectangle", transform(mirror)).geometric_normal, up));
    CHECK(near(seen("cube", transform(mirror)).geometric_normal, up));
  }
  CHECK(near(seen("rectangle", transform("<scale z=\"-1\"/>")).geometric_normal, -up));
  CHECK(near(seen("cube", transform("<scale z=\"-1\"/>")).geometric_normal, up));
}

TEST_CASE(
    "scene shape: a file's normals go by the inverse transpose, and say which side is front") {
  const scene_test::Folder folder;
  const std::string content = mesh(folder, "a.ply", forward);
  const Hit plain = seen("ply", content);
  CHECK(near(plain.normal, {0.6f, 0, 0.8f}));
  CHECK(near(plain.geometric_normal, {0, 0, 1}));
  const Hit stretched = seen("ply", content + transform("<scale x=\"2\"/>"));
  CHECK(near(stretched.normal, glm::normalize(Vec3(0.3f, 0, 0.8f))));
  const Hit mirrored = seen("ply", content + transform("<scale x=\"-1\"/>"));
  CHECK(near(mirrored.normal, {-0.6f, 0, 0.8f}));
  CHECK(near(mirrored.geometric_normal, {0, 0, 1}));
  const Hit wound = seen("ply", mesh(folder, "b.ply", backward));
  CHECK(near(wound.normal, {0.6f, 0, 0.8f}));
  CHECK(near(wound.geometric_normal, {0, 0, 1}));
}

TEST_CASE("scene shape: flipped and face normals of a mesh that has its own") {
  const scene_test::Folder folder;
  const std::string flip = "<boolean name=\"flip_normals\" value=\"true\"/>",
                    flat = "<boolean name=\"face_normals\" value=\"true\"/>";
  const std::string content = mesh(folder, "a.ply", forward);
  CHECK(near(seen("ply", content + flip).normal, {-0.6f, 0, -0.8f}));
  CHECK(near(seen("ply", content + flip).geometric_normal, {0, 0, -1}));
  CHECK(near(seen("ply", content + flat).normal, {0, 0, 1}));
  CHECK(near(seen("ply", content + flat + flip).normal, {0, 0, -1}));
}

TEST_CASE("scene shape: a sphere's centre is transformed with it") {
  const Hit top = hit("sphere",
                      "<point name=\"center\" value=\"1, 0, 0\"/>" + number("radius", 0.5) +
                          transform("<scale value=\"2\"/><rotate z=\"1\" angle=\"90\"/><translate "
                                    "z=\"4\"/>"),
                      {0, 2, 20}, {0, 2, 4});
  CHECK(near(top.position, {0, 2, 5}));
  CHECK(near(top.normal, {0, 0, 1}));
}
