// SPDX-License-Identifier: MIT
// Every strategy (s, t) of bidirectional path tracing, alone and unweighted, gives the light of its
// length of path as path tracing does: s vertices from the light and t from the camera make a path
// of s + t - 1 segments. Were the strategies' own estimates wrong, multiple importance sampling
// might hide it by small weights. Every comparison has stokes_agreement.hpp's error rate, 1 in
// 10^5.
#include <doctest/doctest.h>

#include "stokes_agreement.hpp"

using namespace render_test;
using agreement::Picture;
using agreement::picture;
using renderer::Scene;
using renderer::Strategy;
using scene_test::Folder;

namespace {

std::string rgb(const std::string& name, const std::string& value) {
  return "<rgb name=\"" + name + "\" value=\"" + value + "\"/>";
}

const std::string coat =
    bsdf("pplastic", rgb("diffuse_reflectance", "0.95, 0.9, 0.8") + number("alpha", 0.4));
const std::string metal =
    bsdf("roughconductor", "<string name=\"material\" value=\"Ag\"/>" + number("alpha", 0.4));

/// A square like square(), whose interpolated normal leans to its side, everywhere by 30 degrees.
std::string leaning(const Folder& folder, const glm::dvec3& center, const glm::dvec3& facing,
                    double size, const std::string& content, const glm::dvec3& up) {
  const auto mesh = square_with_normal(folder, "-0.5 0 0.866025");
  return "<shape type=\"ply\"><string name=\"filename\" value=\"" + mesh.string() +
         "\"/><transform name=\"to_world\"><scale value=\"" + std::to_string(size) + "\"/>" +
         look(center, facing, up) + "</transform>" + content + "</shape>\n";
}

/// Everything polarises and nothing is a delta distribution; the floor's and the wall's normals are
/// not their faces'. No two surfaces are near each other, where connections without weights would
/// have no finite variance.
Scene stage() {
  const Folder folder;
  return build(
      "<integrator type=\"bdpt\"><integer name=\"rr_depth\" value=\"100\"/></integrator>"
      "<sensor type=\"perspective\"><float name=\"fov\" value=\"45\"/><transform "
      "name=\"to_world\">" +
      look({0.3, -6, 2.2}, {0.1, 0, 1.4}, {0, 0, 1}) +
      "</transform><film type=\"hdrfilm\"><integer name=\"width\" value=\"32\"/><integer "
      "name=\"height\" value=\"32\"/><rfilter type=\"box\"/></film></sensor>\n" +
      leaning(folder, {0, 0, 0}, {0, 0, 1}, 2, coat, {0, 1, 0}) +
      square({2.6, 0.3, 2}, {0, 0, 1.6}, 1.5, metal, {0, 0, 1}) +
      leaning(folder, {-0.2, 2.8, 2}, {-0.2, 0, 1.7}, 1.5, coat, {0, 0, 1}) +
      square({-2.2, 0.2, 2.4}, {0.5, 0.2, 0.9}, 1.3,
             metal + "<emitter type=\"area\">" + rgb("radiance", "3, 4, 5") + "</emitter>",
             {0, 1, 0}));
}

constexpr int longest = 4;
constexpr std::uint64_t path_samples = 1024;
/// Connections of two vertices that are both within the scene are the noisiest.
std::uint64_t samples_of(const Strategy& strategy) {
  return strategy.s > 1 && strategy.t > 1 ? 1024 : 512;
}

/// Light that has come by exactly k segments, by path tracing.
Picture light_of(Scene& scene, int k) {
  scene.integrator.max_depth = k;
  Picture light = picture(scene, "path", path_samples, 1);
  if (k == 1) return light;
  scene.integrator.max_depth = k - 1;
  light -= picture(scene, "path", path_samples, 1);
  return light;
}

}  // namespace

