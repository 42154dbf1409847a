// SPDX-License-Identifier: MIT
// Filters held before a finished picture obey the laws of the filters held before a lens.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "image/filter.hpp"
#include "image/stokes_image.hpp"
#include "io/image.hpp"
#include "io/input_error.hpp"

namespace {

using renderer::Image;
using renderer::InputError;
using renderer::parse_filter;
using renderer::StokesPixel;

StokesPixel linear_light(double degrees) {
  const double twice = 2 * degrees * std::numbers::pi / 180;
  return {1, static_cast<float>(std::cos(twice)), static_cast<float>(std::sin(twice)), 0};
}

StokesPixel pass(const StokesPixel& light, const std::string& filter) {
  return renderer::pass(light, parse_filter(filter));
}

float through(const std::string& filter, const StokesPixel& light) {
  return pass(light, filter)[0];
}

Image four_channels(const StokesPixel& s) {
  Image image(1, 1,
              {"S0.R", "S0.G", "S0.B", "S1.R", "S1.G", "S1.B", "S2.R", "S2.G", "S2.B", "S3.R",
               "S3.G", "S3.B"});
  for (const char* color : {"R", "G", "B"}) {
    image.plane(std::string("S0.") + color)[0] = s[0];
    image.plane(std::string("S1.") + color)[0] = s[1];
    image.plane(std::string("S2.") + color)[0] = s[2];
    image.plane(std::string("S3.") + color)[0] = s[3];
  }
  return image;
}

}  // namespace

TEST_CASE("Malus's law: a linear filter passes the squared cosine of the angle to the light") {
  for (int light = 0; light < 180; light += 15) {
    for (int filter = -90; filter <= 360; filter += 15) {
      const double cosine = std::cos((light - filter) * std::numbers::pi / 180);
      CHECK(through("linear:" + std::to_string(filter), linear_light(light)) ==
            doctest::Approx(cosine * cosine).epsilon(1e-5));
    }
  }
}

TEST_CASE(
    "crossed polarizers are exactly black, a third between them at 45 degrees passes an eighth") {
  const StokesPixel natural = {1, 0, 0, 0};
  const StokesPixel first = pass(natural, "linear:0");
  CHECK(first[0] == 0.5F);
  CHECK(pass(first, "linear:90")[0] == 0.0F);
  CHECK(pass(pass(first, "linear:45"), "linear:90")[0] == doctest::Approx(0.125));
}

TEST_CASE("a circular filter passes its own hand and stops the other") {
  CHECK(through("circular:right", {1, 0, 0, 1}) == 1);
  CHECK(through("circular:right", {1, 0, 0, -1}) == 0);
  CHECK(through("circular:left", {1, 0, 0, -1}) == 1);
  CHECK(through("circular:left", {1, 0, 0, 1}) == 0);
  CHECK(through("circular:right", {1, 1, 0, 0}) == 0.5F);
}

TEST_CASE("an elliptical filter is linear at ellipticity 0, circular at 45 and -45") {
  const StokesPixel light = {1, 0.3F, -0.4F, 0.5F};
  CHECK(through("elliptical:30,0", light) == doctest::Approx(through("linear:30", light)));
  CHECK(through("elliptical:30,45", light) == doctest::Approx(through("circular:right", light)));
  CHECK(through("elliptical:30,-45", light) == doctest::Approx(through("circular:left", light)));
}

TEST_CASE(
    "the four measurements of the paper's equation 1 come out of a retarder and a polarizer") {
  const StokesPixel s = {2, 0.3F, -0.7F, 1.1F};
  const auto measure = [&](const std::string& retarder, const std::string& polarizer) {
    return pass(pass(s, retarder), polarizer)[0];
  };
  CHECK(measure("retarder:0,0", "linear:0") == doctest::Approx((s[0] + s[1]) / 2));
  CHECK(measure("retarder:0,0", "linear:45") == doctest::Approx((s[0] + s[2]) / 2));
  CHECK(measure("retarder:0,0", "linear:90") == doctest::Approx((s[0] - s[1]) / 2));
  CHECK(measure("retarder:0,90", "linear:45") == doctest::Approx((s[0] + s[3]) / 2));
}

TEST_CASE("a retarder is lossless, keeps the degree of polarisation, and turns with its axis") {
  const StokesPixel s = {1, 0.6F, -0.3F, 0.2F};
  for (const int axis : {0, 20, 45, 110}) {
    const StokesPixel t = pass(s, "retarder:" + std::to_string(axis) + ",70");
    CHECK(t[0] == 1);
    CHECK(malus::degree_of_polarization(t) == doctest::Approx(malus::degree_of_polarization(s)));
    // Light along the axis passes unchanged.
    const StokesPixel along = linear_light(axis);
    const StokesPixel same = pass(along, "retarder:" + std::to_string(axis) + ",70");
    CHECK(same[1] == doctest::Approx(along[1]));
    CHECK(same[2] == doctest::Approx(along[2]));
    CHECK(std::fabs(same[3]) < 1e-6F);
  }
  // A half-wave plate mirrors the angle at its axis.
  const StokesPixel mirrored = pass(linear_light(10), "retarder:30,180");
  CHECK(mirrored[1] == doctest::Approx(linear_light(50)[1]));
  CHECK(mirrored[2] == doctest::Approx(linear_light(50)[2]));
}

TEST_CASE(
    "a picture behind a filter is a picture again, with R G B and the filter's name in its "
    "header") {
  const auto image = renderer::stokes_image(four_channels({1, 0, 1, 0}), "test");
  const auto behind =
      renderer::look_through({parse_filter("linear:0"), parse_filter("linear:90")}, image);
  const Image file = renderer::to_image(behind);
  CHECK(file.channels.size() == 15);
  CHECK(file.plane("R")[0] == 0);
  CHECK(file.metadata.at("malus:filter") == "linear:0 then linear:90");
  const Image half = renderer::to_image(renderer::look_through({parse_filter("linear:0")}, image));
  CHECK(half.plane("G")[0] == 0.5F);
  CHECK(half.plane("S0.B")[0] == 0.5F);
  CHECK(half.plane("S1.B")[0] == 0.5F);
  CHECK(half.plane("S2.B")[0] == 0);
}

TEST_CASE("a filter sees a picture of the frame \"up\" as the same picture") {
  Image up = four_channels({1, -1, 0, 0});
  up.metadata["malus:stokes_frame"] = "up";
  const auto behind =
      renderer::look_through({parse_filter("linear:0")}, renderer::stokes_image(up, "test"));
  CHECK(behind.at(0, 0)[0] == 1);
}

TEST_CASE("a filter before a picture without polarisation is refused") {
  const auto plain = renderer::stokes_image(Image(1, 1, {"R", "G", "B"}), "test");
  CHECK_THROWS_AS(renderer::look_through({parse_filter("linear:0")}, plain), InputError);
}

TEST_CASE("anything but the filters named in the message is refused") {
  for (const char* text :
       {"", "linear", "linear:", "linear:x", "linear:1,2", "linear:1;2", "linear:nan", "linear:inf",
        "linear:1e300", "linear: 45", "circular", "circular:up", "elliptical:1", "elliptical:1,46",
        "retarder:1", "retarder:1,2,3", "retarder:1,", "polaroid:3", "Linear:3"}) {
    CAPTURE(text);
    CHECK_THROWS_AS(parse_filter(text), InputError);
  }
  CHECK_NOTHROW(parse_filter("linear:-22.5"));
  CHECK_NOTHROW(parse_filter("linear:1e1"));
}
