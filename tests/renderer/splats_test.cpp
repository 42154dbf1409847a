// SPDX-License-Identifier: MIT
// What light paths leave on the film: a filter's density is the one that camera samples have, all
// of a splat is shared among pixels, and pictures don't depend on the number of threads.
#include <doctest/doctest.h>

#include <vector>

#include "film/exposure.hpp"
#include "render_scenes.hpp"

using namespace render_test;
using renderer::Exposure;
using renderer::FilmSettings;
using renderer::ReconstructionFilter;
using renderer::Rgb;
using renderer::Sampler;
using renderer::SplatList;
using renderer::Vec2;
using Kind = ReconstructionFilter::Kind;

TEST_CASE("splats: a filter's density is the one its samples have") {
  for (const auto& [kind, width] : {std::pair{Kind::box, 0.5f},
                                    {Kind::box, 1.3f},
                                    {Kind::tent, 1.0f},
                                    {Kind::tent, 2.2f},
                                    {Kind::gaussian, 0.5f},
                                    {Kind::gaussian, 1.1f}}) {
    CAPTURE(static_cast<int>(kind));
    CAPTURE(width);
    const ReconstructionFilter filter(kind, width);
    const float r = filter.radius();
    CHECK(filter.density({r * 1.001f, 0}) == 0);
    CHECK(filter.density({0, -r * 1.001f}) == 0);
    CHECK(filter.density({0.3f * width, 0.1f * width}) ==
          doctest::Approx(filter.density({-0.1f * width, 0.3f * width})));
    // The integral up to a sample is the number it is made of.
    constexpr int steps = 20000;
    const double middle = std::sqrt(static_cast<double>(filter.density({0, 0})));
    double sum = 0;
    int k = 0;
    for (int i = 0; i < steps; ++i) {
      const auto x = static_cast<float>(2.0 * (i + 0.5) / steps - 1) * r;
      for (; k < 100 && filter.sample({(static_cast<float>(k) + 0.5f) / 100, 0.5f}).x < x; ++k)
        if (!(std::abs(sum - (k + 0.5) / 100) < 5e-4))
          FAIL_CHECK("at ", x, ": ", sum, " of ", k, " and a half in 100");
      sum += static_cast<double>(filter.density({x, 0}) * r) * 2 / steps / middle;
    }
    CHECK(k == 100);
    CHECK(sum == doctest::Approx(1).epsilon(1e-3));
    CHECK(std::abs(filter.sample({0.5f, 0.5f}).x) < 1e-3f);
    CHECK(filter.sample({0.2f, 0.9f}).y == doctest::Approx(filter.sample({0.9f, 0.2f}).x));
  }
}

namespace {

/// What the pixels hold of splats that read (1, 0, 0, 0).
std::vector<double> exposed(const FilmSettings& film, const std::vector<Vec2>& places) {
  Exposure exposure(film, 2);
  exposure.clear();
  std::vector<SplatList> lists(2);
  const malus::Measurement<Rgb> one(Rgb(1.0f), Rgb(0.0f), Rgb(0.0f), Rgb(0.0f));
  for (std::size_t i = 0; i < places.size(); ++i) lists[i % 2].splats.push_back({places[i], one});
  lists[0].layer = lists[1].layer = 1;
  exposure.add(lists);
  renderer::Film developed(film.crop_width, film.crop_height, 3);
  exposure.develop(0, 0, developed);
  exposure.develop(1, 2, developed);
  std::vector<double> pixels;
  for (std::size_t p = 0; p < static_cast<std::size_t>(film.crop_width * film.crop_height); ++p) {
    CHECK(developed.at(p, 0).mean(0) == 0);
    CHECK(developed.at(p, 1).count == 0);
    pixels.push_back(developed.at(p, 2).mean(0));
  }
  return pixels;
}

}  // namespace

