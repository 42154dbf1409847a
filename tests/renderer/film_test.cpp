// SPDX-License-Identifier: MIT
// The film, its reconstruction filters, and where the camera's rays go.
#include <doctest/doctest.h>

#include "film/film.hpp"
#include "render_scenes.hpp"

using namespace render_test;
using renderer::ReconstructionFilter;
using renderer::Vec2;
using renderer::Vec3;

namespace {

struct Moments {
  double mean = 0, variance = 0, reach = 0;
};

/// Over evenly spread u, so without chance.
Moments moments(const ReconstructionFilter& filter, bool second_axis) {
  constexpr int n = 100000;
  double sum = 0, squares = 0, reach = 0;
  for (int i = 0; i < n; ++i) {
    const float u = (static_cast<float>(i) + 0.5f) / n;
    const Vec2 offset = filter.sample(second_axis ? Vec2(0.3f, u) : Vec2(u, 0.3f));
    const double x = static_cast<double>(second_axis ? offset.y : offset.x);
    sum += x;
    squares += x * x;
    reach = std::max(reach, std::abs(x));
  }
  return {sum / n, squares / n, reach};
}

const std::string camera_begin =
    "<sensor type=\"perspective\"><transform name=\"to_world\"><lookat origin=\"0, -5, 0\" "
    "target=\"0, 0, 0\" "
    "up=\"0, 0, 1\"/></transform><film type=\"hdrfilm\"><integer name=\"width\" value=\"40\"/>"
    "<integer name=\"height\" value=\"20\"/></film><float name=\"fov\" value=\"90\"/>";

Vec3 direction(const std::string& parameters, const Vec2& film) {
  return build(camera_begin + parameters + "</sensor>").sensor->ray(film).direction;
}

/// Of the ray in the plane y = 1 before the camera: right and up.
glm::dvec2 slope(const Vec3& d) {
  return {static_cast<double>(d.x / d.y), static_cast<double>(d.z / d.y)};
}

}  // namespace

TEST_CASE("film: reconstruction filters draw offsets of their own mean, variance and reach") {
  using Kind = ReconstructionFilter::Kind;
  for (const bool second : {false, true})
    for (const float width : {0.5f, 1.0f, 1.7f}) {
      CAPTURE(width);
      const double w = static_cast<double>(width);
      const Moments box = moments(ReconstructionFilter(Kind::box, width), second);
      CHECK(std::abs(box.mean) < 1e-4);
      CHECK(box.variance == doctest::Approx(w * w / 3).epsilon(1e-3));
      CHECK(box.reach <= w);
      const Moments tent = moments(ReconstructionFilter(Kind::tent, width), second);
      CHECK(std::abs(tent.mean) < 1e-4);
      CHECK(tent.variance == doctest::Approx(w * w / 6).epsilon(1e-3));
      CHECK(tent.reach <= w);
      // exp(-x^2/2s^2) - exp(-8), cut off at 4 s.
      double mass = 0, squares = 0;
      for (int i = 0; i < 80000; ++i) {
        const double x = -4 + (i + 0.5) / 10000;
        const double f = std::exp(-x * x / 2) - std::exp(-8.0);
        mass += f;
        squares += f * x * x;
      }
      const Moments gaussian = moments(ReconstructionFilter(Kind::gaussian, width), second);
      CHECK(std::abs(gaussian.mean) < 1e-4);
      CHECK(gaussian.variance == doctest::Approx(w * w * squares / mass).epsilon(5e-3));
      CHECK(gaussian.reach <= 4 * w * (1 + 1e-6));
    }
}

TEST_CASE("film: a pixel is the mean of its samples, its error the spread of its batches") {
  renderer::Film film(1, 1, 4);
  const float values[4] = {1, 2, 3, 6};
  for (std::size_t batch = 0; batch < 4; ++batch)
    film.at(0, batch).add({renderer::Rgb(values[batch]), renderer::Rgb(0.0f), renderer::Rgb(-1.0f),
                           renderer::Rgb(0.0f)});
  CHECK(film.total(0).mean(0) == doctest::Approx(3));
  CHECK(film.total(0).mean(6) == doctest::Approx(-1));
  // Sample variance (4 + 1 + 0 + 9)/3, of a mean of four.
  CHECK(film.standard_error(0)[0] == doctest::Approx(std::sqrt(14.0 / 12)));
  CHECK(film.standard_error(0)[6] == doctest::Approx(0));
  CHECK(std::isnan(renderer::Film(1, 1, 1).standard_error(0)[0]));
}

