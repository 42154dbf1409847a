// SPDX-License-Identifier: MIT
// The typed parameters that factories read: what values are taken, what is refused, and what is
// left over.
#include "scene/object.hpp"

#include <doctest/doctest.h>

#include "scene_files.hpp"

using namespace scene_test;
using renderer::Object;
using renderer::ValueKind;

namespace {

/// A shape with that content, which begins in line 3.
std::shared_ptr<const Object> shape(std::string_view content) {
  return read("<shape type='ball'>\n" + std::string(content) + "</shape>")->children("shape").at(0);
}

}  // namespace

TEST_CASE("scene object: numbers are read whole and finite") {
  const auto object = shape(
      "<float name='a' value=' -1.5e3 '/><integer name='b' value='+7'/><float name='c' "
      "value='+.5'/>");
  CHECK(object->number("a") == -1500);
  CHECK(object->number("b") == 7);
  CHECK(object->number("c", 1) == 0.5);
  CHECK(object->number("none", 2.5) == 2.5);
  CHECK(object->integer("b") == 7);
  CHECK(object->integer("none", 4) == 4);
}

TEST_CASE("scene object: text that is no finite number is an error that shows it") {
  for (const char* bad : {"nan", "inf", "-inf", "1e999", "1x", "", "1 2", "0x10", "1,5", "--1"}) {
    CHECK_MESSAGE_HAS(read_error("\n<float name='a' value='" + std::string(bad) + "'/>"),
                      "scene.xml:3: ", "not a number", std::string("\"") + bad + "\"",
                      "finite number");
  }
  for (const char* bad : {"1.5", "99999999999999999999", "a", "", "1e3"}) {
    CHECK_MESSAGE_HAS(read_error("<integer name='a' value='" + std::string(bad) + "'/>"),
                      "not an integer", std::string("\"") + bad + "\"", "whole number");
  }
}

TEST_CASE("scene object: a missing or mistyped parameter is an error that says what is allowed") {
  const auto object = shape("<string name='s' value='x'/>\n<float name='f' value='2'/>");
  CHECK_MESSAGE_HAS(error_of([&] { object->number("radius"); }),
                    "scene.xml:2: ", "<shape type=\"ball\">", "\"radius\" is missing", "<float>");
  CHECK_MESSAGE_HAS(error_of([&] { object->number("s"); }),
                    "scene.xml:3: ", "\"s\" is a <string> of value \"x\"", "allowed: <float>");
  CHECK_MESSAGE_HAS(error_of([&] { object->integer("f"); }), "scene.xml:4: ", "is a <float>",
                    "allowed: <integer>");
  CHECK_MESSAGE_HAS(error_of([&] { object->boolean("f", true); }), "allowed: <boolean>");
  CHECK_MESSAGE_HAS(error_of([&] { object->string("f"); }), "allowed: <string>");
  CHECK_MESSAGE_HAS(error_of([&] { object->point("f"); }), "allowed: <point>");
  CHECK_MESSAGE_HAS(error_of([&] { object->transform("f"); }), "allowed: <transform>");
  CHECK_MESSAGE_HAS(error_of([&] { object->color("s"); }), "allowed: <rgb>");
}

TEST_CASE("scene object: a value out of its range is an error that gives the range") {
  const auto object = shape(
      "<float name='f' value='2'/>\n<integer name='i' value='-1'/>"
      "<rgb name='c' value='0.5, 1.5, 0'/><string name='s' value='z'/>");
  CHECK(object->number_in("f", 0, 2, 3) == 2);
  CHECK(object->positive("f", 1) == 2);
  CHECK_MESSAGE_HAS(error_of([&] { object->number_in("f", 0, 0, 1.5); }),
                    "scene.xml:3: ", "\"f\" is 2", "allowed: 0 to 1.5");
  CHECK_MESSAGE_HAS(error_of([&] { object->integer_in("i", 0, 0, 9); }),
                    "scene.xml:4: ", "\"i\" is -1", "allowed: 0 to 9");
  CHECK_MESSAGE_HAS(error_of([&] { object->positive("i", 1); }), "allowed: more than 0");
  CHECK_MESSAGE_HAS(error_of([&] { object->color_in("c", {}, 0, 1); }), "1.5", "allowed: 0 to 1");
  CHECK_MESSAGE_HAS(error_of([&] {
                      object->one_of("s", "x", {"x", "y"});
                    }),
                    "\"s\" is \"z\"", "allowed: x, y");
  CHECK(object->one_of("t", "x", {"x", "y"}) == "x");
}

