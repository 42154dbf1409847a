// SPDX-License-Identifier: MIT
// Which medium is on which side of what in a scene file; what is said where a file contradicts
// itself.
#include <doctest/doctest.h>

#include "medium_scenes.hpp"
#include "scene/requirements.hpp"

using namespace render_test;
using renderer::Hit;
using renderer::Medium;
using renderer::Rgb;
using renderer::Vec3;
using scene_test::error_of;

namespace {

/// The warnings about media, of a finished scene.
std::vector<std::string> warnings(const std::string& content) {
  auto scene = build(content);
  renderer::check_requirements(scene, "scene.xml");
  std::erase_if(scene.warnings, [](const auto& w) { return w.find("no light") != w.npos; });
  return scene.warnings;
}

}  // namespace

TEST_CASE("media: each side of a surface has its own, and one element is one medium") {
  const std::string ref = "<ref id=\"fog\"/>";
  const std::string fog =
      "<medium type=\"homogeneous\" id=\"fog\">" + phase("rayleigh") + "</medium>\n";
  const std::string lamp = "<emitter type=\"area\">" + ref + "</emitter>";
  auto scene =
      build(fog +
            "<medium type=\"homogeneous\" id=\"unused\"/>\n"
            "<sensor type=\"radiancemeter\"><ref id=\"fog\"/></sensor>\n" +
            sphere("<ref id=\"fog\" name=\"exterior\"/>" + medium(number("sigma_t", 2))) +
            sphere("<ref id=\"fog\" name=\"interior\"/>") + sphere("") +
            sphere("<ref id=\"fog\" name=\"interior\"/><emitter type=\"area\"/>") +
            sphere("<ref id=\"fog\" name=\"exterior\"/><emitter type=\"area\"/>") + sphere(lamp) +
            "<emitter type=\"point\">" + ref + "</emitter><emitter type=\"directional\"/>");
  CHECK(scene.media.size() == 2);
  CHECK(scene.polarizes);
  const Medium* const f = scene.sensor_medium;
  REQUIRE(f);
  check_near(f->extinction({}), Rgb(1));
  const auto& s = scene.shapes;
  CHECK(s[0].is_boundary);
  CHECK(s[0].exterior == f);
  check_near(s[0].interior->extinction({}), Rgb(2));
  CHECK((s[1].is_boundary && s[1].interior == f && !s[1].exterior));
  CHECK(!s[2].is_boundary);
  CHECK(s[2].beyond(true, f) == f);
  CHECK(scene.light_media == std::vector<const Medium*>{nullptr, f, f, f, nullptr});
  CHECK(scene.light_media.size() == scene.lights.size());

  // Nothing refers to it: there are no media.
  const auto clear = build(camera + fog + sphere(""));
  CHECK(!clear.has_media());
  CHECK(!clear.polarizes);
  CHECK(clear.warnings.empty());

  // The exterior is where the normal points to.
  for (const bool flipped : {false, true}) {
    const auto turned =
        build(camera + sphere(medium("") + (flipped ? flag("flip_normals") : "")) +
              "<shape type=\"cube\"><transform name=\"to_world\"><translate x=\"9\"/>"
              "</transform>" +
              medium("") + (flipped ? flag("flip_normals") : "") + bsdf("null") + "</shape>");
    for (const float x : {0.0f, 9.0f}) {
      Hit hit;
      REQUIRE(turned.intersect({{x, 0.1f, -5}, {0, 0, 1}}, hit));
      const auto& shape = turned.shapes[hit.shape];
      const auto on_side = [&](float z) {
        return shape.beyond(glm::dot(hit.geometric_normal, Vec3(0, 0, z)) > 0, nullptr);
      };
      CHECK((on_side(1) != nullptr) == !flipped);
      CHECK((on_side(-1) != nullptr) == flipped);
    }
  }

  const auto opaque = build(camera + "<shape type=\"sphere\">" + medium("") + "</shape>");
  CHECK(std::holds_alternative<renderer::Diffuse>(opaque.shapes[0].material.front->kind()));
  REQUIRE(opaque.warnings.size() == 1);
  CHECK_MESSAGE_HAS(opaque.warnings[0], "scene.xml:3: ", "diffuse", "null");
}

