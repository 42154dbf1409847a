// SPDX-License-Identifier: MIT
// Scrambled Sobol points: how evenly they lie, that they are uniform and know nothing of each other
// beyond that, and that pictures by them state their errors truly.
#include "core/sampler.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "render_scenes.hpp"

using renderer::Sampler;
using renderer::SamplerKind;
using renderer::Vec2;

namespace {

/// Pair `number` of a sample.
Vec2 pair(Sampler sampler, std::size_t number) {
  for (std::size_t i = 0; i < number; ++i) sampler.next_2d();
  return sampler.next_2d();
}

/// Of n equal cells of [0, 1).
std::size_t cell(float u, std::size_t n) {
  return static_cast<std::size_t>(u * static_cast<float>(n));
}

/// By how many standard deviations counts are farther from all being equal than chance makes them.
double excess(const std::vector<int>& counts) {
  double total = 0, chi2 = 0;
  for (const int c : counts) total += c;
  const auto n = static_cast<double>(counts.size());
  for (const int c : counts) chi2 += (c - total / n) * (c - total / n) * n / total;
  return (chi2 - (n - 1)) / std::sqrt(2 * (n - 1));
}

/// The root mean square error of a mean of `samples` points of a smooth function of a pair.
double smooth_error(bool is_sobol, std::uint64_t samples) {
  constexpr std::uint64_t sequences = 100;
  const double truth = (std::exp(1.0) - 1) * 2 / render_test::pi;
  double square = 0;
  for (std::uint64_t s = 0; s < sequences; ++s) {
    double sum = 0;
    for (std::uint64_t i = 0; i < samples; ++i) {
      Sampler sampler = is_sobol ? Sampler::sobol(11, s, i) : Sampler(11, s, i);
      const Vec2 u = pair(sampler, 2);
      sum +=
          std::exp(static_cast<double>(u.x)) * std::sin(render_test::pi * static_cast<double>(u.y));
    }
    const double error = sum / static_cast<double>(samples) - truth;
    square += error * error / sequences;
  }
  return std::sqrt(square);
}

renderer::Rendering picture(const renderer::Scene& scene, SamplerKind kind, std::uint64_t seed,
                            std::uint64_t samples, int threads) {
  const std::atomic<bool> stop{false};
  renderer::RenderOptions options;
  options.sampler = kind;
  options.samples_per_pixel = samples;
  options.seed = seed;
  options.threads = threads;
  options.batches = 16;
  return renderer::render(scene, options, stop, {});
}

}  // namespace

TEST_CASE("sampler: 2^k points of a sequence, from a multiple of it on, lie one in a box each") {
  for (const std::size_t number : {0u, 1u, 15u, 16u, 37u})
    for (const int k : {0, 1, 2, 3, 4, 5, 6, 7, 8, 17})
      for (const std::uint64_t first : {0u, 3u, 1000u, 0xfffffu})
        for (int a = 0; a <= k; ++a) {
          if (k == 17 && (number > 0 || first > 3)) continue;
          std::vector<int> counts(std::size_t{1} << k);
          for (std::uint64_t i = 0; i < counts.size(); ++i) {
            const Vec2 u = pair(Sampler::sobol(3, 4, (first << k) + i), number);
            ++counts[cell(u.x, std::size_t{1} << a) << (k - a) |
                     cell(u.y, std::size_t{1} << (k - a))];
          }
          CAPTURE(number);
          CAPTURE(k);
          CAPTURE(a);
          REQUIRE(counts == std::vector<int>(counts.size(), 1));
        }
}

TEST_CASE("sampler: two numbers drawn one after the other are a pair, whatever is drawn between") {
  for (std::uint64_t i = 0; i < 64; ++i) {
    Sampler pairs = Sampler::sobol(3, 4, i), singles = pairs;
    const Vec2 first = pairs.next_2d(), second = pairs.next_2d(), third = pairs.next_2d();
    CHECK(singles.next_1d() == first.x);
    CHECK(singles.next_2d() == second);
    CHECK(singles.next_1d() == first.y);
    CHECK(singles.next_1d() == third.x);
    CHECK(singles.next_1d() == third.y);
  }
}

TEST_CASE("sampler: choices take nothing out of step, and are like no other number") {
  // Four tests of 256 cells; a chi-square of so many exceeds 6 deviations less than once in 10^6.
  std::vector<int> in_turn(256), samples(256), pixels(256), beside(256);
  for (std::uint64_t s = 0; s < 1 << 15; ++s) {
    Sampler sampler = Sampler::sobol(7, s, s / 3), untouched = sampler;
    const float first = sampler.next_choice(), second = sampler.next_choice();
    const float of_next = Sampler::sobol(7, s, s / 3 + 1).next_choice();
    const float of_neighbour = Sampler::sobol(7, s + 1, s / 3).next_choice();
    const Vec2 u = sampler.next_2d();
    CHECK(u == untouched.next_2d());
    ++in_turn[cell(first, 16) * 16 + cell(second, 16)];
    ++samples[cell(first, 16) * 16 + cell(of_next, 16)];
    ++pixels[cell(first, 16) * 16 + cell(of_neighbour, 16)];
    ++beside[cell(first, 16) * 16 + cell(u.x, 16)];
  }
  CHECK(excess(in_turn) < 6);
  CHECK(excess(samples) < 6);
  CHECK(excess(pixels) < 6);
  CHECK(excess(beside) < 6);

  Sampler independent(1, 2, 3), same = independent;
  CHECK(independent.next_choice() == same.next_1d());
}

