// SPDX-License-Identifier: MIT
// What leaving connections to chance saves in shadow rays and costs in noise, by threshold. Noise
// is the variance of a pixel from seed to seed; thresholds have the same seeds, and so nearly the
// same noise, so that ratios are known far better than the variances.
#include <algorithm>
#include <atomic>
#include <cstdio>
#include <string>
#include <vector>

#include "../program.hpp"
#include "../scenes.hpp"
#include "render/render.hpp"

namespace {

struct Arguments {
  std::vector<std::string> scenes{"diffuse",      "glossy",   "glass",
                                  "glass_medium", "bathroom", "bathroom_medium"};
  std::string folder = MALUS_SCENES_DIR, algorithm = "bdpt";
  std::vector<double> thresholds{0, 0.125, 0.5};
  std::uint64_t samples = 64, seeds = 8;
  int threads = 2, resolution = 48;
  double left_out = 0.02;
};

/// Of all seeds' pictures.
struct Sums {
  std::vector<double> sum, square;  // by pixel and component, S0.R … S3.B
  double shadow_rays = 0, left_to_chance = 0, paths = 0;
};

Sums render(const Arguments& a, const renderer::Scene& scene) {
  Sums s;
  for (std::uint64_t seed = 1; seed <= a.seeds; ++seed) {
    renderer::RenderOptions options;
    options.samples_per_pixel = a.samples;
    options.threads = a.threads;
    options.seed = seed;
    const std::atomic<bool> stop{false};
    const auto rendering = renderer::render(scene, options, stop, {});
    const auto pixels = static_cast<std::size_t>(rendering.film.width()) *
                        static_cast<std::size_t>(rendering.film.height());
    s.sum.resize(12 * pixels);
    s.square.resize(12 * pixels);
    for (std::size_t k = 0; k < s.sum.size(); ++k) {
      const double value = rendering.film.total(k / 12).mean(k % 12);
      s.sum[k] += value;
      s.square[k] += value * value;
    }
    s.shadow_rays += static_cast<double>(rendering.counters.shadow_rays);
    s.left_to_chance += static_cast<double>(rendering.counters.left_to_chance);
    s.paths += static_cast<double>(rendering.counters.samples);
  }
  return s;
}

/// Of one Stokes component: the mean over pixels and channels of the variance, relative to the
/// square of the pixel's brightness (and a hundredth of the mean's), but for the noisiest.
double noise_of(const Arguments& a, const Sums& s, std::size_t component) {
  const auto n = static_cast<double>(a.seeds);
  const std::size_t pixels = s.sum.size() / 12;
  const auto brightness = [&](std::size_t p) {
    return (s.sum[12 * p] + s.sum[12 * p + 1] + s.sum[12 * p + 2]) / (3 * n);
  };
  double mean = 0;
  for (std::size_t p = 0; p < pixels; ++p) mean += brightness(p) / static_cast<double>(pixels);
  std::vector<double> variances;
  for (std::size_t p = 0; p < pixels; ++p) {
    double variance = 0;
    for (std::size_t k = 12 * p + 3 * component; k < 12 * p + 3 * component + 3; ++k)
      variance += (s.square[k] - s.sum[k] * s.sum[k] / n) / (3 * (n - 1));
    variances.push_back(variance / (brightness(p) * brightness(p) + 0.01 * mean * mean));
  }
  std::ranges::sort(variances);
  variances.resize(static_cast<std::size_t>((1 - a.left_out) * static_cast<double>(pixels)));
  double sum = 0;
  for (const double v : variances) sum += v / static_cast<double>(variances.size());
  return sum;
}

void measure(const Arguments& a, const std::string& name) {
  renderer::Scene scene = benchmarks::load_scene(a.folder, name, a.algorithm, a.resolution);
  std::vector<double> first;
  for (const double threshold : a.thresholds) {
    scene.integrator.connection_threshold = static_cast<float>(threshold);
    const Sums s = render(a, scene);
    std::printf("| %s | %s | %g | %.2f | %.2f |", name.c_str(), a.algorithm.c_str(), threshold,
                s.shadow_rays / s.paths, s.left_to_chance / s.paths);
    for (std::size_t i = 0; i < 4; ++i) {
      const double noise = noise_of(a, s, i);
      if (first.size() <= i) first.push_back(noise);
      if (first[i] > 0)
        std::printf(" %.3f |", noise / first[i]);
      else
        std::printf(" — |");
    }
    std::printf("\n");
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  Arguments a;
  CLI::App app("Shadow rays and noise of bidirectional path tracing, by connection_threshold",
               "benchmark_connections");
  benchmarks::add_scene_options(app, a.scenes, a.folder);
  app.add_option("--algorithm", a.algorithm, "bdpt or vcm")
      ->check(CLI::IsMember({"bdpt", "vcm"}))
      ->capture_default_str();
  app.add_option("--threshold", a.thresholds, "Noise is relative to the first one's")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  app.add_option("--samples", a.samples, "Of a pixel, in each picture")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--seeds", a.seeds, "Pictures of each threshold")
      ->check(CLI::Range(2, 1 << 16))
      ->capture_default_str();
  app.add_option("--resolution", a.resolution, "Of square pictures")
      ->check(CLI::Range(8, 4096))
      ->capture_default_str();
  app.add_option("--left-out", a.left_out, "The part of pixels, the noisiest, that don't count")
      ->check(CLI::Range(0.0, 0.9))
      ->capture_default_str();
  app.add_option("--threads", a.threads)->check(CLI::Range(1, 4096))->capture_default_str();
  return benchmarks::run_program(app, argc, argv, [&] {
    benchmarks::reject_nan("--left-out", a.left_out);
    for (const double threshold : a.thresholds) benchmarks::reject_nan("--threshold", threshold);
    std::printf(
        "| scene | algorithm | threshold | shadow rays a path | left to chance | variance of S0 | "
        "S1 | S2 | S3 |\n|---|---|--:|--:|--:|--:|--:|--:|--:|\n");
    for (const std::string& scene : a.scenes) measure(a, scene);
    return 0;
  });
}
