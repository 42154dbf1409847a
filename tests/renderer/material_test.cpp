// SPDX-License-Identifier: MIT
// Masks, bump maps and normal maps: a surface whose normal is perturbed scatters polarised light as
// the surface that really has this normal.
#include <doctest/doctest.h>

#include "picture_files.hpp"

using namespace render_test;
using renderer::Hit;
using renderer::Vec3;

namespace {

/// A rectangle of corners (±1, ±1, 0) that faces +z, u along x and v along y.
std::string plate(const std::string& content) {
  return "<shape type=\"rectangle\">" + content + "</shape>\n";
}

std::string wrapped(const std::string& type, const std::string& detail, const std::string& inner) {
  return "<bsdf type=\"" + type + "\">" + detail + inner + "</bsdf>";
}

const std::string metal =
    bsdf("conductor",
         "<rgb name=\"eta\" value=\"0.2, 0.9, 1.2\"/><rgb name=\"k\" value=\"3.9, 2.4, "
         "2.2\"/>");
const std::string glass = bsdf("dielectric", number("int_ior", 1.5) + number("ext_ior", 1));

/// What is mirrored in the plate, from above and from below: a metal mirror, so that the light that
/// comes from it is polarised, and in that a sky of many colours.
std::string surroundings(const Folder& folder) {
  const std::string sky_map = picture(folder, "sky.exr", 16, 9, [](int x, int y) {
    return glm::vec3(1 + x % 5, 0.5f + static_cast<float>((3 * x + y) % 4), 1 + y);
  });
  return square({-0.58, -2.1, 2}, {1.4, -2.5, 1}, 1.2, bsdf("twosided", metal)) +
         square({-1.7, -0.7, -2.4}, {0.3, -2.2, -1.4}, 1.2, bsdf("twosided", metal)) +
         "<emitter type=\"envmap\">" + file(sky_map) + "</emitter>";
}

/// All twelve numbers that a meter reads of (0, 0, 0) from a point.
std::array<double, 12> readings(const std::string& scene, const glm::dvec3& from,
                                const glm::dvec3& normal, std::uint64_t samples) {
  const auto rendering = render(
      build(meter(from, {0, 0, 0}, glm::normalize(glm::cross(from, normal))) + scene), samples);
  std::array<double, 12> r{};
  for (std::size_t i = 0; i < 12; ++i) r[i] = rendering.film.total(0).mean(i);
  return r;
}

/// The reading of the plate at z = 0 with detail, and of one that really is tilted.
void check_like_tilted(const std::string& detailed, const std::string& plain,
                       const glm::dvec3& normal, const glm::dvec3& from, std::uint64_t samples) {
  const Folder folder;
  const std::string around = surroundings(folder);
  const glm::dvec3 axis(0.31, 0.44, 0.2);
  const auto a = readings(plate(detailed) + around, from, axis, samples);
  const auto b = readings(square({0, 0, 0}, normal, 1, plain) + around, from, axis, samples);
  const auto flat = readings(plate(plain) + around, from, axis, samples);
  double off = 0;
  for (std::size_t i = 0; i < 12; ++i) {
    CHECK(a[i] == doctest::Approx(b[i]).epsilon(1e-3).scale(b[0]));
    off = std::max(off, std::abs(flat[i] - b[i]) / b[0]);
  }
  CHECK(off > 0.02);  // the tilt is to be seen
  // In every component; but glass alone makes no circular light.
  for (std::size_t i = 0; i < (plain == glass ? 9u : 12u); i += 3) CHECK(std::abs(b[i]) > 1e-3);
}

const glm::dvec3 tilted = glm::normalize(glm::dvec3(0.12, -0.16, 1));
const std::string normal_map =
    "<rgb name=\"normalmap\" value=\"" + text(0.5 * tilted + 0.5) + "\"/>";
std::string normal_mapped(const std::string& inner) {
  return wrapped("normalmap", normal_map, inner);
}

const glm::dvec3 above(0.7, 0.9, 1.5), below(0.7, 0.9, -1.5);

/// Height a u + b v in red, green and blue alike, by texels of a picture n wide and high.
std::string ramp(const Folder& folder, float a, float b) {
  constexpr int n = 8;
  return picture(folder, "ramp.exr", n, n, [=](int x, int y) {
    const auto at = [](int i) { return (static_cast<float>(i) + 0.5f) / n; };
    return glm::vec3(a * at(x) + b * at(y));
  });
}

}  // namespace