TEST_CASE("sampler: every point is uniform over the square, and over pairs of coordinates") {
  // 15 tests of 256 cells; a chi-square of so many exceeds 6 deviations less than once in 10^6.
  for (const std::uint64_t index : {0u, 1u, 6u, 12345u, 0xffffffffu}) {
    std::vector<int> square(256), coordinates(256), neighbours(256);
    for (std::uint64_t s = 0; s < 1 << 15; ++s) {
      Sampler sampler = Sampler::sobol(7, s, index);
      const Vec2 u = sampler.next_2d(), v = sampler.next_2d();
      const Vec2 beside = Sampler::sobol(7, s + (1 << 15), index).next_2d();
      ++square[cell(u.x, 16) * 16 + cell(u.y, 16)];
      ++coordinates[cell(u.x, 16) * 16 + cell(v.x, 16)];
      ++neighbours[cell(u.y, 16) * 16 + cell(beside.y, 16)];
    }
    CHECK(excess(square) < 6);
    CHECK(excess(coordinates) < 6);
    CHECK(excess(neighbours) < 6);
  }
}

TEST_CASE("sampler: what pairs have in common averages out as fast as independent numbers do") {
  // The sign of two pairs' halves. Points are shuffled two by two, which makes half as many signs.
  constexpr std::uint64_t samples = 64, sequences = 4000;
  double square = 0;
  for (std::uint64_t s = 0; s < sequences; ++s) {
    double sum = 0;
    for (std::uint64_t i = 0; i < samples; ++i) {
      Sampler sampler = Sampler::sobol(9, s, i);
      const Vec2 u = sampler.next_2d(), v = sampler.next_2d();
      sum += (u.x < 0.5f) == (v.x < 0.5f) ? 1 : -1;
    }
    square += sum * sum / (samples * sequences);
  }
  CHECK(square < 2.3);
}

TEST_CASE("sampler: means of smooth functions converge by the power -3/2, independent by -1/2") {
  const auto power = [](bool is_sobol) {
    return std::log(smooth_error(is_sobol, 1024) / smooth_error(is_sobol, 64)) / std::log(16.0);
  };
  CHECK(power(true) < -1.35);
  CHECK(power(false) > -0.6);
}

TEST_CASE("sampler: the same seed gives the same bits on one, two and three threads") {
  auto scene = render_test::example("glossy.xml", {{"resolution", "17"}});
  const auto data = [](const renderer::Rendering& r) {
    return r.film.image(renderer::StokesFrame::horizontal).data;
  };
  for (const std::string name : {"path", "ptracer", "bdpt", "vcm"}) {
    CAPTURE(name);
    renderer::set_integrator(scene.integrator, name);
    const auto one = data(picture(scene, SamplerKind::sobol, 5, 7, 1));
    for (const int threads : {2, 3}) {
      const auto more = data(picture(scene, SamplerKind::sobol, 5, 7, threads));
      CHECK(std::memcmp(one.data(), more.data(), one.size() * sizeof(float)) == 0);
    }
    CHECK(one != data(picture(scene, SamplerKind::sobol, 6, 7, 2)));
  }
}

TEST_CASE("sampler: a picture's standard errors are those of many seeds") {
  auto scene = render_test::example("diffuse.xml", {{"resolution", "4"}});
  constexpr std::uint64_t seeds = 60;
  for (const std::string name : {"path", "bdpt"}) {
    renderer::set_integrator(scene.integrator, name);
    std::vector<double> sum(16), square(16), stated(16);
    for (std::uint64_t s = 0; s < seeds; ++s) {
      const auto r = picture(scene, SamplerKind::sobol, s, 128, 2);
      for (std::size_t p = 0; p < 16; ++p) {
        const double x = r.film.total(p).mean(1), e = r.film.standard_error(p)[1];
        sum[p] += x;
        square[p] += x * x;
        stated[p] += e * e / seeds;
      }
    }
    double ratio = 0;
    for (std::size_t p = 0; p < 16; ++p)
      ratio += (square[p] - sum[p] * sum[p] / seeds) / (seeds - 1) / stated[p] / 16;
    CAPTURE(name);
    CAPTURE(ratio);
    // 16 variances of 60 seeds each: their mean's standard deviation is 0.05.
    CHECK(ratio > 0.8);
    CHECK(ratio < 1.2);
  }
}
