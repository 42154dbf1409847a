// SPDX-License-Identifier: MIT
#include "measurement.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace variants {

namespace {

/// The quantile 0.975 of Student's t (Abramowitz & Stegun 1964, 26.7.5).
double student_t(int degrees) {
  const double z = 1.959964, n = degrees, z3 = z * z * z, z5 = z3 * z * z;
  return z + (z3 + z) / (4 * n) + (5 * z5 + 16 * z3 + 3 * z) / (96 * n * n) +
         (3 * z5 * z * z + 19 * z5 + 17 * z3 - 15 * z) / (384 * n * n * n);
}

/// The mean of the rounds' logarithms, since a slow round slows both variants.
void set_ratio(const std::vector<double>& logs, Row& row) {
  const auto n = static_cast<double>(logs.size());
  double mean = 0, square = 0;
  for (const double x : logs) mean += x / n;
  for (const double x : logs) square += (x - mean) * (x - mean);
  const double error = logs.size() > 1 ? std::sqrt(square / (n - 1) / n) *
                                             student_t(static_cast<int>(logs.size()) - 1)
                                       : 0;
  row.ratio = std::exp(mean);
  row.ratio_low = std::exp(mean - error);
  row.ratio_high = std::exp(mean + error);
}

}  // namespace

std::vector<Row> measure(const renderer::Scene& scene, const std::vector<Variant>& variants,
                         double seconds, int rounds, int threads) {
  const std::atomic<bool> stop{false};
  std::vector<Row> rows(variants.size());
  std::vector<std::vector<double>> logs(variants.size());
  std::vector<std::uint64_t> paths(variants.size(), 0);
  // The first round warms caches and the processor up and is not counted.
  for (int round = -1; round < rounds; ++round) {
    std::vector<double> rates(variants.size());
    for (std::size_t k = 0; k < variants.size(); ++k) {
      const std::size_t i = round % 2 == 0 ? k : variants.size() - 1 - k;
      renderer::RenderOptions options;
      options.mode = variants[i].mode;
      options.seconds = seconds / rounds;
      options.seed = static_cast<std::uint64_t>(round + 1);
      options.threads = threads;
      const renderer::Rendering r = renderer::render(scene, options, stop, {});
      rates[i] = static_cast<double>(r.counters.samples) / r.seconds;
      if (round < 0) continue;
      rows[i].iterations += r.samples_per_pixel;
      rows[i].seconds += r.seconds;
      rows[i].bytes_per_light_vertex = r.light_vertices.bytes_per_vertex;
      paths[i] += r.counters.samples;
    }
    if (round < 0) continue;
    for (std::size_t i = 0; i < variants.size(); ++i)
      logs[i].push_back(std::log(rates[i] / rates[0]));
  }
  for (std::size_t i = 0; i < variants.size(); ++i) {
    rows[i].variant = variants[i].name;
    rows[i].algorithm = scene.integrator.name;
    rows[i].paths_per_second = static_cast<double>(paths[i]) / rows[i].seconds;
    set_ratio(logs[i], rows[i]);
  }
  return rows;
}

}  // namespace variants
