// SPDX-License-Identifier: MIT
// Transforms mean what they mean in Mitsuba: their order, their signs, and which of them are
// refused.
#include "scene/transform.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "scene_files.hpp"

using namespace scene_test;

namespace {

glm::dmat4 transform(std::string_view steps) {
  return read("<transform name='t'>" + std::string(steps) + "</transform>")->transform("t");
}

std::string transform_error(std::string_view steps) {
  return read_error("<transform name='t'>\n" + std::string(steps) + "</transform>");
}

double difference(const glm::dvec3& a, const glm::dvec3& b) { return glm::length(a - b); }

glm::dvec3 moved(std::string_view steps, const glm::dvec3& point) {
  return renderer::transform_point(transform(steps), point);
}

}  // namespace

TEST_CASE("scene transform: no steps and no transform are the identity") {
  CHECK(transform("") == glm::dmat4(1.0));
  CHECK(read("")->transform("t") == glm::dmat4(1.0));
  CHECK(read("")->transform("t", glm::dmat4(2.0)) == glm::dmat4(2.0));
}

TEST_CASE("scene transform: a later step acts on what the earlier one gives") {
  CHECK(moved("<translate x='1'/><scale value='2'/>", {1, 0, 0}) == glm::dvec3(4, 0, 0));
  CHECK(moved("<scale value='2'/><translate x='1'/>", {1, 0, 0}) == glm::dvec3(3, 0, 0));
  CHECK(moved("<translate value='-1, 3, 4'/><rotate y='1' angle='90'/>", {1, 0, 0}) ==
        glm::dvec3(4, 3, 0));
}

TEST_CASE("scene transform: coordinates left out are 0 in a translation and 1 in a scale") {
  CHECK(moved("<translate y='2'/>", {1, 1, 1}) == glm::dvec3(1, 3, 1));
  CHECK(moved("<scale y='2'/>", {1, 1, 1}) == glm::dvec3(1, 2, 1));
  CHECK(moved("<scale value='2, 3, -4'/>", {1, 1, 1}) == glm::dvec3(2, 3, -4));
}

TEST_CASE(
    "scene transform: rotation is counter-clockwise, in degrees, about an axis of any length") {
  CHECK(moved("<rotate z='1' angle='90'/>", {1, 0, 0}) == glm::dvec3(0, 1, 0));
  CHECK(moved("<rotate x='5' angle='90'/>", {0, 1, 0}) == glm::dvec3(0, 0, 1));
  CHECK(moved("<rotate y='1' angle='-90'/>", {1, 0, 0}) == glm::dvec3(0, 0, 1));
  CHECK(moved("<rotate value='0, 0, 1' angle='540'/>", {1, 2, 3}) == glm::dvec3(-1, -2, 3));
  const double half = std::sqrt(0.5);
  CHECK(difference(moved("<rotate z='1' angle='45'/>", {1, 0, 0}), {half, half, 0}) < 1e-15);
  // A third of a turn about the diagonal passes the axes on.
  CHECK(difference(moved("<rotate value='1, 1, 1' angle='120'/>", {1, 0, 0}), {0, 1, 0}) < 1e-15);
}

TEST_CASE("scene transform: a matrix is written by rows, with 16 or 9 numbers") {
  CHECK(moved("<matrix value='1 0 0 5  0 2 0 6\n 0 0 3 7  0 0 0 1'/>", {1, 1, 1}) ==
        glm::dvec3(6, 8, 10));
  CHECK(moved("<matrix value='0 -1 0  1 0 0  0 0 1'/>", {1, 0, 0}) == glm::dvec3(0, 1, 0));
}

TEST_CASE("scene transform: lookat looks along +z with +y up and +x to the left") {
  const glm::dmat4 m = transform("<lookat origin='1, 2, 3' target='1, 7, 3' up='0, 0, 2'/>");
  CHECK(renderer::transform_point(m, glm::dvec3(0)) == glm::dvec3(1, 2, 3));
  CHECK(difference(renderer::transform_vector(m, {0, 0, 1}), {0, 1, 0}) < 1e-15);
  CHECK(difference(renderer::transform_vector(m, {0, 1, 0}), {0, 0, 1}) < 1e-15);
  CHECK(difference(renderer::transform_vector(m, {1, 0, 0}), {-1, 0, 0}) < 1e-15);
  CHECK(glm::determinant(m) == doctest::Approx(1.0));
}

