// SPDX-License-Identifier: MIT
// Grid volumes: the values between cells, and the files they come from.
#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <functional>
#include <limits>

#include "core/affine.hpp"
#include "core/sampler.hpp"
#include "media/read_grid_volume.hpp"
#include "scene_files.hpp"

using namespace renderer;
using scene_test::error_of;
using scene_test::Folder;

namespace {

using Filter = DensityGrid::Filter;
using Outside = DensityGrid::Outside;

const glm::dmat4 unit(1.0);

std::string word(std::uint32_t w) {
  std::string bytes;
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>(w >> (8 * i) & 255);
  return bytes;
}
std::string word(float v) { return word(std::bit_cast<std::uint32_t>(v)); }

/// A file as Mitsuba writes it, its box from (-1, 0, 1) to (3, 2, 5).
std::string file_of(const glm::ivec3& size, int channels, const std::vector<float>& values) {
  std::string bytes = "VOL\3" + word(1u);
  for (int i = 0; i < 3; ++i) bytes += word(static_cast<std::uint32_t>(size[i]));
  bytes += word(static_cast<std::uint32_t>(channels));
  for (const float v : {-1.f, 0.f, 1.f, 3.f, 2.f, 5.f}) bytes += word(v);
  for (const float v : values) bytes += word(v);
  return bytes;
}

/// 2 x 3 x 4 cells: i ↦ (step · i mod n)/unit of the values in the file's order.
GridValues some_values(int channels) {
  const int n = 24 * channels, step = channels == 1 ? 7 : 5;
  GridValues g{{2, 3, 4}, channels, {}};
  for (int i = 0; i < n; ++i)
    g.values.push_back(static_cast<float>(step * i % n) / (channels == 1 ? 8.0f : 16.0f));
  return g;
}

glm::dmat4 moved() {
  glm::dmat4 m(1.0);  // scaled by (2, 1, ½), turned by 90° about z, moved by (1, 2, 3)
  m[0] = {0, 2, 0, 0};
  m[1] = {-1, 0, 0, 0};
  m[2] = {0, 0, 0.5, 0};
  m[3] = {1, 2, 3, 1};
  return m;
}

void check_near(const Rgb& a, const Rgb& b) {
  for (std::size_t i = 0; i < 3; ++i)
    CHECK(static_cast<double>(a[i]) == doctest::Approx(static_cast<double>(b[i])).epsilon(2e-6));
}

}  // namespace

TEST_CASE("grid: values are trilinear between cells' centres and constant beyond them") {
  // By hand, of values 1 to 8: 1 + x + 2y + 4z between the centres at ¼ and ¾ of a grid of 2 x 2
  // x 2.
  const DensityGrid g({{2, 2, 2}, 1, {1, 2, 3, 4, 5, 6, 7, 8}}, unit);
  check_near(g({0.25f, 0.25f, 0.25f}), Rgb(1));
  check_near(g({0.5f, 0.25f, 0.25f}), Rgb(1.5f));
  check_near(g({0.25f, 0.5f, 0.25f}), Rgb(2));
  check_near(g({0.375f, 0.625f, 0.5f}), Rgb(1 + 0.25f + 1.5f + 2));
  check_near(g({0.75f, 0.75f, 0.75f}), Rgb(8));
  for (const Vec3 corner : {Vec3(0.0f), Vec3(0.1f, 0.2f, 0)}) check_near(g(corner), Rgb(1));
  check_near(g({1, 1, 1}), Rgb(8));
  check_near(g({1, 0, 0.5f}), Rgb(4));
  for (const Vec3 off : {Vec3(-1e-6f, 0.5f, 0.5f), Vec3(0.5f, 1.001f, 0.5f), Vec3(0.5f, 0.5f, 9)}) {
    check_near(g(off), Rgb(0));
    const DensityGrid far({{2, 2, 2}, 1, {1, 2, 3, 4, 5, 6, 7, 8}}, unit, Filter::trilinear,
                          Outside::nearest);
    check_near(far(off), far(glm::clamp(off, 0.0f, 1.0f)));
    CHECK(far(off)[0] >= 1);
  }
  CHECK(g(Vec3(std::numeric_limits<float>::quiet_NaN()))[0] == 0);
  // One cell is the same everywhere.
  check_near(DensityGrid({{1, 1, 1}, 3, {1, 2, 3}}, unit)({0.9f, 0, 0.4f}), Rgb(1, 2, 3));
}

