// SPDX-License-Identifier: MIT
// Pictures depend on the seed alone; the families of radiometry agree; standard errors are true.
#include <doctest/doctest.h>

#include <cstring>

#include "render/statistics.hpp"
#include "render_scenes.hpp"

using namespace render_test;

namespace {

std::vector<float> pixels(const Rendering& r) {
  return r.film.image(renderer::StokesFrame::horizontal).data;
}

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

const Definitions small = {{"resolution", "40"}};

}  // namespace

TEST_CASE("render: the same seed gives the same bits on one, two and three threads") {
  for (const char* name : {"box.xml", "diffuse.xml"}) {
    CAPTURE(name);
    const auto scene = example(name, small);
    const auto one = pixels(render(scene, 6, Mode::optimized, 5, 1));
    CHECK(same_bits(one, pixels(render(scene, 6, Mode::optimized, 5, 2))));
    CHECK(same_bits(one, pixels(render(scene, 6, Mode::optimized, 5, 3))));
    CHECK_FALSE(same_bits(one, pixels(render(scene, 6, Mode::optimized, 6, 2))));
  }
  const auto meter_scene = example("brewster.xml");
  const auto one = pixels(render(meter_scene, 1000, Mode::optimized, 5, 1));
  CHECK(same_bits(one, pixels(render(meter_scene, 1000, Mode::optimized, 5, 3))));
}

TEST_CASE("render: without polarising elements both families read the same S0, to rounding") {
  const auto scene = example("diffuse.xml", small);
  const Rendering u = render(scene, 4, Mode::unpolarized), o = render(scene, 4, Mode::optimized);
  CHECK(u.counters.rays == o.counters.rays);
  CHECK(u.counters.shadow_rays == o.counters.shadow_rays);
  double most = 0;
  for (std::size_t p = 0; p < 1600; ++p) {
    const glm::dvec4 a = reading(u, p).stokes, b = reading(o, p).stokes;
    most = std::max(most, std::abs(a.x - b.x) / (a.x + 1e-3));
    most = std::max(most, std::max(std::abs(b.y), std::max(std::abs(b.z), std::abs(b.w))));
  }
  CHECK(most < 1e-5);
}

TEST_CASE(
    "render: the families' S0 differs where polarised light meets a second polarising surface") {
  const auto scene = example("malus_law.xml", {{"angle", "90"}});
  CHECK(reading(render(scene, 4, Mode::unpolarized)).stokes.x == doctest::Approx(0.25));
  CHECK(std::abs(reading(render(scene, 4, Mode::optimized)).stokes.x) < 1e-6);
}

TEST_CASE("render: a time limit ends a rendering that has samples") {
  const auto scene = example("diffuse.xml", small);
  const std::atomic<bool> stop{false};
  renderer::RenderOptions options;
  options.seconds = 0.3;
  options.threads = 2;
  const Rendering r = renderer::render(scene, options, stop, {});
  CHECK(r.seconds >= 0.3);
  CHECK(r.seconds < 3);
  CHECK(r.counters.samples > 1600);
  CHECK_FALSE(r.interrupted);
}

TEST_CASE("render: a stop is heeded, and what was sampled is kept") {
  const auto scene = example("diffuse.xml", small);
  std::atomic<bool> stop{false};
  renderer::RenderOptions options;
  options.samples_per_pixel = std::uint64_t{1} << 40;
  options.threads = 2;
  const Rendering r =
      renderer::render(scene, options, stop, [&](const renderer::Progress&) { stop = true; });
  CHECK(r.interrupted);
  CHECK(r.samples_per_pixel > 0);
  CHECK(r.counters.samples >= r.samples_per_pixel * 1600);
  CHECK(reading(r, 820).stokes.x > 0);
}

TEST_CASE("render: standard errors are those of many seeds") {
  const auto scene = example("brewster.xml");
  constexpr double truth = 25.0 / 338;
  constexpr int seeds = 300;
  double chi2 = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    const Reading r =
        reading(render(scene, 2048, Mode::optimized, 1000 + static_cast<std::uint64_t>(seed)));
    const double z = (r.stokes.x - truth) / r.error.x;
    chi2 += z * z;
  }
  // 64 batches: z is Student's t of 63 degrees of freedom, of variance 63/61; chi2 has the mean 310
  // and the standard deviation
  // 26. Four of them: 6 in 10^5 sets of seeds would fail.
  CHECK(chi2 > 310 - 4 * 26);
  CHECK(chi2 < 310 + 4 * 26);
}

TEST_CASE("render: samples are independent of how many are asked for") {
  // The first 8 of 16 are the 8 that are asked for alone: sums of both halves agree with the whole.
  const auto scene = example("diffuse.xml", small);
  const auto a = render(scene, 8), b = render(scene, 16);
  CHECK(a.film.total(820).count * 2 == b.film.total(820).count);
  CHECK(b.film.total(820).stokes[0] >= a.film.total(820).stokes[0]);
}

TEST_CASE(
    "render: the statistics' measurement is by component and channel, in the frame asked for") {
  // Behind a polarizer at 30 degrees and a retarder nothing is 0 and nothing is alike.
  const auto scene =
      build(meter({0, 0, 4}, {0, 0, 0}, {1, 0, 0}) +
            "<emitter type=\"constant\"><rgb name=\"radiance\" value=\"1, 2, 4\"/></emitter>" +
            square({0, 0, 0}, {0, 0, 1}, 1, bsdf("retarder", number("delta", 70)), {0, 1, 0}) +
            square({0, 0, -1}, {0, 0, 1}, 1, bsdf("polarizer", number("theta", 30)), {0, 1, 0}));
  const Rendering rendering = render(scene, 4);
  const auto total = rendering.film.total(0);
  for (const auto frame : {renderer::StokesFrame::horizontal, renderer::StokesFrame::up}) {
    const auto json = renderer::statistics(scene, {}, rendering, frame, 1)["measurement"];
    for (std::size_t s = 0; s < 4; ++s)
      for (std::size_t c = 0; c < 3; ++c) {
        CAPTURE(s);
        CAPTURE(c);
        const bool turns = frame == renderer::StokesFrame::up && (s == 1 || s == 2);
        const double expected = total.mean(3 * s + c) * (turns ? -1 : 1);
        CHECK(std::abs(expected) > 0.05);
        CHECK(json["S" + std::to_string(s)][c].get<double>() == expected);
      }
  }
}