TEST_CASE("film: the paper's frame negates S1 and S2 alone") {
  renderer::Film film(1, 1, 1);
  film.at(0, 0).add(
      {renderer::Rgb(4.0f), renderer::Rgb(1.0f), renderer::Rgb(2.0f), renderer::Rgb(3.0f)});
  const auto horizontal = film.image(renderer::StokesFrame::horizontal);
  const auto up = film.image(renderer::StokesFrame::up);
  for (const char* c : {".R", ".G", ".B"}) {
    const auto at = [&](const renderer::Image& image, const char* s) {
      return image.plane(s + std::string(c))[0];
    };
    CHECK(at(horizontal, "S0") == 4);
    CHECK(at(up, "S0") == 4);
    CHECK(at(horizontal, "S1") == 1);
    CHECK(at(up, "S1") == -1);
    CHECK(at(horizontal, "S2") == 2);
    CHECK(at(up, "S2") == -2);
    CHECK(at(horizontal, "S3") == 3);
    CHECK(at(up, "S3") == 3);
  }
  CHECK(up.plane("R")[0] == 4);
}

TEST_CASE("camera: corners of the film, by the field of view's axis") {
  const auto corner = [](const std::string& axis) {
    return slope(direction("<string name=\"fov_axis\" value=\"" + axis + "\"/>", {0, 0}));
  };
  const double d = std::hypot(40.0, 20.0);
  CHECK(glm::distance(corner("x"), {-1, 0.5}) < 1e-5);
  CHECK(glm::distance(corner("larger"), {-1, 0.5}) < 1e-5);
  CHECK(glm::distance(corner("y"), {-2, 1}) < 1e-5);
  CHECK(glm::distance(corner("smaller"), {-2, 1}) < 1e-5);
  CHECK(glm::distance(corner("diagonal"), {-40 / d, 20 / d}) < 1e-5);
  CHECK(glm::distance(slope(direction("", {1, 1})), {1, -0.5}) < 1e-5);
}

TEST_CASE("camera: a positive principal point offset shows what is farther right and down") {
  const std::string offset =
      number("principal_point_offset_x", 0.2) + number("principal_point_offset_y", 0.1);
  CHECK(glm::distance(slope(direction(offset, {0.5, 0.5})), {0.4, -0.1}) < 1e-5);
}

TEST_CASE("camera: nothing is seen before the near and beyond the far clipping plane") {
  const auto scene =
      build(camera_begin + number("near_clip", 2) + number("far_clip", 7) + "</sensor>");
  const renderer::Ray ray = scene.sensor->ray({0.1f, 0.2f});
  CHECK(ray.origin.y == doctest::Approx(-3));
  CHECK((ray.origin + ray.length * ray.direction).y == doctest::Approx(2));
}

TEST_CASE("camera: the Stokes frame's x is the picture's right, its y is up") {
  const auto scene = build(camera_begin + "</sensor>");
  const auto frame = scene.sensor->frame({0, 1, 0});
  CHECK(frame.x()[0] == doctest::Approx(1));
  CHECK(frame.y()[2] == doctest::Approx(1));
}

TEST_CASE("camera: a focal length is that of a full-frame camera, across the diagonal") {
  const std::string before = camera_begin.substr(0, camera_begin.find("<float name=\"fov\""));
  const auto corner = [&](const std::string& parameters) {
    return slope(build(before + parameters + "</sensor>").sensor->ray({0, 0}).direction);
  };
  const double d = std::hypot(40.0, 20.0);
  for (const double millimetres : {50.0, 28.0}) {
    CAPTURE(millimetres);
    const double half = std::hypot(36.0, 24.0) / 2 / millimetres;
    const std::string given =
        "<string name=\"focal_length\" value=\"" + std::to_string(millimetres) + "mm\"/>";
    CHECK(glm::distance(corner(given), half / d * glm::dvec2(-40, 20)) < 1e-5);
    if (millimetres == 50) CHECK(glm::distance(corner(""), corner(given)) < 1e-6);
  }
}

TEST_CASE("camera: a radiancemeter of an origin and a direction has Mitsuba's up") {
  const auto up = [](const std::string& direction) {
    const auto scene = build(
        "<sensor type=\"radiancemeter\"><point name=\"origin\" value=\"1, 2, 3\"/><vector "
        "name=\"direction\" value=\"" +
        direction + "\"/></sensor>");
    const auto ray = scene.sensor->ray(Vec2(0.5f));
    CHECK(ray.origin == Vec3(1, 2, 3));
    return scene.sensor->frame(ray.direction).y();
  };
  // The first of Mitsuba's two vectors that complete a direction to a basis.
  CHECK(glm::length(up("0, 0, 2") - Vec3(1, 0, 0)) < 1e-6f);
  CHECK(glm::length(up("3, 0, 0") - Vec3(0, 0, -1)) < 1e-6f);
  CHECK(glm::length(up("0, 1, 0") - Vec3(1, 0, 0)) < 1e-6f);
}