TEST_CASE("media: the sensor and lights are warned of where surfaces around contradict them") {
  const std::string fog = "<medium type=\"homogeneous\" id=\"fog\"/>\n";
  const std::string in_fog = "<ref id=\"fog\" name=\"interior\"/>";
  const auto eye = [](const std::string& content) {
    return "<sensor type=\"radiancemeter\">" + content + "</sensor>\n";
  };
  const auto point = [](const std::string& content) {
    return "<emitter type=\"point\">" + content + "</emitter>";
  };
  const std::string ref = "<ref id=\"fog\"/>", room = sphere(in_fog, 5);
  CHECK(warnings(fog + eye(ref) + room + point(ref)).empty());
  const std::string far_eye = meter({0, 0, -9}, {0, 0, 0}, {1, 0, 0});
  CHECK(warnings(fog + far_eye + room + point(ref)).empty());
  // A ball in the way, which bounds nothing.
  const std::string ball = sphere("", 0.5);
  const auto sensor = warnings(fog + eye("") + room + ball + point(ref));
  REQUIRE(sensor.size() == 1);
  CHECK_MESSAGE_HAS(sensor[0], "scene.xml: ", "the sensor is in vacuum", "in \"fog\"");
  const auto light = warnings(fog + eye(ref) + room + ball + point(""));
  REQUIRE(light.size() == 1);
  CHECK_MESSAGE_HAS(light[0], "light of ", "scene.xml:6 is in vacuum", "in \"fog\"");
  // From outside it is the other way round.
  const auto outside =
      warnings(fog + meter({0, 0, -9}, {0, 0, 0}, {1, 0, 0}).replace(0, 8, "<sensor ") + room);
  CHECK(outside.empty());
  const auto declared =
      warnings(fog +
               "<sensor type=\"radiancemeter\"><transform name=\"to_world\"><translate z=\"-9\"/>"
               "</transform>" +
               ref + "</sensor>" + room);
  REQUIRE(declared.size() == 1);
  CHECK_MESSAGE_HAS(declared[0], "the sensor is in \"fog\"", "in vacuum by what all");

  // A lamp in the fog that says nothing, one that does, and one in another medium without an id.
  const auto lamp = [](const std::string& content) {
    return "<shape type=\"rectangle\"><emitter type=\"area\">" + content + "</emitter></shape>\n";
  };
  CHECK(warnings(fog + eye(ref) + room + lamp(ref)).empty());
  CHECK(warnings(fog + eye(ref) + room + lamp("")).size() == 1);
  const auto other = warnings(fog + eye(ref) + room + lamp(medium(number("sigma_t", 2))));
  REQUIRE(other.size() == 1);
  CHECK_MESSAGE_HAS(other[0], "is in the medium of line 5", "in \"fog\"");
  // Surfaces that disagree with each other tell nothing.
  const std::string half =
      "<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"9\"/><translate "
      "z=\"2\"/></transform>" +
      bsdf("null");
  CHECK(warnings(fog + eye("") + half + in_fog + "</shape>\n" +
                 "<shape type=\"rectangle\"><transform name=\"to_world\"><scale "
                 "value=\"9\"/><translate z=\"-2\"/></transform>" +
                 bsdf("null") + in_fog + "</shape>")
            .empty());
  const auto exterior =
      warnings(fog + eye(ref) + room + "<shape type=\"rectangle\">" + bsdf("null") + medium("") +
               "<ref id=\"fog\" name=\"exterior\"/><emitter type=\"area\">" +
               medium(number("sigma_t", 3)) + "</emitter></shape>");
  REQUIRE(!exterior.empty());
  CHECK_MESSAGE_HAS(exterior[0], "doesn't count", "exterior");
}

TEST_CASE("media: volpath counts no sheets, whichever integrator is asked for in the end") {
  const auto settings = [](const std::string& type, const std::string& content = "") {
    return build(camera + "<integrator type=\"" + type + "\">" + content + "</integrator>")
        .integrator;
  };
  for (const std::string name : {"volpath", "volpathmis"}) {
    auto s = settings(name);
    CHECK(s.name == "path");
    CHECK(!s.sheets_count);
    renderer::set_integrator(s, "bdpt");
    CHECK(s.name == "bdpt");
    CHECK(!s.sheets_count);
    renderer::set_integrator(s, "path");
    CHECK(!s.sheets_count);
  }
  for (const std::string name : {"path", "bdpt"}) {
    auto s = settings(name);
    CHECK(s.sheets_count);
    renderer::set_integrator(s, "vcm");
    CHECK(s.sheets_count);
    renderer::set_integrator(s, "volpath");
    CHECK(!s.sheets_count);
  }
  CHECK(settings("vcm").initial_media_radius == 0.01f);
  CHECK(settings("path", number("initial_media_radius", 0.5)).initial_media_radius == 0.5f);
  CHECK_MESSAGE_HAS(error_of([&] { settings("ppm", number("initial_media_radius", 2)); }),
                    "scene.xml:3: ", "\"initial_media_radius\" is 2", "allowed: 1e-05 to 1");
}