TEST_CASE("scene object: booleans are true or false in any case") {
  const auto object = shape("<boolean name='a' value='True'/><boolean name='b' value='false'/>");
  CHECK(object->boolean("a", false));
  CHECK_FALSE(object->boolean("b", true));
  CHECK(object->boolean("c", true));
  CHECK_MESSAGE_HAS(read_error("<boolean name='a' value='1'/>"), "\"1\"", "allowed: true, false");
}

TEST_CASE("scene object: points and vectors are a list, one number or coordinates") {
  const auto object = shape(
      "<point name='a' value='1, 2 3'/><vector name='b' value='2'/>"
      "<point name='c' x='1' y='2' z='3'/>");
  CHECK(object->point("a") == glm::dvec3(1, 2, 3));
  CHECK(object->vector("a") == glm::dvec3(1, 2, 3));
  CHECK(object->vector("b") == glm::dvec3(2));
  CHECK(object->point("c", glm::dvec3(0)) == glm::dvec3(1, 2, 3));
  CHECK(object->point("d", glm::dvec3(4)) == glm::dvec3(4));
  CHECK_MESSAGE_HAS(read_error("<point name='a' value='1, 2'/>"), "2 values", "1 or 3 numbers");
  CHECK_MESSAGE_HAS(read_error("<point name='a' value='1, 2, q'/>"), "\"q\"");
  CHECK_MESSAGE_HAS(read_error("<point name='a' x='1' y='2'/>"), "\"z\" is missing");
  CHECK_MESSAGE_HAS(read_error("<point name='a' value='1' x='1'/>"), "allowed: one of them");
  CHECK_MESSAGE_HAS(read_error("<point name='a' value='1' w='1'/>"), "\"w\"", "x, y, z");
}

TEST_CASE("scene object: colours are rgb or anything grey") {
  const auto object = shape(
      "<rgb name='a' value='1 2 3'/><rgb name='b' value='0.5'/>"
      "<spectrum name='c' value='0.25'/><float name='d' value='4'/>"
      "<integer name='e' value='1'/>");
  CHECK(object->color("a") == glm::dvec3(1, 2, 3));
  CHECK(object->color("b") == glm::dvec3(0.5));
  CHECK(object->color("c") == glm::dvec3(0.25));
  CHECK(object->color("d") == glm::dvec3(4));
  CHECK(object->color("e", glm::dvec3(0)) == glm::dvec3(1));
  CHECK(object->color("f", glm::dvec3(9)) == glm::dvec3(9));
  CHECK(object->uniform("c", 1) == 0.25);
  CHECK(object->uniform("f", 1) == 1);
  CHECK_MESSAGE_HAS(error_of([&] { object->uniform("a", 1); }), "coloured", "\"1 2 3\"");
  CHECK_MESSAGE_HAS(read_error("<rgb name='a' value='1 2'/>"), "2 values", "1 or 3");
}

TEST_CASE("scene object: a spectrum of wavelengths is refused where a colour is wanted") {
  const auto object = shape(
      "<spectrum name='a' value='400:0.5, 700:0.6'/>\n"
      "<spectrum name='b' filename='gold.spd'/>");
  CHECK_MESSAGE_HAS(error_of([&] { object->color("a"); }), "scene.xml:3: ", "\"400:0.5, 700:0.6\"",
                    "allowed: <rgb>, <float>, <integer>, <spectrum> with a single value");
  CHECK_MESSAGE_HAS(error_of([&] { object->color("b"); }), "scene.xml:4: ", "gold.spd");
  CHECK_MESSAGE_HAS(read_error("<spectrum name='a'/>"), "exactly one", "value, filename");
}