TEST_CASE("grid: values are Mitsuba's") {
  // Of Mitsuba 3.9.1: the values above written by VolumeGrid.write(), then gridvolume's eval() in
  // the variant scalar_rgb, by default, with filter_type nearest, and with to_world translate(1, 2,
  // 3)
  // @ rotate(z, 90) @ scale(2, 1, .5).
  struct Value {
    Vec3 point;
    Rgb grey, color, nearest, nearest_color;
  };
  const Value values[] = {{{0.3f, 0.4f, 0.6f},
                           Rgb(0.7785f),
                           {3.26025f, 3.57275f, 1.30225f},
                           Rgb(0.25f),
                           {4.125f, 4.4375f, 0.25f}},
                          {{0.01f, 0.99f, 0.5f},
                           Rgb(2.375f),
                           {0.9375f, 1.25f, 1.5625f},
                           Rgb(2),
                           {1.5f, 1.8125f, 2.125f}},
                          {{0.75f, 0.5f, 0.125f},
                           Rgb(2.625f),
                           {2.8125f, 3.125f, 3.4375f},
                           Rgb(2.625f),
                           {2.8125f, 3.125f, 3.4375f}},
                          {{0.62f, 0.07f, 0.93f},
                           Rgb(1.3975f),
                           {4.06875f, 1.05125f, 1.36375f},
                           Rgb(1.625f),
                           {4.3125f, 0.125f, 0.4375f}}};
  for (const auto& v : values) {
    check_near(DensityGrid(some_values(1), unit)(v.point), v.grey);
    check_near(DensityGrid(some_values(3), unit)(v.point), v.color);
    check_near(DensityGrid(some_values(1), unit, Filter::nearest)(v.point), v.nearest);
    check_near(DensityGrid(some_values(3), unit, Filter::nearest)(v.point), v.nearest_color);
    const Vec3 world(transform_point(moved(), glm::dvec3(v.point)));
    check_near(DensityGrid(some_values(3), moved())(world), v.color);
  }
}

TEST_CASE("grid: mean, maximum and the stretch of a ray are those of the interpolated values") {
  const DensityGrid g(some_values(3), moved()), grey(some_values(1), moved());
  check_near(grey.mean(), Rgb(23 / 16.0f));
  CHECK(grey.maximum() == doctest::Approx(2.875).epsilon(2e-6));
  // The midpoint rule is exact, with cells of half a cell: linear or constant in each.
  glm::dvec3 sum(0);
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 6; ++y)
      for (int z = 0; z < 8; ++z) {
        const glm::dvec3 p((x + 0.5) / 4, (y + 0.5) / 6, (z + 0.5) / 8);
        const Rgb v = g(Vec3(transform_point(moved(), p)));
        sum += glm::dvec3(v[0], v[1], v[2]);
        CHECK(std::max({v[0], v[1], v[2]}) <= g.maximum());
      }
  check_near(g.mean(), to_rgb(sum / 192.0));

  Sampler sampler(1, 0, 0);
  int met = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 o =
        Vec3(-1, 1, 2) + 4.0f * Vec3(sampler.next_1d(), sampler.next_1d(), sampler.next_1d());
    Vec3 d = Vec3(sampler.next_1d(), sampler.next_1d(), sampler.next_1d()) - Vec3(0.5f);
    if (i % 4 == 0) d[i / 4 % 3] = 0;
    const Vec2 range = grey.clip(o, d);
    met += range.x < range.y;
    // None of these values is 0 where the box is, but for a corner's.
    for (const float t : {-3.0f, -1.0f, -0.3f, 0.2f, 0.7f, 2.0f, 5.0f}) {
      if (std::abs(t - range.x) < 1e-3f || std::abs(t - range.y) < 1e-3f) continue;
      const DensityGrid full({{1, 1, 1}, 1, {1}}, moved());
      CHECK((full(o + t * d)[0] > 0) == (t > range.x && t < range.y));
    }
  }
  CHECK(met > 200);
  CHECK(grey.clip({0, 9, 3.2f}, {1, 0, 0}).x > grey.clip({0, 9, 3.2f}, {1, 0, 0}).y);
}

