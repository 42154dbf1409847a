// SPDX-License-Identifier: MIT
// The environment map: which direction a pixel is, and that directions are drawn as their density
// says.
#include <doctest/doctest.h>

#include <vector>

#include "core/warp.hpp"
#include "picture_files.hpp"

using namespace render_test;
using renderer::EnvironmentMap;
using renderer::Rgb;
using renderer::Sampler;
using renderer::Texels;
using renderer::Vec3;

namespace {

constexpr int width = 6, height = 5;

glm::vec3 color(int x, int y) {
  const int mixed = (7 * x * x + 3 * y * y + x * y) % 11;
  return {0.2f + static_cast<float>(mixed), x, 0.1f * static_cast<float>(y)};
}

/// With a bright spot, a black corner, and light in the pole's row alone of one column.
EnvironmentMap example_map(const glm::mat3& to_world = glm::mat3(1)) {
  Texels t{width, height, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const glm::vec3 c = x == 4 && y == 2 ? glm::vec3(60) : color(x, y);
      const bool dark = (x == 0 || x == 1) && y >= 1 && y <= 3;
      t.values.push_back(dark ? Rgb(0.0f) : Rgb(c.x, c.y, c.z));
    }
  return EnvironmentMap(t, to_world);
}

const glm::mat3 turned = [] {
  const Vec3 a = glm::normalize(Vec3(1, 2, -0.5f)),
             b = glm::normalize(glm::cross(a, Vec3(0, 0, 1)));
  return glm::mat3(a, b, glm::cross(a, b));
}();

/// As Mitsuba's: column from longitude, row from the angle to +y.
Vec3 direction(double column, double row) {
  const double phi = 2 * pi * (column + 0.5) / width, theta = pi * row / (height - 1);
  return Vec3(std::sin(phi) * std::sin(theta), std::cos(theta), -std::cos(phi) * std::sin(theta));
}

/// The mean over the sphere of f(direction), and its standard error.
template <class Function>
glm::dvec2 sphere_mean(const Function& f, int samples) {
  Sampler sampler(5, 6, 7);
  double sum = 0, squares = 0;
  for (int i = 0; i < samples; ++i) {
    const auto value = static_cast<double>(f(renderer::square_to_sphere(sampler.next_2d())));
    sum += value;
    squares += value * value;
  }
  const double mean = sum / samples;
  return {mean, std::sqrt(std::max(0.0, squares / samples - mean * mean) / samples)};
}

}  // namespace

TEST_CASE("envmap: pixels are where Mitsuba has them, and bilinear between") {
  const Folder folder;
  const std::string map = picture(folder, "a.exr", width, height, color);
  const auto scene = build(meter({0, 0, 9}, {0, 0, 0}, {1, 0, 0}) + "<emitter type=\"envmap\">" +
                           file(map) + number("scale", 2) + "</emitter>");
  const auto check = [&](const Vec3& d, const glm::vec3& expected) {
    const Rgb got = scene.environment_radiance(d);
    CAPTURE(d.x);
    CAPTURE(d.y);
    for (int i = 0; i < 3; ++i)
      CHECK(got[static_cast<std::size_t>(i)] == doctest::Approx(2 * expected[i]).epsilon(1e-4));
  };
  for (int y = 1; y + 1 < height; ++y)
    for (int x = 0; x < width; ++x) check(direction(x, y), color(x, y));
  check(direction(1.5, 2), 0.5f * (color(1, 2) + color(2, 2)));
  check(direction(2, 1.25), 0.75f * color(2, 1) + 0.25f * color(2, 2));
  check(direction(-0.5, 2), 0.5f * (color(0, 2) + color(width - 1, 2)));
  check({0, 0, 1}, 0.5f * (color(2, 2) + color(3, 2)));
  check({1, 0, 0}, color(1, 2));
}

TEST_CASE("envmap: it turns with to_world") {
  const Folder folder;
  const std::string map = picture(folder, "a.exr", width, height, color);
  const auto scene =
      build(meter({0, 0, 9}, {0, 0, 0}, {1, 0, 0}) + "<emitter type=\"envmap\">" + file(map) +
            "<transform name=\"to_world\"><rotate x=\"1\" angle=\"90\"/><scale value=\"3\"/>"
            "<translate z=\"4\"/></transform></emitter>");
  // +y becomes +z, −z becomes +y.
  const Vec3 d = direction(4, 1);
  CHECK(scene.environment_radiance({d.x, -d.z, d.y})[0] == doctest::Approx(color(4, 1).x));
}

