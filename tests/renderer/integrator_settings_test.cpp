// SPDX-License-Identifier: MIT
// Numbers of an <integrator>: what holds if none is given, what is taken, and what is refused, with
// the number and what is allowed.
#include <doctest/doctest.h>

#include <vector>

#include "render_scenes.hpp"

using namespace render_test;
using renderer::IntegratorSettings;

namespace {

IntegratorSettings settings(const std::string& parameters) {
  return build("<integrator type=\"vcm\">" + parameters + "</integrator>" +
               meter({0, 0, 3}, {0, 0, 0}, {1, 0, 0}) + sky)
      .integrator;
}

struct Case {
  const char* name;
  float IntegratorSettings::*member;
  float otherwise;
  std::vector<const char*> taken, refused;
  const char* allowed;
};

const Case cases[] = {
    {"connection_threshold",
     &IntegratorSettings::connection_threshold,
     0.125f,
     {"0", "0.25", "1"},
     {"-0.01", "1.01"},
     "0 to 1"},
    {"initial_radius",
     &IntegratorSettings::initial_radius,
     0.003f,
     {"1e-05", "0.25", "1"},
     {"0", "-1", "9e-06", "1.01"},
     "1e-05 to 1"},
    {"initial_media_radius",
     &IntegratorSettings::initial_media_radius,
     0.01f,
     {"1e-05", "0.25", "1"},
     {"0", "-1", "9e-06", "1.01"},
     "1e-05 to 1"},
    {"radius_alpha",
     &IntegratorSettings::radius_alpha,
     0.75f,
     {"0.0625", "1"},
     {"0", "-0.5", "1.01"},
     ""},
};

}  // namespace

TEST_CASE("integrator settings: numbers, and what is said of wrong ones") {
  for (const Case& c : cases) {
    CAPTURE(std::string(c.name));
    CHECK(settings("").*c.member == c.otherwise);
    const auto with = [&](const std::string& value) {
      return settings("<float name=\"" + std::string(c.name) + "\" value=\"" + value + "\"/>").*
             c.member;
    };
    for (const char* value : c.taken) CHECK(with(value) == std::stof(value));
    for (const char* value : c.refused)
      CHECK_MESSAGE_HAS(scene_test::error_of([&] { with(value); }), "scene.xml:", c.name, value,
                        "allowed", c.allowed);
  }
}
