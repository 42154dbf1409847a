// SPDX-License-Identifier: MIT
// What can't exchange light, by half-spaces and balls.
#include "scene/extent.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>

using glm::dvec3;
using renderer::Facet;

TEST_CASE("extents: tell what is in front of what, and never too little") {
  const auto wall = [](const dvec3& n, const dvec3& at, renderer::Sides sides) {
    const dvec3 u = std::abs(n.x) > 0.5 ? dvec3(0, 1, 0) : dvec3(1, 0, 0), v = glm::cross(n, u);
    return Facet::plane(n, at, {at, at + u, at + v}, sides);
  };
  const renderer::Sides front{true, false}, both{true, true};
  const dvec3 x(1, 0, 0);
  const Facet a = wall(x, dvec3(0), front), facing = wall(-x, x * 3.0, front);
  const Facet below = wall(x, -x, front), glass_below = wall(x, -x, both);
  CHECK(a.exchanges_with(facing, 0));
  CHECK(facing.exchanges_with(a, 0));
  CHECK_FALSE(a.exchanges_with(below, 0));
  CHECK_FALSE(a.exchanges_with(below, 5));  // the same way up, whatever is merged
  CHECK_FALSE(a.exchanges_with(glass_below, 0));
  CHECK(a.exchanges_with(glass_below, 1.1));
  const Facet across(wall(dvec3(0.8, -0.6, 0), dvec3(1, 3, 0), front));
  CHECK(a.exchanges_with(across, 0));
  CHECK_FALSE(wall(x, x * 3.0, front).exchanges_with(wall(-x, dvec3(0), front), 0));
  CHECK_FALSE(a.exchanges_with_itself(5));
  CHECK_FALSE(glass_below.exchanges_with_itself(0));
  const Facet mirror_ball = Facet::sphere(x * 2.0, 1, true, false, false);
  CHECK(a.exchanges_with(mirror_ball, 0));
  CHECK_FALSE(mirror_ball.exchanges_with_itself(0));
  CHECK(mirror_ball.exchanges_with_itself(0.1));
  CHECK_FALSE(mirror_ball.exchanges_with(Facet::box(x * 1.8, x * 2.2), 0));
  CHECK(mirror_ball.exchanges_with(Facet::box(x * 1.8, x * 3.2), 0));
  const Facet hollow = Facet::sphere(x * 2.0, 1, false, true, true);
  CHECK(hollow.exchanges_with_itself(0));
  CHECK_FALSE(hollow.exchanges_with(a, 0));
  CHECK(hollow.exchanges_with(a, 1.1));
  CHECK(Facet::sphere(x * 2.0, 1, false, true, false).exchanges_with(a, 0));
}

TEST_CASE("extents: a mesh sees by its sides, and by everything where those are not clear") {
  const renderer::Sides front{true, false};
  // A mesh's normals say which side is the front, where they are all of one mind.
  using renderer::TriangleMesh;
  const auto sees = [&](const TriangleMesh& mesh, const dvec3& at) {
    renderer::Geometry geometry;
    const auto shape = geometry.add(mesh);
    const renderer::Extent extent = extent_of(geometry, shape, front, false);
    return extent.exchanges_with({{Facet::box(at - 0.1, at + 0.1)}}, 0);
  };
  TriangleMesh triangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}, {}, {{0, 1, 2}}};
  const dvec3 above(0, 0, 1);
  CHECK(sees(triangle, above));
  CHECK_FALSE(sees(triangle, -above));
  triangle.normals = {{0, 0, 1}, {0.5f, 0, 1}, {0, 0.5f, 1}};
  CHECK_FALSE(sees(triangle, -above));
  triangle.normals[1] = {0, 0, -1};
  CHECK(sees(triangle, -above));
  // Many planes are one box, which sees everything.
  TriangleMesh fan{{{0, 0, 0}}, {}, {}, {}};
  for (std::uint32_t i = 0; i < 30; ++i) {
    const auto turn = static_cast<float>(i) * 0.1f;
    fan.positions.push_back({std::cos(turn), std::sin(turn), -turn});
    if (i > 0) fan.triangles.push_back({0, i, i + 1});
  }
  CHECK(sees(fan, dvec3(0, 0, -9)));
}