TEST_CASE("envmap: a drawn direction has the density that it is asked for, and there is light") {
  for (const glm::mat3& to_world : {glm::mat3(1), turned}) {
    const auto map = example_map(to_world);
    Sampler sampler(1, 2, 3);
    for (int i = 0; i < 20000; ++i) {
      Vec3 d;
      float pdf = 0;
      REQUIRE(map.sample(sampler.next_2d(), d, pdf));
      if (!(std::abs(map.pdf(d) - pdf) < 5e-3f * pdf))
        FAIL_CHECK("drawn with ", pdf, ", asked for ", map.pdf(d));
      if (!(malus::max_channel(map.radiance(d)) > 0)) FAIL_CHECK("drawn in the dark");
      CHECK(glm::length(d) == doctest::Approx(1));
    }
  }
}

TEST_CASE("envmap: the density integrates to 1 and is there wherever light is") {
  const auto map = example_map(turned);
  const auto mean = sphere_mean([&](const Vec3& d) { return map.pdf(d); }, 200000);
  // Four standard errors: with another seed 1 in 16000 would fail.
  CHECK(std::abs(4 * pi * mean[0] - 1) < 4 * 4 * pi * mean[1]);
  CHECK(4 * pi * mean[1] < 0.01);
  const auto missed = sphere_mean(
      [&](const Vec3& d) { return malus::max_channel(map.radiance(d)) > 0 && !(map.pdf(d) > 0); },
      50000);
  CHECK(missed[0] == 0);
}

TEST_CASE("envmap: drawn directions are distributed by the density") {
  const auto map = example_map(turned);
  constexpr int columns = 16, rows = 10, samples = 200000, grid = 24;
  const auto world = [](double u, double v) {
    const double phi = 2 * pi * u, z = 1 - 2 * v, r = std::sqrt(1 - z * z);
    return Vec3(r * std::cos(phi), r * std::sin(phi), z);
  };
  std::vector<double> expected(columns * rows), found(columns * rows);
  for (int i = 0; i < columns * rows; ++i)
    for (int j = 0; j < grid * grid; ++j) {
      const double u = (i % columns + (j % grid + 0.5) / grid) / columns;
      const double v = (i / columns + (j / grid + 0.5) / grid) / rows;
      expected[static_cast<std::size_t>(i)] += static_cast<double>(map.pdf(world(u, v))) * 4 * pi *
                                               samples / (columns * rows * grid * grid);
    }
  Sampler sampler(4, 5, 6);
  for (int i = 0; i < samples; ++i) {
    Vec3 d;
    float pdf = 0;
    REQUIRE(map.sample(sampler.next_2d(), d, pdf));
    const double u = std::atan2(d.y, d.x) / (2 * pi), v = (1 - static_cast<double>(d.z)) / 2;
    const int column = std::min(static_cast<int>((u < 0 ? u + 1 : u) * columns), columns - 1);
    found[static_cast<std::size_t>(column +
                                   columns * std::min(static_cast<int>(v * rows), rows - 1))] += 1;
  }
  double chi2 = 0;
  int bins = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (expected[i] < 10) continue;
    chi2 += (found[i] - expected[i]) * (found[i] - expected[i]) / expected[i];
    ++bins;
  }
  REQUIRE(bins > 100);
  // The mean and four standard deviations of χ²: with another seed 1 in 10⁴ would fail.
  CHECK(chi2 < bins - 1 + 4 * std::sqrt(2.0 * (bins - 1)));
}

TEST_CASE("envmap: the total is the integral of the radiance, and so is the samples' mean") {
  const auto map = example_map(turned);
  const auto red = sphere_mean([&](const Vec3& d) { return map.radiance(d)[0]; }, 400000);
  const auto total = static_cast<double>(map.total()[0]);
  CHECK(std::abs(4 * pi * red[0] - total) < 4 * 4 * pi * red[1]);
  Sampler sampler(4, 5, 6);
  double sum = 0;
  constexpr int samples = 100000;
  for (int i = 0; i < samples; ++i) {
    Vec3 d;
    float pdf = 0;
    REQUIRE(map.sample(sampler.next_2d(), d, pdf));
    sum += static_cast<double>(renderer::luminance(map.radiance(d)) / pdf);
  }
  const auto bright = static_cast<double>(renderer::luminance(map.total()));
  CHECK(sum / samples == doctest::Approx(bright).epsilon(0.01));
}

