// SPDX-License-Identifier: MIT
// malus-merge, and malus-image --physical: what is added up, what is refused, what is no light.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "image/merge.hpp"
#include "image/realizability.hpp"
#include "io/exr.hpp"
#include "io/input_error.hpp"
#include "scene_files.hpp"

namespace {

using renderer::Image;
using renderer::NamedImage;

/// One pixel of S0 and its error.
NamedImage part(const std::string& samples, float value, float error = 0) {
  NamedImage file{"part" + samples + ".exr", Image(1, 1, {"S0", "SE0"})};
  file.image.data = {value, error};
  file.image.metadata = {{"malus:samples", samples},
                         {"malus:scene", "5ce9e"},
                         {"malus:integrator", "path"},
                         {"malus:mode", "optimized"},
                         {"malus:stokes_frame", "horizontal"}};
  return file;
}

std::string refusal(const std::vector<NamedImage>& files, bool force = false) {
  try {
    renderer::merge_images(files, force);
  } catch (const renderer::InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("merge: means count by their samples, errors of independent means by squares") {
  const Image merged =
      renderer::merge_images({part("1:0+30", 2, 0.3f), part("2:0+10", 6, 0.5f)}, false);
  CHECK(merged.plane("S0")[0] == doctest::Approx(3));
  CHECK(merged.plane("SE0")[0] == doctest::Approx(std::hypot(0.75 * 0.3, 0.25 * 0.5)));
  CHECK(merged.metadata.at("malus:samples_per_pixel") == "40");
  CHECK(merged.metadata.at("malus:samples") == "1:0+30 2:0+10");
  CHECK(merged.metadata.at("malus:seed") == "1 2");
}

TEST_CASE("merge: in steps is as at once") {
  const auto a = part("7:0+4", 1), b = part("7:4+4", 2), c = part("7:8+8", 5);
  const Image at_once = renderer::merge_images({a, b, c}, false);
  const Image in_steps =
      renderer::merge_images({c, {"ab.exr", renderer::merge_images({b, a}, false)}}, false);
  CHECK(at_once.metadata == in_steps.metadata);
  CHECK(at_once.metadata.at("malus:samples") == "7:0+16");
  CHECK(at_once.plane("S0")[0] == doctest::Approx(3.25));
  CHECK(in_steps.plane("S0")[0] == doctest::Approx(3.25));
}

TEST_CASE("merge: samples that are there twice are refused, unless forced") {
  for (const char* other : {"1:0+30", "1:29+1", "3:0+1 1:10+5"}) {
    CAPTURE(other);
    const std::vector<NamedImage> files = {part("1:0+30", 2), part(other, 2)};
    CHECK(refusal(files).find("samples of seed 1") != std::string::npos);
    CHECK(refusal(files, true).empty());
  }
  CHECK(refusal({part("1:0+30", 2), part("1:30+30", 2)}).empty());
}

TEST_CASE("merge: what is no part of the same picture is refused by name") {
  const auto with = [](const std::string& name, const std::string& value) {
    auto other = part("2:0+30", 2);
    other.image.metadata[name] = value;
    return std::vector<NamedImage>{part("1:0+30", 2), other};
  };
  for (const char* name : {"malus:scene", "malus:integrator", "malus:mode", "malus:version"}) {
    CAPTURE(name);
    CHECK(refusal(with(name, "other")).find(name) != std::string::npos);
    CHECK(refusal(with(name, "other"), true).empty());
  }
  // What no force makes addable.
  CHECK(refusal(with("malus:stokes_frame", "up"), true).find("frame") != std::string::npos);
  CHECK(refusal(with("malus:samples", ""), true).find("no whole sample") != std::string::npos);
  for (const char* bad : {"1", "1:2", "1:2+", "a:0+1", "1:0+1x", "1:0+99999999999999999999"})
    CHECK(refusal(with("malus:samples", bad), true).find("SEED:FIRST+COUNT") != std::string::npos);
  auto files = with("a", "b");
  files[1].image = Image(2, 1, {"S0", "SE0"});
  CHECK(refusal(files, true).find("2 x 1") != std::string::npos);
  files[1].image = Image(1, 1, {"S0"});
  CHECK(refusal(files, true).find("channels") != std::string::npos);
  files = with("a", "b");
  files[1].image.metadata.erase("malus:samples");
  CHECK(refusal(files, true).find("malus:samples") != std::string::npos);
}

TEST_CASE("merge: OpenEXR is not written under the name of another format") {
  const char* const arguments[] = {"malus-merge", "none.exr", "-o", "sum.png"};
  std::ostringstream out, err;
  CHECK(renderer::malus_merge(4, arguments, out, err) == 2);
  CHECK(err.str().find("-o: \"sum.png\"") != std::string::npos);
  CHECK(err.str().find("OpenEXR (.exr)") != std::string::npos);
}

TEST_CASE("merge: pixels beyond light are told from rounding, subnormals and noise") {
  Image image(6, 1, {"S0", "S1", "S2", "S3", "SE0", "SE1", "SE2", "SE3"});
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float least = std::numeric_limits<float>::denorm_min();
  const float values[6][5] = {{1, 0.6f, 0, 0.8f, 0},              // wholly polarised
                              {1, 1.00005f, 0, 0, 0},             // rounded
                              {70 * least, 0, 72 * least, 0, 0},  // rounded in its last digits
                              {1, 0, 1.1f, 0, 0.03f},             // noise excuses it
                              {1, 0, 1.1f, 0, 0.01f},             // it doesn't
                              {nan, 0, 0, 0, 0}};
  for (std::size_t p = 0; p < 6; ++p)
    for (std::size_t i = 0; i < 4; ++i) {
      image.data[i * 6 + p] = values[p][i];
      image.data[(i + 4) * 6 + p] = values[p][4];
    }
  auto result = check_realizability(image, renderer::stokes_image(image, "test"));
  CHECK(result.values == 6);
  CHECK(result.not_finite == 1);
  CHECK(result.beyond_rounding == 2);
  REQUIRE(result.beyond_errors.has_value());
  CHECK(*result.beyond_errors == 1);
  CHECK(result.unphysical() == 2);
  image.channels = {"S0", "S1", "S2", "S3", "a", "b", "c", "d"};
  result = check_realizability(image, renderer::stokes_image(image, "test"));
  CHECK_FALSE(result.beyond_errors.has_value());
  CHECK(result.unphysical() == 3);
}
