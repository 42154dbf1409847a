// SPDX-License-Identifier: MIT
// The scenes in examples/scenes are read, and are built as they say.
#include <doctest/doctest.h>

#include <cmath>

#include "scene/transform.hpp"
#include "scene_files.hpp"

using namespace scene_test;

namespace {

const std::filesystem::path scenes = MALUS_SCENES_DIR;

Scene example(const std::string& name, const Definitions& definitions = {}) {
  return renderer::read_scene(scenes / name, definitions);
}

std::shared_ptr<const renderer::Object> named(const Scene& scene, const std::string& id) {
  for (const auto& object : scene->children()) {
    if (object->id() == id) return object;
  }
  FAIL("no object of the id " << id);
  return nullptr;
}

glm::dmat4 to_world(const std::shared_ptr<const renderer::Object>& object) {
  return object->transform("to_world");
}

double difference(const glm::dvec3& a, const glm::dvec3& b) { return glm::length(a - b); }

/// A rectangle's middle and the unit normal of its front.
void check_rectangle(const Scene& scene, const std::string& id, const glm::dvec3& middle,
                     const glm::dvec3& normal) {
  CAPTURE(id);
  const glm::dmat4 m = to_world(named(scene, id));
  CHECK(difference(renderer::transform_point(m, glm::dvec3(0)), middle) < 1e-12);
  const glm::dvec3 n = glm::normalize(renderer::transform_normal(m, {0, 0, 1}));
  CHECK(difference(n, normal) < 1e-12);
}

}  // namespace

TEST_CASE("scene examples: every file in examples/scenes is read") {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(scenes)) {
    if (entry.path().extension() != ".xml") continue;
    CAPTURE(entry.path().string());
    CHECK(error_of([&] { renderer::read_scene(entry.path(), {}); }) == "no error");
    ++count;
  }
  CHECK(count >= 6);
}

TEST_CASE("scene examples: the boxes are SmallVCM's, their walls facing inwards") {
  for (const char* name : {"diffuse.xml", "box.xml"}) {
    CAPTURE(name);
    const Scene scene = example(name);
    check_rectangle(scene, "floor", {0.00973, 0.02453, -1.28002}, {0, 0, 1});
    check_rectangle(scene, "ceiling", {0.00973, 0.02453, 1.28002}, {0, 0, -1});
    check_rectangle(scene, "back_wall", {0.00973, 1.30455, 0}, {0, -1, 0});
    check_rectangle(scene, "left_wall", {-1.27029, 0.02453, 0}, {1, 0, 0});
    check_rectangle(scene, "right_wall", {1.28975, 0.02453, 0}, {-1, 0, 0});
    check_rectangle(scene, "light", {0, 0, 1.26002}, {0, 0, -1});
    const glm::dmat4 wall = to_world(named(scene, "left_wall"));
    const glm::dvec3 corner = renderer::transform_point(wall, {1, 1, 0});
    CHECK(difference(glm::abs(corner - glm::dvec3(0, 0.02453, 0)), {1.27029, 1.28002, 1.28002}) <
          1e-12);
    const glm::dmat4 light = to_world(named(scene, "light"));
    CHECK(glm::length(renderer::transform_vector(light, {1, 0, 0})) == doctest::Approx(0.25));
  }
}

TEST_CASE("scene examples: the boxes' camera is SmallVCM's, with the picture's left on +x") {
  const auto camera = example("box.xml")->only_child("sensor");
  const glm::dmat4 m = to_world(camera);
  CHECK(difference(renderer::transform_point(m, glm::dvec3(0)), {-0.0439815, -4.12529, 0.222539}) <
        1e-12);
  const glm::dvec3 forward = glm::normalize(glm::dvec3(0.00688625, 0.998505, -0.0542161));
  CHECK(difference(renderer::transform_vector(m, {0, 0, 1}), forward) < 1e-7);
  CHECK(difference(renderer::transform_vector(m, {0, 1, 0}), {3.73896e-4, 0.0542148, 0.998529}) <
        1e-5);
  CHECK(renderer::transform_vector(m, {1, 0, 0}).x < -0.99);
  CHECK(camera->number("fov") == 45);
}

TEST_CASE("scene examples: spheres neither overlap nor reach through the floor") {
  for (const char* name : {"diffuse.xml", "box.xml", "furnace.xml"}) {
    CAPTURE(name);
    const bool in_box = std::string(name) != "furnace.xml";
    std::vector<std::pair<glm::dvec3, double>> spheres;
    for (const auto& shape : example(name)->children("shape")) {
      if (shape->type() != "sphere") continue;
      spheres.emplace_back(shape->point("center"), shape->number("radius"));
      const auto& [center, radius] = spheres.back();
      if (in_box) CHECK(center.z - radius >= -1.28002 - 1e-12);
      for (std::size_t i = 0; i + 1 < spheres.size(); ++i) {
        CHECK(glm::distance(center, spheres[i].first) > radius + spheres[i].second);
      }
    }
    CHECK(spheres.size() == (name == std::string("diffuse.xml") ? 5 : in_box ? 2 : 3));
  }
}

TEST_CASE("scene examples: Brewster's meter looks at the origin at its angle, right along +x") {
  for (const double degrees : {0.0, 56.25, 80.0}) {
    const Scene scene = example("brewster.xml", {{"angle", std::to_string(degrees)}});
    const glm::dmat4 m = to_world(scene->only_child("sensor"));
    const glm::dvec3 origin = renderer::transform_point(m, glm::dvec3(0));
    const glm::dvec3 forward = renderer::transform_vector(m, {0, 0, 1});
    CHECK(difference(origin + 4.0 * forward, glm::dvec3(0)) < 1e-12);
    CHECK(-forward.z == doctest::Approx(std::cos(glm::radians(degrees))));
    CHECK(difference(renderer::transform_vector(m, {1, 0, 0}), {-1, 0, 0}) < 1e-12);
    CHECK(difference(glm::cross(forward, renderer::transform_vector(m, {0, 1, 0})), {1, 0, 0}) <
          1e-12);
  }
}

TEST_CASE("scene examples: polarizers face the meter or camera with u to its right") {
  for (const auto& [name, ids] : std::map<std::string, std::vector<std::string>>{
           {"malus_law.xml", {"first", "second"}},
           {"crossed_polarizers.xml", {"rear", "third", "front"}}}) {
    const Scene scene = example(name);
    const glm::dmat4 sensor = to_world(scene->only_child("sensor"));
    double last = 1e9;
    for (const std::string& id : ids) {
      CAPTURE(id);
      const glm::dmat4 m = to_world(named(scene, id));
      const glm::dvec3 u = glm::normalize(renderer::transform_vector(m, {1, 0, 0}));
      const glm::dvec3 v = glm::normalize(renderer::transform_vector(m, {0, 1, 0}));
      CHECK(difference(u, -renderer::transform_vector(sensor, {1, 0, 0})) < 1e-12);
      CHECK(difference(v, renderer::transform_vector(sensor, {0, 1, 0})) < 1e-12);
      CHECK(difference(glm::normalize(renderer::transform_normal(m, {0, 0, 1})),
                       -renderer::transform_vector(sensor, {0, 0, 1})) < 1e-12);
      // In the order in which light meets them.
      const double distance = renderer::transform_point(m, glm::dvec3(0)).y;
      CHECK(distance < last);
      last = distance;
    }
  }
}