TEST_CASE("scene object: a texture may stand in place of a colour, and is told apart from it") {
  const auto object =
      shape("<texture type='checkerboard' name='a'/>\n<bsdf type='diffuse' name='b'/>");
  REQUIRE(object->texture("a"));
  CHECK(object->texture("a")->type() == "checkerboard");
  CHECK(object->texture("c") == nullptr);
  CHECK_MESSAGE_HAS(error_of([&] { object->color("a"); }),
                    "scene.xml:3: ", "<texture type=\"checkerboard\">", "allowed: <rgb>");
  CHECK_MESSAGE_HAS(error_of([&] { object->texture("b"); }), "scene.xml:4: ", "<bsdf", "<texture>");
}

TEST_CASE("scene object: nested objects are found by element or by name") {
  const auto object = shape(
      "<medium type='homogeneous' name='interior'/><bsdf type='a'/>"
      "\n<bsdf type='b'/><float name='f' value='1'/>");
  CHECK(object->child("interior", "medium")->type() == "homogeneous");
  CHECK(object->child("exterior", "medium") == nullptr);
  CHECK(object->only_child("medium")->type() == "homogeneous");
  CHECK(object->only_child("emitter") == nullptr);
  CHECK(object->children("bsdf").size() == 2);
  CHECK(object->children().size() == 3);
  CHECK_MESSAGE_HAS(error_of([&] { object->only_child("bsdf"); }),
                    "scene.xml:4: ", "2 nested <bsdf>", "allowed: one");
  CHECK_MESSAGE_HAS(error_of([&] { object->child("interior", "bsdf"); }), "\"interior\"",
                    "allowed: <bsdf>");
  CHECK_MESSAGE_HAS(error_of([&] { object->child("f", "medium"); }), "<float>",
                    "allowed: <medium>");
}

TEST_CASE("scene object: what nobody asked for is an error that lists what was asked for") {
  const auto misspelt =
      shape("<float name='radius' value='1'/>\n<float name='radiuss' value='2'/>");
  misspelt->number("radius");
  misspelt->point("center", glm::dvec3(0));
  misspelt->children("bsdf");
  misspelt->child("interior", "medium");
  CHECK_MESSAGE_HAS(error_of([&] { misspelt->reject_unknown(); }),
                    "scene.xml:4: ", "<shape type=\"ball\">", "unknown parameter \"radiuss\"",
                    "allowed: radius, center, <bsdf>, <medium name=\"interior\">");
  misspelt->has("radiuss");
  CHECK(error_of([&] { misspelt->reject_unknown(); }) == "no error");

  const auto nested = shape("<bsdf type='a'/>\n<emitter type='area' name='light'/>");
  nested->children("bsdf");
  CHECK_MESSAGE_HAS(error_of([&] { nested->reject_unknown(); }),
                    "scene.xml:4: ", "<emitter type=\"area\"> of name \"light\"",
                    "allowed: <bsdf>");
  nested->children("emitter");
  CHECK(error_of([&] { nested->reject_unknown(); }) == "no error");
  CHECK_MESSAGE_HAS(error_of([&] { shape("<rgb name='a' value='1'/>")->reject_unknown(); }),
                    "allowed: none");
}

TEST_CASE("scene object: a factory's own errors stand at the object's or the parameter's line") {
  const auto object = shape("\n<float name='f' value='1'/>");
  CHECK_MESSAGE_HAS(error_of([&] { object->fail("is wrong"); }),
                    "scene.xml:2: ", "<shape type=\"ball\">: is wrong");
  CHECK_MESSAGE_HAS(error_of([&] { object->fail("f", "is wrong"); }), "scene.xml:4: ");
  CHECK(object->kind_of("f") == ValueKind::number);
  CHECK_FALSE(object->kind_of("g").has_value());
}