TEST_CASE("normalmap: a metal plate reflects like one that is really tilted, S0 to S3") {
  check_like_tilted(normal_mapped(metal), metal, tilted, above, 1);
}

TEST_CASE("normalmap: nor is there a difference in glass, from either side") {
  for (const auto& from : {above, below})
    check_like_tilted(normal_mapped(glass), glass, tilted, from, 4096);
}

TEST_CASE("normalmap: within twosided and around it, from behind, it is the same surface") {
  const std::string two = bsdf("twosided", metal);
  for (const auto& from : {above, below}) {
    check_like_tilted(bsdf("twosided", normal_mapped(metal)), two, tilted, from, 1);
    check_like_tilted(normal_mapped(two), two, tilted, from, 1);
  }
}

TEST_CASE("normalmap: each side of twosided has its own") {
  const auto flat_back = bsdf("twosided", normal_mapped(metal) + metal);
  const auto scene = build(meter(above, {0, 0, 0}, {1, 0, 0}) + plate(flat_back));
  for (const float side : {1.0f, -1.0f}) {
    Hit hit;
    const Vec3 to_viewer(0, 0, side);
    REQUIRE(scene.intersect({3.0f * to_viewer, -to_viewer, renderer::infinity}, hit));
    scene.shapes[0].material.facing(hit, to_viewer);
    const Vec3 expected = side > 0 ? Vec3(tilted) : Vec3(0, 0, -1);
    CHECK(glm::length(hit.normal - expected) < 1e-5f);
    CHECK(glm::length(hit.geometric_normal - to_viewer) < 1e-6f);
  }
}

TEST_CASE("normalmap: colours are read from the picture, and the tangent stays across the normal") {
  const Folder folder;
  const std::string map = picture(folder, "map.exr", 2, 1, [](int x, int) {
    return x == 0 ? glm::vec3(0.9f, 0.5f, 0.8f) : glm::vec3(0.5f, 0.3f, 0.9f);
  });
  const auto scene = build(
      meter(above, {0, 0, 0}, {1, 0, 0}) +
      plate(wrapped("normalmap", bitmap("normalmap", map, text_value("filter_type", "nearest")),
                    bsdf("polarizer"))));
  CHECK(scene.warnings.size() == 2);  // it isn't "raw", nor in the scene's folder
  for (const float x : {-0.5f, 0.5f}) {
    Hit hit;
    REQUIRE(scene.intersect({Vec3(x, 0.1f, 2), Vec3(0, 0, -1), renderer::infinity}, hit));
    scene.shapes[0].material.facing(hit, {0, 0, 1});
    const Vec3 expected = glm::normalize(x < 0 ? Vec3(0.8f, 0, 0.6f) : Vec3(0, -0.4f, 0.8f));
    CHECK(glm::length(hit.normal - expected) < 1e-5f);
    CHECK(std::abs(glm::dot(hit.tangent, hit.normal)) < 1e-6f);
    CHECK(glm::length(hit.tangent) == doctest::Approx(1));
    CHECK(hit.tangent.x > 0);
  }
}