TEST_CASE("grid: a file is read as Mitsuba writes it") {
  const Folder folder;
  for (const int channels : {1, 3}) {
    const GridValues expected = some_values(channels);
    const GridVolume v =
        read_grid_volume(folder.write("a.vol", file_of({2, 3, 4}, channels, expected.values)));
    CHECK(v.grid.size == expected.size);
    CHECK(v.grid.channels == channels);
    CHECK(v.grid.values == expected.values);
    CHECK(v.lowest == glm::dvec3(-1, 0, 1));
    CHECK(v.highest == glm::dvec3(3, 2, 5));
  }
}

TEST_CASE("grid: what is wrong with a file is said, with its name and what is allowed") {
  const Folder folder;
  const std::string good = file_of({2, 1, 1}, 1, {1, 2});
  const auto error = [&](const std::string& bytes) {
    return error_of([&] { read_grid_volume(folder.write("bad.vol", bytes), {"scene.xml", 7}); });
  };
  const auto with = [&](std::size_t at, const std::string& part) {
    return std::string(good).replace(at, part.size(), part);
  };
  CHECK(error(good) == "no error");
  CHECK_MESSAGE_HAS(error(""), "scene.xml:7: ", "bad.vol", "0 bytes; allowed: a header of 48");
  CHECK_MESSAGE_HAS(error(with(0, "PNG")), "bad.vol", "VOL");
  CHECK_MESSAGE_HAS(error(with(3, "\2")), "bad.vol", "version is 2; allowed: 3");
  CHECK_MESSAGE_HAS(error(with(4, word(2u))), "encoding is 2; allowed: 1");
  CHECK_MESSAGE_HAS(error(with(20, word(6u))), "6 channels; allowed: 1 or 3");
  CHECK_MESSAGE_HAS(error(with(20, word(~0u))), "-1 channels; allowed: 1 or 3");
  for (const std::uint32_t side : {0u, ~0u, 1u << 30})
    for (const std::size_t at : {8u, 12u, 16u})
      CHECK_MESSAGE_HAS(error(with(at, word(side))), "bad.vol",
                        " cells of 1 values; allowed: 1 or");
  // Whose product is 0 in 64 bits.
  CHECK_MESSAGE_HAS(error(with(8, word(1u << 24) + word(1u << 24) + word(1u << 24))),
                    "16777216 x 16777216 x 16777216");
  CHECK_MESSAGE_HAS(error(good.substr(0, 52)), "52 bytes", "2 x 1 x 1", "allowed: 56");
  CHECK_MESSAGE_HAS(error(good + "?"), "57 bytes", "allowed: 56");
  CHECK_MESSAGE_HAS(error(with(52, word(-1.0f))), "value 2 of 2 is -1; allowed: finite",
                    "0 or more");
  for (const float v :
       {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()})
    CHECK_MESSAGE_HAS(error(with(48, word(v))), "value 1 of 2 is", "allowed: finite");
  CHECK_MESSAGE_HAS(error_of([&] {
                      read_grid_volume(folder.path() / "no.vol", {"scene.xml", 7});
                    }),
                    "scene.xml:7: ", "no.vol", "no such file");
  CHECK_MESSAGE_HAS(error_of([&] { read_grid_volume(folder.path(), {"scene.xml", 7}); }), "folder");
}
