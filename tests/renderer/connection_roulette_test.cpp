// SPDX-License-Identifier: MIT
// Connections that would bring little are left to chance: the mean stays what it is, in four Stokes
// components, and so does the noise, while shadow rays are saved. Comparisons of means have the
// error rate that stokes_agreement.hpp states, 1 in 10^5.
#include <doctest/doctest.h>

#include "agreement_scenes.hpp"
#include "integrators/connection_roulette.hpp"

using namespace agreement;
using renderer::ConnectionRoulette;
using renderer::Rgb;

namespace {

Rendering render_at(Scene& scene, const std::string& integrator, float threshold,
                    std::uint64_t samples, std::uint64_t seed = 1) {
  scene.integrator.name = integrator;
  scene.integrator.connection_threshold = threshold;
  return agreement::render(scene, samples, seed);
}

/// The mean of the pixels' variances, by S0.R … S3.B.
std::vector<double> noise_of(const Rendering& rendering) {
  std::vector<double> sum(12);
  const auto pixels = static_cast<std::size_t>(rendering.film.width()) *
                      static_cast<std::size_t>(rendering.film.height());
  for (std::size_t p = 0; p < pixels; ++p) {
    const auto error = rendering.film.standard_error(p);
    for (std::size_t i = 0; i < sum.size(); ++i)
      sum[i] += error[i] * error[i] / static_cast<double>(pixels);
  }
  return sum;
}

/// A room of coats and metal, in which light is scattered many times.
Scene room(const std::string& light) {
  return build(path_of(8) + camera() + stage +
               square({-2.6, 0, 1.9}, {0, 0, 1}, 1.8, coat, {0, 0, 1}) +
               square({2.6, 0, 1.9}, {0, 0, 1}, 1.8, coat, {0, 0, 1}) + light);
}
const std::string bulb =
    "<emitter type=\"point\"><point name=\"position\" value=\"-0.5, -0.6, 3\"/>" +
    rgb("intensity", "9, 8, 7") + "</emitter>\n";
/// Of which nothing but the floor's middle is seen.
Scene dark_room() {
  const std::string dark =
      bsdf("pplastic", number("diffuse_reflectance", 0.1) + number("alpha", 0.3));
  return build(path_of(8) + camera("", number("fov", 15), {0, 0, 0}) + bulb +
               square({0, 0, 0}, {0, 0, 1}, 2, dark, {0, 1, 0}) +
               square({0, 2.3, 1.9}, {0, 0, 1.6}, 1.5, dark, {0, 0, 1}) +
               square({-2.6, 0, 1.9}, {0, 0, 1}, 1.8, dark, {0, 0, 1}) +
               square({2.6, 0, 1.9}, {0, 0, 1}, 1.8, dark, {0, 0, 1}));
}
const std::string mist = "<medium type=\"homogeneous\" id=\"mist\">" +
                         rgb("sigma_t", "0.4, 0.3, 0.2") + number("albedo", 0.9) +
                         "<phase type=\"rayleigh\"/></medium>\n";

}  // namespace

TEST_CASE("connection roulette: chances are c / (t L), of the brightest channel") {
  ConnectionRoulette roulette;
  CHECK(roulette.chance(Rgb(1e-9f), 0.5f) == 1);  // nothing to compare it with
  roulette.find(Rgb(3, 2, 1));
  roulette.find(Rgb(1, 2, 3));
  CHECK(roulette.chance(Rgb(1, 1, 1), 0.5f) == 0.5f);
  CHECK(roulette.chance(Rgb(0.2f, 1, 0.4f), 0.5f) == 0.5f);
  CHECK(roulette.chance(Rgb(2, 0, 0), 0.5f) == 1);
  CHECK(roulette.chance(Rgb(0, 0, 5), 0.5f) == 1);
  CHECK(roulette.chance(Rgb(0.0f), 0.5f) == 0);
  CHECK(roulette.chance(Rgb(1e-9f), 0) == 1);
  roulette.begin();
  CHECK(roulette.chance(Rgb(1e-9f), 1) == 1);
  // One channel was in the dark so far.
  roulette.find(Rgb(1, 0, 1));
  CHECK(roulette.chance(Rgb(0.1f, 0.001f, 0.1f), 1) == 1);
}

TEST_CASE("connection roulette: the mean stays, in all four components") {
  Scene scene = room(lamp);
  for (const char* name : {"bdpt", "vcm"}) {
    CAPTURE(std::string(name));
    const Rendering every = render_at(scene, name, 0, 64, 1),
                    some = render_at(scene, name, 1, 64, 2);
    CHECK_AGREE(Picture(every), Picture(some));
    CHECK(every.counters.left_to_chance == 0);
    CHECK(some.counters.left_to_chance > some.counters.connections / 5);
    CHECK(some.counters.shadow_rays < 0.85 * static_cast<double>(every.counters.shadow_rays));
  }
}

TEST_CASE("connection roulette: the mean stays among media, whose weights come later") {
  Scene scene =
      build(mist + path_of(6) + "<sensor type=\"perspective\">" + number("fov", 40) +
            "<transform name=\"to_world\">" + look({0, -5, 2.5}, {0, 0, 0.7}, {0, 0, 1}) +
            "</transform><ref id=\"mist\"/><film type=\"hdrfilm\">" + integer("width", 32) +
            integer("height", 32) + "<rfilter type=\"box\"/></film></sensor>" + floor_and_wall +
            "<shape type=\"cube\"><transform name=\"to_world\"><scale value=\"8\"/></transform>" +
            bsdf("null") + "<ref name=\"interior\" id=\"mist\"/></shape>" +
            "<emitter type=\"point\"><point name=\"position\" value=\"-0.5, -0.6, 3\"/>" +
            rgb("intensity", "9, 8, 7") + "<ref id=\"mist\"/></emitter>");
  const Rendering every = render_at(scene, "bdpt", 0, 128, 1),
                  some = render_at(scene, "bdpt", 1, 128, 2);
  CHECK_AGREE(Picture(every), Picture(some));
  CHECK(some.counters.left_to_chance > some.counters.connections / 5);
}

TEST_CASE("connection roulette: no component's noise grows by a twentieth") {
  // The second light arrives at dark coats without noise, and what they scatter to each other is
  // little beside it. Seeds are equal, so that at 256 samples a pixel ratios are known to a
  // hundredth, those of S3 to a few.
  Scene under_lamp = room(lamp), in_the_dark = dark_room();
  for (Scene* scene : {&under_lamp, &in_the_dark}) {
    const float threshold = scene->integrator.connection_threshold;
    const Rendering every = render_at(*scene, "bdpt", 0, 256),
                    some = render_at(*scene, "bdpt", threshold, 256);
    CHECK(some.counters.left_to_chance > some.counters.connections / 50);
    const auto noise = noise_of(every), noise_by_chance = noise_of(some);
    for (std::size_t i = 0; i < 12; ++i) {
      CAPTURE(i);
      CHECK(noise_by_chance[i] <= (i < 9 ? 1.02 : 1.05) * noise[i]);
    }
  }
}