TEST_CASE("bumpmap: a ramp is a tilted plate, from both sides") {
  // Over the rectangle u and v are (x + 1)/2 and (y + 1)/2.
  const float a = -0.12f, b = 0.16f;
  const glm::dvec3 normal = glm::normalize(glm::dvec3(-a, -b, 1));
  const Folder folder;
  const std::string detail = bitmap("any", ramp(folder, a, b)) + number("scale", 2);
  const std::string two = bsdf("twosided", metal);
  check_like_tilted(wrapped("bumpmap", detail, metal), metal, normal, above, 1);
  for (const auto& from : {above, below}) {
    check_like_tilted(bsdf("twosided", wrapped("bumpmap", detail, metal)), two, normal, from, 1);
    check_like_tilted(wrapped("bumpmap", detail, two), two, normal, from, 1);
    check_like_tilted(wrapped("bumpmap", detail, glass), glass, normal, from, 4096);
  }
}

TEST_CASE("bumpmap: on a sphere it is the normal of the displaced sphere") {
  const Folder folder;
  const float a = 0.05f, b = -0.08f;
  const auto scene =
      build(meter({0, 0, 9}, {0, 0, 0}, {1, 0, 0}) + "<shape type=\"sphere\">" +
            wrapped("bumpmap", bitmap("any", ramp(folder, a, b)), metal) + "</shape>");
  for (const Vec3 from : {Vec3(-2, 2.5f, 1), Vec3(-1, -2, -2)}) {
    Hit hit;
    REQUIRE(scene.intersect({from, glm::normalize(-from), renderer::infinity}, hit));
    const auto displaced = [&](float u, float v) {
      const float phi = 2 * renderer::pi * u, theta = renderer::pi * v;
      return (1 + 1e-3f * (a * u + b * v)) * Vec3(std::sin(theta) * std::cos(phi),
                                                  std::sin(theta) * std::sin(phi), std::cos(theta));
    };
    // The derivative of the normal is neglected, so the displacement is scaled down and its slope
    // compared.
    const glm::vec2 at = hit.uv;
    constexpr float h = 0.02f;
    const Vec3 du = displaced(at.x + h, at.y) - displaced(at.x - h, at.y);
    const Vec3 dv = displaced(at.x, at.y + h) - displaced(at.x, at.y - h);
    const Vec3 true_normal = glm::normalize(glm::cross(dv, du)), round = hit.normal;
    scene.shapes[0].material.facing(hit, from);
    const Vec3 got = hit.normal - glm::dot(hit.normal, round) * round,
               want = 1e3f * (true_normal - glm::dot(true_normal, round) * round);
    CHECK(glm::length(got - want) < 0.05f * glm::length(want));
  }
}

TEST_CASE("mask: what is not covered passes unchanged, polarised light as well") {
  const std::string source =
      square({0, 0, -2}, {0, 0, 9}, 1, bsdf("polarizer", number("theta", 20))) +
      square({0, 0, -1}, {0, 0, 9}, 1, bsdf("retarder", number("theta", 65))) + sky;
  const std::string eye = meter({0.2, 0.1, 3}, {0, 0, -1}, {0, 1, 0.025});
  const auto black = bsdf("diffuse", number("reflectance", 0));
  const auto masked = [&](double opacity) {
    return plate(wrapped("mask", number("opacity", opacity), black));
  };
  const Reading open = read_meter(eye + source, 4);
  CHECK(std::abs(open.stokes[3]) > 0.05);
  const Reading none = read_meter(eye + masked(0) + source, 4);
  CHECK(difference(open.stokes, none.stokes) < 1e-5);
  CHECK(difference(read_meter(eye + masked(1) + source, 4).stokes, glm::dvec4(0)) == 0);
  constexpr std::uint64_t samples = 1 << 16;
  const Reading some = read_meter(eye + masked(0.3) + source, samples);
  // Four standard errors of a coin of 0.7: with another seed 1 in 16000 would fail.
  const double error = std::sqrt(0.7 * 0.3 / static_cast<double>(samples));
  CHECK(difference(some.stokes / open.stokes[0], 0.7 * open.stokes / open.stokes[0]) < 4 * error);
  for (int i = 1; i < 4; ++i)
    CHECK(some.stokes[i] / some.stokes[0] ==
          doctest::Approx(open.stokes[i] / open.stokes[0]).epsilon(1e-4).scale(1));
}

