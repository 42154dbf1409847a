// SPDX-License-Identifier: MIT
// The numbers and the picture of a comparison, and what malus-image refuses before it writes
// anything.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "image/compare.hpp"
#include "image/compare_panels.hpp"
#include "image/stokes_image.hpp"
#include "io/image.hpp"
#include "io/input_error.hpp"

namespace {

using renderer::Image;
using renderer::InputError;
using renderer::StokesImage;
using Bytes = std::array<std::uint8_t, 3>;

/// Two pixels; every component the same in both but for S1.
Image two_pixels(float s0, float left_s1, float right_s1) {
  Image image(2, 1, {"S0", "S1", "S2", "S3"});
  image.data = {s0, s0, left_s1, right_s1, 0, 0, 0, 0};
  return image;
}

StokesImage stokes(const Image& image) { return renderer::stokes_image(image, "test"); }

}  // namespace

TEST_CASE("means, RMSE, relative error and largest difference are what their definitions say") {
  const auto a = stokes(two_pixels(2, 0, 1));
  const auto b = stokes(two_pixels(2, 3, -3));
  const auto differences = renderer::compare(a, b);
  REQUIRE(differences.size() == 4);
  const renderer::Difference& s1 = differences[1];
  CHECK(s1.component == "S1");
  CHECK(s1.mean_a == doctest::Approx(0.5));
  CHECK(s1.mean_b == doctest::Approx(0));
  CHECK(s1.mean_difference == doctest::Approx(-0.5));
  CHECK(s1.rmse == doctest::Approx(std::sqrt((9.0 + 16.0) / 2)));
  REQUIRE(s1.relative_error.has_value());
  CHECK(*s1.relative_error == doctest::Approx(s1.rmse / 2));
  CHECK(s1.max_abs == doctest::Approx(4));
  CHECK(differences[0].rmse == 0);
}

TEST_CASE("a black picture has no relative error") {
  const auto black = stokes(two_pixels(0, 0, 0));
  const auto differences = renderer::compare(black, stokes(two_pixels(1, 0, 0)));
  CHECK_FALSE(differences[0].relative_error.has_value());
  CHECK(renderer::to_json(differences)["S0"]["Y"]["relative_error"].is_null());
}

TEST_CASE("pixels that are not a number are left out and counted") {
  const auto a = stokes(two_pixels(1, std::numeric_limits<float>::quiet_NaN(), 0.5F));
  const auto differences = renderer::compare(a, stokes(two_pixels(1, 0, 0.25F)));
  CHECK(differences[1].skipped == 1);
  CHECK(differences[1].mean_a == doctest::Approx(0.5));
  CHECK(differences[1].rmse == doctest::Approx(0.25));
}

TEST_CASE("pictures of different sizes or channels cannot be compared") {
  const auto a = stokes(two_pixels(1, 0, 0));
  CHECK_THROWS_AS(renderer::compare(a, stokes(Image(1, 2, {"S0", "S1", "S2", "S3"}))), InputError);
  CHECK_THROWS_AS(renderer::compare(a, stokes(Image(2, 1, {"S0.R", "S1.R", "S2.R", "S3.R"}))),
                  InputError);
  CHECK_THROWS_AS(renderer::compare(a, stokes(Image(2, 1, {"Y"}))), InputError);
  CHECK_NOTHROW(renderer::compare(stokes(Image(2, 1, {"Y"})), stokes(Image(2, 1, {"Y"}))));
}

TEST_CASE("the frame \"up\" and the frame \"horizontal\" of one picture do not differ") {
  Image up = two_pixels(1, -0.5F, 0.25F);
  up.metadata["malus:stokes_frame"] = "up";
  const auto differences = renderer::compare(stokes(two_pixels(1, 0.5F, -0.25F)), stokes(up));
  for (const auto& one : differences) CHECK(one.max_abs == 0);
}

TEST_CASE("the panels are a, difference, b, each S3 S1 over S2 S0") {
  Image a(1, 1, {"S0", "S1", "S2", "S3"});
  a.data = {1, 1, -1, 0};
  Image b = a;
  b.data = {1, 0, -1, 1};
  const auto picture = renderer::comparison_panels(stokes(a), stokes(b), {}, 1);
  // A panel is two pixels and the line between them wide; a gap of eight pixels separates panels.
  REQUIRE(picture.width() == 3 * 4 + 2 * 8);
  REQUIRE(picture.height() == 4);
  const Bytes black = {0, 0, 0};
  const Bytes white = {255, 255, 255};
  const Bytes red = {255, 0, 0};
  const Bytes green = {0, 255, 0};
  const auto panel = [&](int number) {
    const int left = number * 12;
    return std::array<Bytes, 4>{picture.at(left, 0), picture.at(left + 3, 0), picture.at(left, 3),
                                picture.at(left + 3, 3)};
  };
  CHECK(panel(0) == std::array<Bytes, 4>{black, green, red, white});
  CHECK(panel(1) == std::array<Bytes, 4>{green, red, black, black});
  CHECK(panel(2) == std::array<Bytes, 4>{green, black, red, white});
}
