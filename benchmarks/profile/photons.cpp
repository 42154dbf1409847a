// SPDX-License-Identifier: MIT
#include "photons.hpp"

#include <algorithm>
#include <ctime>
#include <numeric>
#include <vector>

#include "integrators/photon_map.hpp"
#include "render/tiles.hpp"

namespace profile {

namespace {

using renderer::NoMedia;

double processor_seconds() {
  return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

/// Seconds that a call takes: the least of several in so much time, which other programs' turns
/// don't reach.
template <class Work>
double least_seconds(double seconds, Work&& work) {
  double least = 1e30;
  const double start = processor_seconds();
  do {
    const double begin = processor_seconds();
    work();
    least = std::min(least, processor_seconds() - begin);
  } while (processor_seconds() - start < seconds);
  return least;
}

/// What keeps the compiler from leaving reads out.
volatile std::uint64_t sink = 0;

std::vector<renderer::Vec3> first_vertices(const renderer::Scene& scene) {
  std::vector<renderer::Vec3> points;
  const auto& film = scene.film;
  for (int y = 0; y < film.crop_height; ++y)
    for (int x = 0; x < film.crop_width; ++x) {
      renderer::Sampler random(1, static_cast<std::uint64_t>(y * film.crop_width + x), 0);
      renderer::Hit hit;
      if (scene.intersect(camera_ray(film, *scene.sensor, x, y, random.next_2d()), hit))
        points.push_back(hit.position);
    }
  return points;
}

/// Reads so many bytes in order: GB/s.
double stream_bandwidth(std::size_t bytes, double seconds) {
  const std::vector<std::uint64_t> memory(std::max<std::size_t>(bytes / 8, 1), 1);
  const double taken = least_seconds(seconds, [&] {
    sink = sink + std::accumulate(memory.begin(), memory.end(), std::uint64_t{0});
  });
  return static_cast<double>(8 * memory.size()) / std::max(taken, 1e-9) * 1e-9;
}

/// Reads cache lines in an order that is no order, none waiting for another: ns of one.
double random_line(std::size_t bytes, double seconds) {
  constexpr std::size_t line = 8, reads = 1 << 18;
  const std::size_t lines = std::bit_floor(std::max<std::size_t>(bytes / 64, 2));
  const std::vector<std::uint64_t> memory(lines * line, 1);
  std::uint64_t seed = 0;
  const double taken = least_seconds(seconds, [&] {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < reads; ++i)
      sum += memory[(renderer::mix_bits(seed + i) & (lines - 1)) * line];
    seed += reads;
    sink = sink + sum;
  });
  return taken * 1e9 / reads;
}

template <class R>
PhotonTimes time_photons_of(const renderer::Scene& scene, double seconds) {
  renderer::Counters counters;
  renderer::LightSubpath<R, NoMedia> subpath(scene, counters);
  std::vector<renderer::LightPaths<R, NoMedia>> paths(1);
  const int pixels = scene.film.crop_width * scene.film.crop_height;
  for (int i = 0; i < pixels; ++i) {
    renderer::Sampler random(~1ull, static_cast<std::uint64_t>(i), 0);
    subpath.trace(random, {}, paths[0].vertices, [](const auto&) {});
    paths[0].ends.push_back(paths[0].vertices.size());
  }
  const float radius = scene.integrator.initial_radius * scene.geometry.radius();
  renderer::PhotonMap<R> map;
  const auto build = [&] {
    map.build(std::span<const renderer::LightPaths<R, NoMedia>>(paths), false,
              scene.geometry.center(), radius);
  };
  const auto points = first_vertices(scene);

  PhotonTimes t;
  t.mode = R::polarized ? "optimized" : "unpolarized";
  t.photons = paths[0].vertices.size();
  t.bytes_per_photon = renderer::PhotonMap<R>::bytes_per_photon(false);
  if (t.photons == 0 || points.empty()) return t;
  t.build = least_seconds(seconds, build) * 1e9 / static_cast<double>(t.photons);
  t.bytes = map.bytes();
  std::uint64_t found = 0;
  const double taken = least_seconds(seconds, [&] {
    found = 0;
    // The sum reads what merging reads last of a photon.
    for (const auto& p : points)
      map.each_near(p, [&](const auto& photon, std::size_t) { found += photon.edges > 0 ? 1 : 2; });
    sink = sink + found;
  });
  const auto queries = static_cast<double>(points.size());
  t.query = taken * 1e9 / queries;
  t.found_per_query = static_cast<double>(found) / queries;
  t.found_bandwidth = static_cast<double>(found * t.bytes_per_photon) / taken * 1e-9;
  t.stream_bandwidth = stream_bandwidth(t.bytes, seconds);
  t.random_line = random_line(t.bytes, seconds);
  return t;
}

}  // namespace

PhotonTimes time_photons(const renderer::Scene& scene, bool polarized, double seconds) {
  return polarized ? time_photons_of<malus::Polarized<renderer::Rgb>>(scene, seconds)
                   : time_photons_of<malus::Unpolarized<renderer::Rgb>>(scene, seconds);
}

}  // namespace profile