TEST_CASE("mask: shadows are as dark as what is covered, by the picture") {
  const Folder folder;
  const std::string map =
      picture(folder, "map.exr", 2, 1, [](int x, int) { return glm::vec3(x == 0 ? 0.25f : 0.6f); });
  const std::string floor = square({0, 0, -1}, {0, 0, 9}, 1, bsdf("diffuse"));
  const auto lit = [&](const std::string& card, double x) {
    return read_meter(meter({x, 3, -0.5}, {x, 0, -1}, {1, 0, 0}) + floor + card +
                          "<emitter type=\"point\"><point name=\"position\" x=\"0\" y=\"0\" "
                          "z=\"5\"/></emitter>",
                      4)
        .stokes[0];
  };
  const std::string card = plate(wrapped(
      "mask", bitmap("opacity", map, text_value("filter_type", "nearest")), bsdf("diffuse")));
  CHECK(lit(card, -0.5) == doctest::Approx(0.75 * lit("", -0.5)));
  CHECK(lit(card, 0.5) == doctest::Approx(0.4 * lit("", 0.5)));
}

TEST_CASE("mask: a sheet that covers a half acts on half of the light, on shadow rays as well") {
  const std::string half = plate(wrapped("mask", "", bsdf("polarizer")));
  constexpr std::uint64_t samples = 1 << 14;
  const Reading seen = read_meter(meter({0, 0, 3}, {0, 0, 0}, {1, 0, 0}) + half + sky, samples);
  // Four standard errors of a coin that is worth 1 or ½: with another seed 1 in 16000 would fail.
  const double error = 4 * 0.25 / std::sqrt(static_cast<double>(samples));
  CHECK(std::abs(seen.stokes[0] - 0.75) < error);
  CHECK(std::abs(std::hypot(seen.stokes[1], seen.stokes[2]) - 0.25) < error);
  const auto lit = [&](const std::string& sheet) {
    return read_meter(meter({0.5, 3, -0.5}, {0.5, 0, -1}, {1, 0, 0}) +
                          square({0, 0, -1}, {0, 0, 9}, 1, bsdf("diffuse")) + sheet +
                          "<emitter type=\"point\"><point name=\"position\" x=\"0\" y=\"0\" "
                          "z=\"5\"/></emitter>",
                      4)
        .stokes[0];
  };
  CHECK(lit(half) == doctest::Approx(0.75 * lit("")));
}

TEST_CASE("material: wrappers that cannot hold what they are given say so") {
  const auto error = [](const std::string& material) {
    return scene_test::error_of([&] {
      build(meter(above, {0, 0, 0}, {1, 0, 0}) + plate(material));
    });
  };
  CHECK_MESSAGE_HAS(error(bsdf("mask")), "mask", "needs a <bsdf>");
  CHECK_MESSAGE_HAS(error(wrapped("mask", number("opacity", 1.5), metal)), "opacity", "1.5",
                    "allowed: 0 to 1");
  CHECK_MESSAGE_HAS(error(wrapped("mask", "", wrapped("mask", "", metal))), "masks don't nest");
  CHECK_MESSAGE_HAS(error(bsdf("twosided", wrapped("mask", "", metal))), "around a twosided");
  CHECK_MESSAGE_HAS(error(wrapped("normalmap", "", metal)), "needs a <texture name=\"normalmap\">");
  CHECK_MESSAGE_HAS(error(normal_mapped(normal_mapped(metal))), "don't nest");
  CHECK_MESSAGE_HAS(error(wrapped("bumpmap", "", metal)), "needs a <texture>");
  CHECK_MESSAGE_HAS(error(wrapped("bumpmap", "<texture type=\"checkerboard\"/>", metal)),
                    "no steps", "bilinear");
  CHECK_MESSAGE_HAS(
      error(wrapped("normalmap",
                    normal_map + "<boolean name=\"flip_invalid_normals\" value=\"true\"/>", metal)),
      "flip_invalid_normals", "allowed: false");
}
