// SPDX-License-Identifier: MIT
// The colours that states of polarisation are shown in, and how a file's channels become Stokes
// vectors.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "image/info.hpp"
#include "image/show.hpp"
#include "image/stokes_image.hpp"
#include "io/image.hpp"
#include "io/input_error.hpp"

namespace {

using renderer::Image;
using renderer::InputError;
using renderer::Show;
using renderer::StokesPixel;
using Bytes = std::array<std::uint8_t, 3>;

constexpr StokesPixel unpolarized = {1, 0, 0, 0};
constexpr StokesPixel horizontal = {1, 1, 0, 0};
constexpr StokesPixel diagonal = {1, 0, 1, 0};
constexpr StokesPixel vertical = {1, -1, 0, 0};
constexpr StokesPixel antidiagonal = {1, 0, -1, 0};
constexpr StokesPixel right_circular = {1, 0, 0, 1};
constexpr StokesPixel left_circular = {1, 0, 0, -1};

constexpr Bytes black = {0, 0, 0};

/// A picture of one pixel without colours.
Image one_pixel(const StokesPixel& s, const std::string& frame = "horizontal") {
  Image image(1, 1, {"S0", "S1", "S2", "S3"});
  image.data = {s[0], s[1], s[2], s[3]};
  image.metadata["malus:stokes_frame"] = frame;
  return image;
}

Bytes shown(const StokesPixel& s, Show what, const renderer::Tone& tone = {}) {
  return renderer::show(renderer::stokes_image(one_pixel(s), "test"), what, tone).at(0, 0);
}

/// The hue of HSV in degrees, of a colour that has one.
double hue(const Bytes& color) {
  const double r = color[0];
  const double g = color[1];
  const double b = color[2];
  const double angle = std::atan2(std::sqrt(3.0) * (g - b), 2 * r - g - b) * 180 / std::numbers::pi;
  return angle < 0 ? angle + 360 : angle;
}

}  // namespace

TEST_CASE("horizontal, 45 degree, vertical and 135 degree light have hues 0, 90, 180 and 270") {
  CHECK(hue(shown(horizontal, Show::aolp)) == doctest::Approx(0).epsilon(0.01));
  CHECK(shown(horizontal, Show::aolp) == Bytes{255, 0, 0});
  CHECK(shown(vertical, Show::aolp) == Bytes{0, 255, 255});
  CHECK(hue(shown(diagonal, Show::aolp)) == doctest::Approx(90).epsilon(0.01));
  CHECK(hue(shown(antidiagonal, Show::aolp)) == doctest::Approx(270).epsilon(0.01));
}

TEST_CASE("partly polarised light has the same hue, less bright") {
  const Bytes weak = shown({1, -0.1F, 0, 0}, Show::aolp);
  CHECK(weak[0] == 0);
  CHECK(weak[1] == weak[2]);
  CHECK(weak[1] < 128);
  CHECK(weak[1] > 0);
}

TEST_CASE("unpolarised light is black in every polarisation and grey in the overlay") {
  for (const Show what :
       {Show::s1, Show::s2, Show::s3, Show::dop, Show::dolp, Show::docp, Show::aolp}) {
    CHECK(shown(unpolarized, what) == black);
  }
  CHECK(shown({0.5F, 0, 0, 0}, Show::overlay) == Bytes{188, 188, 188});
}

TEST_CASE("a degree of polarisation is red on black") {
  CHECK(shown(diagonal, Show::dop) == Bytes{255, 0, 0});
  CHECK(shown(left_circular, Show::dop) == Bytes{255, 0, 0});
  CHECK(shown({2, 0.6F, 0, 0.8F}, Show::dop) == Bytes{188, 0, 0});  // 1/2 on the sRGB curve
  CHECK(shown({1, 0, 0.5F, 0.8F}, Show::dolp) == Bytes{188, 0, 0});
  CHECK(shown(right_circular, Show::dolp) == black);
}