TEST_CASE("splats: the film shares all of a splat among pixels, and loses at its edges alone") {
  for (const auto& [kind, width] : {std::pair{Kind::box, 0.5f},
                                    {Kind::box, 1.3f},
                                    {Kind::tent, 1.0f},
                                    {Kind::gaussian, 0.5f}}) {
    CAPTURE(static_cast<int>(kind));
    CAPTURE(width);
    FilmSettings whole{20, 80, 0, 0, 20, 80, ReconstructionFilter(kind, width)};
    // Evenly over one pixel, at places that no filter's edge falls on.
    std::vector<Vec2> places;
    for (int i = 0; i < 40 * 40; ++i)
      places.push_back(Vec2(8, 63) + (Vec2(i % 40, i / 40) + 0.43f) / 40.0f);
    double sum = 0;
    for (const double pixel : exposed(whole, places)) sum += pixel;
    CHECK(sum == doctest::Approx(1600).epsilon(5e-3));

    // A splat is worth in a pixel what a camera's samples of this pixel are there.
    const auto one = exposed(whole, {Vec2(8.3f, 63.9f)});
    for (int y = 0; y < 80; ++y)
      for (int x = 0; x < 20; ++x)
        CHECK(one[static_cast<std::size_t>(y * 20 + x)] ==
              doctest::Approx(whole.filter.density(Vec2(8.3f, 63.9f) - Vec2(x, y) - 0.5f))
                  .epsilon(1e-4));

    // A part of the film is what the whole one has there; splats around it reach in.
    std::vector<Vec2> all;
    Sampler sampler(1, 1, 1);
    for (int i = 0; i < 20000; ++i) all.push_back(Vec2(24, 84) * sampler.next_2d() - 2.0f);
    const auto everywhere = exposed(whole, all);
    FilmSettings part = whole;
    part.crop_x = 3;
    part.crop_y = 7;
    part.crop_width = 9;
    part.crop_height = 70;
    const auto within = exposed(part, all);
    for (int y = 0; y < 70; ++y)
      for (int x = 0; x < 9; ++x)
        CHECK(within[static_cast<std::size_t>(y * 9 + x)] ==
              doctest::Approx(everywhere[static_cast<std::size_t>((y + 7) * 20 + x + 3)])
                  .epsilon(1e-3));
  }
}

TEST_CASE("splats: pictures are the same bit for bit on any number of threads") {
  renderer::Scene scene =
      build("<integrator type=\"path\"><integer name=\"max_depth\" value=\"4\"/>" +
            number("initial_radius", 0.05) +
            "</integrator>"
            "<sensor type=\"perspective\"><transform name=\"to_world\">" +
            look({0, -5, 2}, {0, 0, 0.7}, {0, 0, 1}) +
            "</transform>"
            "<film type=\"hdrfilm\"><integer name=\"width\" value=\"33\"/><integer "
            "name=\"height\" value=\"81\"/></film></sensor>" +
            square({0, 0, 0}, {0, 0, 1}, 2, bsdf("roughconductor"), {0, 1, 0}) +
            "<shape type=\"sphere\"><point name=\"center\" value=\"0, 0, 2\"/>" +
            number("radius", 0.5) + "<emitter type=\"area\"/></shape>");
  for (const char* name : {"path", "bdpt", "ptracer", "ppm", "bpm", "vcm"}) {
    scene.integrator.name = name;
    CAPTURE(scene.integrator.name);
    const auto one = render(scene, 3, Mode::optimized, 4, 1);
    double light = 0;
    for (const int threads : {2, 3}) {
      CAPTURE(threads);
      const auto other = render(scene, 3, Mode::optimized, 4, threads);
      int different = 0;
      for (std::size_t p = 0; p < 33 * 81; ++p) {
        different += one.film.total(p).stokes != other.film.total(p).stokes;
        light += other.film.total(p).stokes[0];
      }
      CHECK(different == 0);
    }
    CHECK(light > 0);
  }
}