TEST_CASE("strategies: each alone gives all light of its length, and their mean as well") {
  Scene scene = stage();
  const agreement::Tolerance tolerance{.cells = 4};
  std::uint64_t seed = 10;
  for (int k = 1; k <= longest; ++k) {
    CAPTURE(k);
    scene.integrator.strategy.reset();
    const Picture expected = light_of(scene, k);
    scene.integrator.max_depth = k;
    Picture mean = expected, mean_without_one = expected;
    mean.add(expected, -1);
    mean_without_one.add(expected, -1);
    for (int s = 0; s <= k; ++s) {
      const int t = k + 1 - s;
      CAPTURE(s);
      CAPTURE(t);
      scene.integrator.strategy = Strategy{s, t};
      const Picture alone = picture(scene, "bdpt", samples_of({s, t}), ++seed);
      CHECK_AGREE_BUT_FOR(alone, expected, tolerance);
      mean.add(alone, 1.0 / (k + 1));
      if (s != k / 2) mean_without_one.add(alone, 1.0 / (k + 1));
    }
    CHECK_AGREE_BUT_FOR(mean, expected, tolerance);
    // A strategy that is missing is seen.
    CHECK_DIFFER(mean_without_one, expected);
  }
}

TEST_CASE("strategies: a polarizer between what polarises and what reads intensities alone") {
  // From the lamp to a black mirror, through the polarizer to the floor, and to the camera.
  const std::string mirror =
      bsdf("pplastic", rgb("diffuse_reflectance", "0, 0, 0") + number("alpha", 0.3));
  Scene scene = build(
      "<integrator type=\"volpath\"/>"
      "<sensor type=\"perspective\"><float name=\"fov\" value=\"15\"/><transform "
      "name=\"to_world\">" +
      look({0, -5, 2.5}, {0, 0, 0}, {0, 0, 1}) +
      "</transform><film type=\"hdrfilm\"><integer name=\"width\" value=\"32\"/><integer "
      "name=\"height\" value=\"32\"/><rfilter type=\"box\"/></film></sensor>\n" +
      square({0, 0, 0}, {0, 0, 1}, 1, bsdf("diffuse"), {0, 1, 0}) +
      square({0, 2.3, 1.9}, {0, 0, 1.9}, 1.5, mirror, {0, 0, 1}) +
      square({0, 1.2, 0.6}, {0, 0, 0.6}, 0.9, bsdf("polarizer", number("theta", 0)), {0, 0, 1}) +
      square({0, 0, 3.8}, {0, 2.3, 1.9}, 0.3,
             "<emitter type=\"area\">" + rgb("radiance", "30, 40, 50") + "</emitter>", {0, 0, 1}));
  const Picture expected = light_of(scene, 3);
  CHECK(agreement::Estimate(expected.cell(0, 0, 32, 0)).mean > 1e-4);
  scene.integrator.max_depth = 3;
  scene.integrator.strategy = Strategy{2, 2};
  CHECK_AGREE(picture(scene, "bdpt", samples_of({2, 2}), 5), expected);
}

TEST_CASE("strategies: one alone gives nothing of paths of another length") {
  Scene scene = stage();
  scene.integrator.name = "bdpt";
  const auto light = [&](int max_depth) {
    scene.integrator.max_depth = max_depth;
    const auto rendering = agreement::render(scene, agreement::batches, 1);
    double sum = 0;
    for (std::size_t p = 0; p < 32 * 32; ++p) sum += rendering.film.total(p).mean(0);
    return sum;
  };
  for (const auto& strategy : {Strategy{0, 4}, Strategy{1, 3}, Strategy{2, 2}, Strategy{3, 1}}) {
    CAPTURE(strategy.s);
    scene.integrator.strategy = strategy;
    const double of_three = light(3);
    CHECK(light(2) == 0);
    CHECK(of_three > 0);
    // Longer paths draw more random numbers, but none before these.
    CHECK(light(6) == of_three);
  }
}

TEST_CASE("strategies: hidden lights are hidden from those that see the light itself") {
  Scene scene = stage();
  scene.integrator.hide_emitters = true;
  scene.integrator.max_depth = 1;
  for (const auto& strategy : {Strategy{0, 2}, Strategy{1, 1}}) {
    CAPTURE(strategy.s);
    scene.integrator.strategy = strategy;
    const auto rendering = agreement::render(scene, agreement::batches, 1);
    double sum = 0;
    for (std::size_t p = 0; p < 32 * 32; ++p) sum += rendering.film.total(p).mean(0);
    CHECK(sum == 0);
  }
}
