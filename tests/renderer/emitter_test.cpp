// SPDX-License-Identifier: MIT
// Lights draw points with the density they are asked for afterwards, and it integrates to the
// chance that they find a point.
#include <doctest/doctest.h>

#include <algorithm>

#include "core/warp.hpp"
#include "render_scenes.hpp"

using namespace render_test;
using renderer::Hit;
using renderer::LightSample;
using renderer::Ray;
using renderer::Sampler;
using renderer::Vec3;

namespace {

std::string shape(const std::string& type, const std::string& content) {
  return "<shape type=\"" + type + "\">" + content + "<emitter type=\"area\"/></shape>";
}
const std::string flipped = "<boolean name=\"flip_normals\" value=\"true\"/>";
const std::string turned =
    "<transform name=\"to_world\"><scale x=\"0.7\" y=\"1.3\" z=\"0.4\"/><rotate x=\"1\" y=\"2\" "
    "angle=\"40\"/>"
    "<translate z=\"0.3\"/></transform>";

/// A mesh that lives as long as the tests.
std::string mesh(const std::string& name, const std::string& vertices, const std::string& faces,
                 bool has_normals) {
  static const scene_test::Folder folder;
  const auto count = [](const std::string& lines) {
    return std::to_string(std::count(lines.begin(), lines.end(), '\n'));
  };
  const auto path = folder.write(
      name + ".ply",
      "ply\nformat ascii 1.0\nelement vertex " + count(vertices) +
          "\nproperty float x\nproperty float y\nproperty float z\n" +
          (has_normals ? "property float nx\nproperty float ny\nproperty float nz\n" : "") +
          "element face " + count(faces) +
          "\nproperty list uchar int vertex_indices\nend_header\n" + vertices + faces);
  return shape("ply", "<string name=\"filename\" value=\"" + path.string() + "\"/>" +
                          (has_normals ? "" : "<boolean name=\"face_normals\" value=\"true\"/>"));
}

struct Case {
  const char* name;
  std::string light;
  Vec3 from;
};
const std::vector<Case> cases = {
    {"rectangle", shape("rectangle", turned), {0.2f, 0.4f, 2}},
    {"rectangle, from behind", shape("rectangle", turned), {0.2f, 0.4f, -2}},
    {"cube", shape("cube", turned), {1.5f, -1, 2}},
    {"mesh wound against its normals",
     mesh("wound", "-1 -1 0 0 0 1\n1 -1 0 0 0 1\n1 1 0 0 0 1\n-1 2 0 0 0 1\n", "3 0 2 1\n3 0 3 2\n",
          true),
     {0.2f, 0.4f, 2}},
    {"quadrilateral that is no parallelogram",
     mesh("kite", "-1 -1 0\n1 -1 0\n0.2 0.2 0\n-1 1 0\n", "3 0 1 2\n3 2 3 0\n", false),
     {0.2f, 0.4f, 2}},
    {"sphere", shape("sphere", ""), {0.5f, 2, 1}},
    {"sphere, far", shape("sphere", ""), {30, 20, 10}},
    {"sphere, near", shape("sphere", ""), {0, 0, 1.01f}},
    {"sphere, from within", shape("sphere", ""), {0.2f, 0.3f, 0.1f}},
    {"sphere turned inside out, from within", shape("sphere", flipped), {0.2f, 0.5f, 0.1f}},
    {"sphere turned inside out, from without", shape("sphere", flipped), {2, 0.5f, 0.1f}},
    {"constant", "<emitter type=\"constant\"/>", {0, 0, 0}},
};

}  // namespace

TEST_CASE("emitter: the density of a sample is the one that its point is asked for") {
  for (const Case& c : cases) {
    CAPTURE(c.name);
    const auto scene = build(meter({0, 0, -9}, {0, 0, 0}, {1, 0, 0}) + c.light +
                             square({0, 0, -8}, {0, 0, 0}, 0.1, "") + "<emitter type=\"point\"/>");
    Sampler sampler(3, 1, 4);
    constexpr int samples = 20000;
    int found = 0, checked = 0;
    for (int i = 0; i < samples; ++i) {
      LightSample light;
      if (!scene.sample_light(c.from, sampler, light) || light.is_delta) continue;
      ++found;
      const Ray ray{c.from, light.direction, renderer::infinity};
      Hit hit;
      const bool met = scene.intersect(ray, hit) && scene.shapes[hit.shape].light >= 0;
      if (scene.environment >= 0) {
        if (!met) CHECK(light.pdf == doctest::Approx(scene.environment_pdf(light.direction)));
        continue;
      }
      // Another part of the light is before it; or rounding may miss what is seen at a grazing
      // angle.
      if (!met || glm::length(hit.position - light.position) > 2e-3f ||
          std::abs(glm::dot(hit.geometric_normal, light.direction)) < 0.05f)
        continue;
      ++checked;
      const float pdf = scene.light_pdf(c.from, hit);
      if (!(std::abs(pdf - light.pdf) < 5e-3f * light.pdf))
        FAIL_CHECK("drawn with ", light.pdf, ", asked for ", pdf);
    }
    const bool hides_itself = std::string(c.name) == "sphere turned inside out, from without";
    if (scene.environment < 0 && found > 0 && !hides_itself) CHECK(checked > 0.9 * found);
  }
}

TEST_CASE("emitter: densities integrate to the chance that a sample is found and seen") {
  for (const Case& c : cases) {
    CAPTURE(c.name);
    const auto scene = build(meter({0, 0, -90}, {0, 0, 0}, {1, 0, 0}) + c.light);
    Sampler sampler(2, 7, 1);
    constexpr int samples = 200000;
    double found = 0, sum = 0, squares = 0;
    for (int i = 0; i < samples; ++i) {
      LightSample light;
      Hit hit;
      if (scene.sample_light(c.from, sampler, light))
        found += scene.environment >= 0 ||
                 (scene.intersect({c.from, light.direction, renderer::infinity}, hit) &&
                  malus::max_channel(scene.emitted(hit, -light.direction)) > 0);
      const Vec3 d = renderer::square_to_sphere(sampler.next_2d());
      double value = 0;
      if (scene.environment >= 0)
        value = static_cast<double>(scene.environment_pdf(d));
      else if (scene.intersect({c.from, d, renderer::infinity}, hit) &&
               malus::max_channel(scene.emitted(hit, -d)) > 0)
        value = static_cast<double>(scene.light_pdf(c.from, hit));
      value *= 4 * pi;
      sum += value;
      squares += value * value;
    }
    const double mean = sum / samples, p = found / samples;
    const double error =
        std::sqrt(std::max(0.0, squares / samples - mean * mean + p * (1 - p)) / samples);
    // Twelve comparisons at 4 standard errors: 8 in 10^4 sets of seeds would fail.
    CHECK(std::abs(mean - p) < 4 * error + 1e-5);
  }
}

TEST_CASE("emitter: a light shines from its front alone") {
  const auto scene = build(meter({0, 0, -9}, {0, 0, 0}, {1, 0, 0}) + shape("rectangle", ""));
  Hit hit;
  REQUIRE(scene.intersect({Vec3(0.1f, 0.2f, -1), Vec3(0, 0, 1), renderer::infinity}, hit));
  CHECK(scene.emitted(hit, Vec3(0, 0, 1))[0] == 1);
  CHECK(scene.emitted(hit, Vec3(0, 0, -1))[0] == 0);
  Sampler sampler(1, 1, 1);
  LightSample light;
  CHECK_FALSE(scene.sample_light(Vec3(0.1f, 0.2f, -1), sampler, light));
}