TEST_CASE("signed components are green where positive and red where negative") {
  CHECK(shown(horizontal, Show::s1) == Bytes{0, 255, 0});
  CHECK(shown(vertical, Show::s1) == Bytes{255, 0, 0});
  CHECK(shown(diagonal, Show::s2) == Bytes{0, 255, 0});
  CHECK(shown(antidiagonal, Show::s2) == Bytes{255, 0, 0});
  CHECK(shown(right_circular, Show::s3) == Bytes{0, 255, 0});
  CHECK(shown(left_circular, Show::s3) == Bytes{255, 0, 0});
}

TEST_CASE("right circular light is blue and left is yellow") {
  CHECK(shown(right_circular, Show::docp) == Bytes{0, 0, 255});
  CHECK(shown(left_circular, Show::docp) == Bytes{255, 255, 0});
}

TEST_CASE("the overlay of fully polarised light is pure red, also where it is overexposed") {
  CHECK(shown(horizontal, Show::overlay) == Bytes{255, 0, 0});
  CHECK(shown({50, 50, 0, 0}, Show::overlay) == Bytes{255, 0, 0});
  CHECK(shown({0.5F, 0.25F, 0, 0}, Show::overlay) == Bytes{188, 137, 137});
}

TEST_CASE("exposure doubles intensities and leaves degrees alone, the scale does the opposite") {
  CHECK(shown({0.25F, 0.25F, 0, 0}, Show::intensity, {1, 1}) == Bytes{188, 188, 188});
  CHECK(shown({0.25F, 0.25F, 0, 0}, Show::s1, {1, 1}) == Bytes{0, 188, 0});
  CHECK(shown({1, 0.5F, 0, 0}, Show::dop, {3, 1}) == Bytes{188, 0, 0});
  CHECK(shown({1, 0.25F, 0, 0}, Show::dop, {0, 2}) == Bytes{188, 0, 0});
  CHECK(shown({0.5F, 0, 0, 0}, Show::intensity, {0, 2}) == Bytes{188, 188, 188});
}

TEST_CASE("the angle of linear polarisation runs from 0 up to, not including, 180 degrees") {
  constexpr float pi = std::numbers::pi_v<float>;
  CHECK(malus::angle_of_linear_polarization(horizontal) == 0);
  CHECK(malus::angle_of_linear_polarization(diagonal) == doctest::Approx(pi / 4));
  CHECK(malus::angle_of_linear_polarization(vertical) == doctest::Approx(pi / 2));
  CHECK(malus::angle_of_linear_polarization(antidiagonal) == doctest::Approx(3 * pi / 4));
  CHECK(malus::angle_of_linear_polarization(StokesPixel{1, 1, -1e-12F, 0}) < pi);
}

TEST_CASE("a file in the frame \"up\" shows the same polarisation as one in \"horizontal\"") {
  const StokesPixel s = {1, 0.5F, -0.25F, 0.125F};
  const auto up = renderer::stokes_image(one_pixel({s[0], -s[1], -s[2], s[3]}, "up"), "test");
  CHECK(up.at(0, 0)[1] == s[1]);
  CHECK(up.at(0, 0)[2] == s[2]);
  CHECK(up.at(0, 0)[3] == s[3]);
  CHECK(up.metadata.at("malus:stokes_frame") == "horizontal");
}

TEST_CASE("a frame nobody knows is refused") {
  CHECK_THROWS_AS(renderer::stokes_image(one_pixel(horizontal, "sideways"), "test"), InputError);
}