TEST_CASE("envmap: directions of a smooth one are drawn in proportion to their luminance") {
  Texels smooth{64, 33, {}};
  for (int y = 0; y < smooth.height; ++y)
    for (int x = 0; x < smooth.width; ++x)
      smooth.values.emplace_back(2 + std::sin(2 * pi * x / 64), 1 + std::cos(0.1 * y), 0.5);
  const EnvironmentMap map(smooth, turned);
  const float bright = renderer::luminance(map.total());
  Sampler sampler(4, 5, 6);
  for (int i = 0; i < 20000; ++i) {
    Vec3 d;
    float pdf = 0;
    REQUIRE(map.sample(sampler.next_2d(), d, pdf));
    // Less in the rows next to a pole, where sin θ is over-estimated.
    const float weight = renderer::luminance(map.radiance(d)) / pdf;
    if (!(weight < 1.01f * bright)) FAIL_CHECK("a weight of ", weight, " for a mean of ", bright);
  }
}

TEST_CASE("envmap: a black one is never drawn") {
  const EnvironmentMap map(Texels{2, 3, std::vector<Rgb>(6, Rgb(0.0f))}, glm::mat3(1));
  Vec3 d;
  float pdf = 0;
  CHECK_FALSE(map.sample({0.3f, 0.6f}, d, pdf));
  CHECK(map.pdf({0, 1, 0}) == 0);
}

TEST_CASE("envmap: a diffuse plate is lit as quadrature says, by a path tracer's two strategies") {
  const Folder folder;
  const std::string map = picture(folder, "a.exr", width, height, [](int x, int y) {
    return x == 3 && y == 1 ? glm::vec3(40) : color(x, y);
  });
  const std::string light = "<emitter type=\"envmap\">" + file(map) + "</emitter>";
  const Vec3 normal = glm::normalize(Vec3(0.2f, 0.7f, 0.5f));
  const std::string content = square({0, 0, 0}, normal, 1, bsdf("diffuse")) + light;
  const std::string eye = meter(2.0 * glm::dvec3(normal) + 0.1, {0, 0, 0}, {0, 0.5, -0.7});
  const auto scene = build(eye + content);
  glm::dvec3 irradiance(0);
  constexpr int n = 1000;
  for (int i = 0; i < 2 * n; ++i)
    for (int j = 0; j < n; ++j) {
      const double phi = pi * (i + 0.5) / n, z = 1 - 2 * (j + 0.5) / n, r = std::sqrt(1 - z * z);
      const Vec3 d(r * std::cos(phi), z, r * std::sin(phi));
      const Rgb l = scene.environment_radiance(d);
      const double weight =
          std::max(0.0, static_cast<double>(glm::dot(d, normal))) * 4 * pi / (2 * n * n);
      irradiance += weight * glm::dvec3(l[0], l[1], l[2]);
    }
  const auto rendering = render(scene, 1 << 16);
  for (std::size_t c = 0; c < 3; ++c) {
    const double mean = rendering.film.total(0).mean(c),
                 error = rendering.film.standard_error(0)[c];
    const double expected = 0.5 / pi * irradiance[static_cast<int>(c)];
    // Four standard errors, of three numbers: with another seed 2 in 10⁴ would fail.
    CHECK(std::abs(mean - expected) < 4 * error + 1e-4 * expected);
    CHECK(error < 5e-3 * expected);
  }
}

TEST_CASE("envmap: what is wrong with it is said") {
  const Folder folder;
  const auto error = [&](const std::string& content) {
    return scene_test::error_of([&] {
      build(meter({0, 0, 9}, {0, 0, 0}, {1, 0, 0}) + "<emitter type=\"envmap\">" + content +
            "</emitter>");
    });
  };
  CHECK_MESSAGE_HAS(error(""), "envmap", "filename", "missing");
  CHECK_MESSAGE_HAS(error(file("none.exr")), "scene.xml:3: ", "none.exr", "no such file");
  const std::string small = picture(folder, "s.exr", 2, 2, color);
  CHECK_MESSAGE_HAS(error(file(small)), "scene.xml:3: ", "s.exr", "2 x 2 pixels; allowed: 2 x 3");
  const std::string negative =
      picture(folder, "n.exr", 4, 4, [](int x, int) { return glm::vec3(x == 0 ? -1.0f : 1.0f); });
  CHECK_MESSAGE_HAS(error(file(negative)), "n.exr", "radiance -1; allowed: 0 or more");
  const std::string good = picture(folder, "g.exr", 4, 4, color);
  CHECK_MESSAGE_HAS(error(file(good) + "<transform name=\"to_world\"><scale x=\"2\"/></transform>"),
                    "\"to_world\" shears or stretches");
  CHECK_MESSAGE_HAS(error(file(good) + number("scale", -1)), "scale", "-1");
  CHECK_MESSAGE_HAS(scene_test::error_of([&] {
                      build(meter({0, 0, 9}, {0, 0, 0}, {1, 0, 0}) + sky +
                            "<emitter type=\"envmap\">" + file(good) + "</emitter>");
                    }),
                    "one environment");
}