TEST_CASE("scene transform: lookat without up finds some direction across") {
  for (const char* target : {"0, 0, 1", "0, 0, -1", "1, 2, 3", "-1e6, 0, 0"}) {
    const glm::dmat4 m =
        transform("<lookat origin='0, 0, 0' target='" + std::string(target) + "'/>");
    CHECK(glm::determinant(m) == doctest::Approx(1.0));
    CHECK(std::abs(glm::dot(glm::dvec3(m[1]), glm::dvec3(m[2]))) < 1e-12);
  }
}

TEST_CASE("scene transform: a coordinate system is right-handed and orthonormal for every axis") {
  for (const glm::dvec3& n : {glm::dvec3(0, 0, 1), glm::dvec3(0, 0, -1), glm::dvec3(1, 0, 0),
                              glm::dvec3(0, -1, 0), glm::normalize(glm::dvec3(1, 2, -3))}) {
    const auto [s, t] = renderer::coordinate_system(n);
    CHECK(glm::length(s) == doctest::Approx(1.0));
    CHECK(difference(glm::cross(s, t), n) < 1e-12);
  }
}

TEST_CASE("scene transform: normals stay at right angles to a sheared surface") {
  const glm::dmat4 m = transform("<matrix value='1 2 0  0 3 1  0.5 0 2'/>");
  const glm::dvec3 normal = renderer::transform_normal(m, {0, 0, 1});
  CHECK(std::abs(glm::dot(normal, renderer::transform_vector(m, {1, 0, 0}))) < 1e-12);
  CHECK(std::abs(glm::dot(normal, renderer::transform_vector(m, {0, 1, 0}))) < 1e-12);
}

TEST_CASE("scene transform: one without an inverse is an error at its step") {
  CHECK_MESSAGE_HAS(transform_error("<translate x='1'/>\n<scale x='0'/>"),
                    "scene.xml:4: ", "<scale>", "cannot be inverted");
  CHECK_MESSAGE_HAS(transform_error("<matrix value='1 2 3  2 4 6  0 0 1'/>"),
                    "scene.xml:3: ", "cannot be inverted");
  // Small is not singular.
  CHECK(transform_error("<scale value='1e-9'/>") == "no error");
}

TEST_CASE("scene transform: what overflows or projects is an error") {
  CHECK_MESSAGE_HAS(transform_error("<scale value='1e200'/>\n<scale value='1e200'/>"),
                    "scene.xml:4: ", "overflows");
  CHECK_MESSAGE_HAS(transform_error("<matrix value='1 0 0 0 0 1 0 0 0 0 1 0 0 0 1 1'/>"),
                    "scene.xml:3: ", "last row is 0 0 1 1", "allowed: 0 0 0 1");
  CHECK_MESSAGE_HAS(transform_error("<matrix value='1 0 nan 0 1 0 0 0 1'/>"), "\"nan\"");
  CHECK_MESSAGE_HAS(transform_error("<matrix value='1 0 0'/>"), "3 values", "9 or 16");
}

TEST_CASE("scene transform: a lookat without a direction is an error") {
  CHECK_MESSAGE_HAS(transform_error("<lookat origin='1,2,3' target='1,2,3' up='0,0,1'/>"),
                    "scene.xml:3: ", "\"1,2,3\"", "two different points");
  CHECK_MESSAGE_HAS(transform_error("<lookat origin='0,0,0' target='0,0,5' up='0,0,-2'/>"),
                    "scene.xml:3: ", "\"0,0,-2\"", "any other direction");
  CHECK_MESSAGE_HAS(transform_error("<lookat origin='0,0,0'/>"), "\"target\" is missing");
  CHECK_MESSAGE_HAS(transform_error("<lookat origin='0,0' target='0,0,1'/>"), "2 values",
                    "3 numbers");
}

TEST_CASE("scene transform: malformed steps are errors") {
  CHECK_MESSAGE_HAS(transform_error("<rotate x='1'/>"), "\"angle\" is missing");
  CHECK_MESSAGE_HAS(transform_error("<rotate angle='1'/>"), "axis is zero");
  CHECK_MESSAGE_HAS(transform_error("<rotate x='1' angle='1d'/>"), "\"1d\"");
  CHECK_MESSAGE_HAS(transform_error("<rotate x='1' degrees='1'/>"), "\"degrees\"", "angle");
  CHECK_MESSAGE_HAS(transform_error("<rotation x='1'/>"), "<rotation>",
                    "allowed: translate, rotate, scale, lookat, matrix");
  CHECK_MESSAGE_HAS(transform_error("text"), "stray text \"text\"");
  CHECK_MESSAGE_HAS(read_error("<transform/>"), "\"name\" is missing");
  CHECK_MESSAGE_HAS(transform_error("<scale value='1, 2'/>"), "2 values", "1 or 3");
}
