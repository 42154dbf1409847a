// SPDX-License-Identifier: MIT
// Where light paths and camera paths meet, only what lies on the side that light comes to takes it:
// no photon acts across a corner, and nothing leaves by the back of a surface whose normals lean.
#include <doctest/doctest.h>

#include "agreement_scenes.hpp"

using namespace agreement;
using scene_test::Folder;

namespace {

std::string sun(const glm::dvec3& direction) {
  return "<emitter type=\"directional\"><vector name=\"direction\" value=\"" + text(direction) +
         "\"/>" + rgb("irradiance", "3, 2, 1") + "</emitter>";
}

/// Of 16 x 16 pixels.
std::string view(const glm::dvec3& origin, const glm::dvec3& target, double angle) {
  return "<sensor type=\"perspective\">" + number("fov", angle) + "<transform name=\"to_world\">" +
         look(origin, target, {0, 0.1, 1}) + "</transform><film type=\"hdrfilm\">" +
         integer("width", 16) + integer("height", 16) + "<rfilter type=\"box\"/></film></sensor>\n";
}

/// S0 in red, of all pixels.
double light(const Scene& scene) {
  const auto film = render(scene, batches, 1).film;
  double sum = 0;
  for (std::size_t p = 0; p < 16 * 16; ++p) sum += film.total(p).mean(0);
  return sum;
}

/// A square of half the width 1 that faces upwards, whose interpolated normals lean by 60 degrees
/// towards +x.
std::string leaning(const Folder& folder, const glm::dvec3& center, const std::string& content) {
  const auto mesh = square_with_normal(folder, "0.866025 0 0.5");
  return "<shape type=\"ply\"><string name=\"filename\" value=\"" + mesh.string() +
         "\"/><transform name=\"to_world\"><translate value=\"" + text(center) +
         "\"/></transform>" + content + "</shape>\n";
}

}  // namespace

TEST_CASE("sides: photons on the floor are none of the wall's") {
  // A plate keeps the sun off the wall's foot, but not off the floor before it: all that the foot
  // could gather is the floor's.
  const std::string room = square({0, 0, 0}, {0, 0, 1}, 2, grey, {0, 1, 0}) +
                           square({0, 0, 2}, {1, 0, 2}, 2, grey, {0, 1, 0}) +
                           square({-0.88, 0, 0.5}, {-0.88, 0, 1}, 1, black, {0, 1, 0}) +
                           sun({-0.2, 0, -1}) + path_of(2);
  for (const char* name : {"path", "ptracer", "ppm", "bpm", "vcm"}) {
    CAPTURE(std::string(name));
    const auto seen = [&](const glm::dvec3& target) {
      Scene scene = build(room + view({2, 0, 0.8}, target, 4));
      scene.integrator.name = name;
      scene.integrator.initial_radius = 0.03f;
      return light(scene);
    };
    CHECK(seen({0.2, 0, 0}) > 50);
    CHECK(seen({0, 0, 0.1}) == 0);
  }
}

TEST_CASE("sides: light leaves no surface by its back, whatever its normals are") {
  const Folder folder;
  // Below the square, where its normals would have it shine, is a floor that sees its back alone.
  const std::string scenery = leaning(folder, {0, 0, 1}, grey) +
                              square({1.5, 0, 0}, {1.5, 0, 1}, 1, grey, {0, 1, 0}) +
                              sun({0, 0, -1}) + path_of(3);
  Scene scene = build(scenery + view({4, 0, 3}, {1.5, 0, 0}, 20));
  scene.integrator.name = "bdpt";
  scene.integrator.strategy = renderer::Strategy{1, 2};
  CHECK(light(scene) > 10);  // of the sun itself
  scene.integrator.strategy = renderer::Strategy{2, 2};
  CHECK(light(scene) == 0);

  for (const char* name : {"path", "ptracer", "bdpt", "vcm"}) {
    CAPTURE(std::string(name));
    Scene below = build(scenery + view({3, 0, 0.4}, {0, 0, 1}, 10));
    below.integrator.name = name;
    CHECK(light(below) == 0);
    Scene above = build(scenery + view({3, 0, 1.6}, {0, 0, 1}, 10));
    above.integrator.name = name;
    CHECK(light(above) > 10);
  }
}

TEST_CASE("sides: a light path knows nothing of the camera path that it meets") {
  // One pixel sees all of a lamp that a floor below lights anew. Were both paths drawn by the same
  // numbers, they would begin at places of the lamp that have to do with each other, whichever of
  // its axes the numbers fall on.
  Scene scene =
      build(path_of(3) + "<sensor type=\"perspective\">" + number("fov", 120) +
            "<transform name=\"to_world\">" + look({0, 0, 0.05}, {0, 0, 0.5}, {1, 1, 0}) +
            "</transform><film type=\"hdrfilm\">" + integer("width", 1) + integer("height", 1) +
            "<rfilter type=\"box\"/></film></sensor>\n" + square({0, 0, 0}, {0, 0, 1}, 1, grey) +
            square({0, 0, 0.5}, {0, 0, 0}, 0.7, grey + emits(1), {0, 1, 0}));
  Picture expected = picture(scene, "path", 1 << 16, 1);
  scene.integrator.max_depth = 2;
  expected -= picture(scene, "path", 1 << 16, 1);
  scene.integrator.max_depth = 3;
  scene.integrator.strategy = renderer::Strategy{2, 2};
  CHECK_AGREE(picture(scene, "bdpt", 1 << 16, 2), expected);
}