TEST_CASE("colours come in the order R G B and are averaged for what has no colour") {
  Image image(1, 1,
              {"B", "G", "R", "S0.B", "S0.G", "S0.R", "S1.B", "S1.G", "S1.R", "S2.B", "S2.G",
               "S2.R", "S3.B", "S3.G", "S3.R"});
  image.plane("S0.R")[0] = 1;
  image.plane("S0.B")[0] = 0.5F;
  image.plane("S1.B")[0] = 0.75F;
  const auto stokes = renderer::stokes_image(image, "test");
  CHECK(stokes.colors == std::vector<std::string>{"R", "G", "B"});
  CHECK(stokes.mean(0)[0] == doctest::Approx(0.5));
  CHECK(stokes.mean(0)[1] == doctest::Approx(0.25));
  CHECK(renderer::show(stokes, Show::intensity, {}).at(0, 0) == Bytes{255, 0, 188});
  CHECK(renderer::show(stokes, Show::dop, {}).at(0, 0) == Bytes{188, 0, 0});
}

TEST_CASE("a file of plain R G B has an intensity and says that it has no polarisation") {
  Image image(1, 1, {"B", "G", "R"});
  image.plane("R")[0] = 1;
  const auto stokes = renderer::stokes_image(image, "plain.exr");
  CHECK(renderer::show(stokes, Show::intensity, {}).at(0, 0) == Bytes{255, 0, 0});
  try {
    renderer::show(stokes, Show::dop, {});
    FAIL("polarisation out of nothing");
  } catch (const InputError& error) {
    CHECK(std::string(error.what()).find("plain.exr: there is no polarisation") == 0);
  }
}

TEST_CASE("a file that lacks a Stokes channel, or has no colours at all, is refused") {
  CHECK_THROWS_AS(renderer::stokes_image(Image(1, 1, {"S0", "S1", "S2"}), "a"), InputError);
  CHECK_THROWS_AS(renderer::stokes_image(Image(1, 1, {"S0.R", "S1.R", "S2.R", "S3.G"}), "a"),
                  InputError);
  CHECK_THROWS_AS(renderer::stokes_image(Image(1, 1, {"Z"}), "a"), InputError);
}

TEST_CASE("a pixel that is not a number is black and counted") {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  for (const StokesPixel& s :
       {StokesPixel{nan, 0, 0, 0}, StokesPixel{1, nan, 0, 0}, StokesPixel{infinity, 0, 0, 0}}) {
    const auto stokes = renderer::stokes_image(one_pixel(s), "test");
    CHECK(renderer::show(stokes, Show::intensity, {}).at(0, 0) == black);
    CHECK(renderer::show(stokes, Show::aolp, {}).at(0, 0) == black);
    CHECK(renderer::count_not_finite(stokes) == 1);
  }
}

TEST_CASE("the names of --show are known and no others") {
  CHECK(renderer::parse_show("intensity") == Show::intensity);
  CHECK(renderer::parse_show("aolp") == Show::aolp);
  CHECK(renderer::parse_show("overlay") == Show::overlay);
  CHECK_THROWS_AS(renderer::parse_show("dip"), InputError);
}

TEST_CASE("info counts pixels that are no light and gives means of the others") {
  Image image(5, 1, {"S0", "S1", "S2", "S3"});
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::array<StokesPixel, 5> pixels = {StokesPixel{1, 0.6F, 0, 0.8F},
                                             {1, 1.00005F, 0, 0},
                                             {1, 0, 1.1F, 0},
                                             {-1, 0, 0, 0},
                                             {nan, 0, 0, 0}};
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    image.plane("S0")[i] = pixels[i][0];
    image.plane("S1")[i] = pixels[i][1];
    image.plane("S2")[i] = pixels[i][2];
    image.plane("S3")[i] = pixels[i][3];
  }
  const renderer::Info info = renderer::describe(image, renderer::stokes_image(image, "test"));
  CHECK(info.not_finite == 1);
  CHECK(info.unphysical == 2);
  CHECK(info.max_dop == doctest::Approx(1.1));
  REQUIRE(info.mean.size() == 1);
  CHECK(info.mean[0].second[0] == doctest::Approx(0.5));
  CHECK(info.mean[0].second[3] == doctest::Approx(0.2));
  CHECK(renderer::to_text(info).find("5 x 1 pixels") != std::string::npos);
}
