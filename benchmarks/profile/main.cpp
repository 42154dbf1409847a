// SPDX-License-Identifier: MIT
// The limits of a renderer on this machine, beside what it takes: Embree's rays alone, one at a
// time and many, and memory for the photon map. Where a path's time goes is told by profile.py.
//
//   benchmark_profile --json limits.json
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cstdio>
#include <nlohmann/json.hpp>

#include "../program.hpp"
#include "../scenes.hpp"
#include "io/atomic_file.hpp"
#include "packets.hpp"
#include "photons.hpp"
#include "rays.hpp"

namespace {

using Json = nlohmann::ordered_json;

struct Arguments {
  std::vector<std::string> scenes{"vcm_box", "diffuse", "glossy", "glass", "bathroom"};
  std::vector<std::string> algorithms{"path", "bdpt", "vcm"};
  std::string folder = MALUS_SCENES_DIR, json;
  double seconds = 2;
  int resolution = 128, photon_resolution = 512;
};

constexpr renderer::Mode modes[] = {renderer::Mode::unpolarized, renderer::Mode::optimized};

Json measure_rays(const Arguments& a) {
  std::printf(
      "## Rays\n\n| scene | algorithm | mode | ns a path | rays a path | shadow rays a path | ns a "
      "ray alone | ns a shadow ray alone | rays alone, of the time (95 %%) | ns of the rest |\n"
      "|---|---|---|--:|--:|--:|--:|--:|---|--:|\n");
  Json list = Json::array();
  for (const auto& name : a.scenes)
    for (const auto& algorithm : a.algorithms) {
      const renderer::Scene scene = benchmarks::load_scene(a.folder, name, algorithm, a.resolution);
      for (const auto mode : modes) {
        const auto t = profile::time_rays(scene, mode, a.seconds);
        std::printf(
            "| %s | %s | %s | %.0f | %.2f | %.2f | %.1f | %.1f | %.3f (%.3f to %.3f) | %.0f |\n",
            name.c_str(), algorithm.c_str(), t.mode.c_str(), t.path, t.nearest_per_path,
            t.shadow_per_path, t.nearest, t.shadow, t.share.value, t.share.low, t.share.high,
            t.path * (1 - t.share.value));
        std::fflush(stdout);
        list.push_back({{"scene", name},
                        {"algorithm", algorithm},
                        {"mode", t.mode},
                        {"nanoseconds_per_path", t.path},
                        {"rays_per_path", t.nearest_per_path},
                        {"shadow_rays_per_path", t.shadow_per_path},
                        {"nanoseconds_per_ray_alone", t.nearest},
                        {"nanoseconds_per_shadow_ray_alone", t.shadow},
                        {"share", t.share.value},
                        {"share_low", t.share.low},
                        {"share_high", t.share.high}});
      }
    }
  return list;
}

Json measure_packets(const Arguments& a) {
  std::printf(
      "\n## Many rays at a time\n\n| scene | rays | ns a ray: path by path | a wavefront, one at a "
      "time | by 8 | by 16 | sorting it | sorted, one at a time | by 8 | by 16 |\n"
      "|---|---|--:|--:|--:|--:|--:|--:|--:|--:|\n");
  Json list = Json::array();
  for (const auto& name : a.scenes) {
    const renderer::Scene scene = benchmarks::load_scene(a.folder, name, "path", a.resolution);
    const auto [nearest, shadow] = profile::time_packets(scene, a.seconds);
    for (const auto& t : {nearest, shadow}) {
      std::printf("| %s | %s | %.1f | %.1f | %.1f | %.1f | %.1f | %.1f | %.1f | %.1f |\n",
                  name.c_str(), t.rays.c_str(), t.path, t.wavefront, t.packets_of_8,
                  t.packets_of_16, t.sorting, t.sorted, t.sorted_packets_of_8,
                  t.sorted_packets_of_16);
      std::fflush(stdout);
      list.push_back({{"scene", name},
                      {"rays", t.rays},
                      {"count", t.count},
                      {"path", t.path},
                      {"wavefront", t.wavefront},
                      {"packets_of_8", t.packets_of_8},
                      {"packets_of_16", t.packets_of_16},
                      {"sorting", t.sorting},
                      {"sorted", t.sorted},
                      {"sorted_packets_of_8", t.sorted_packets_of_8},
                      {"sorted_packets_of_16", t.sorted_packets_of_16}});
    }
  }
  return list;
}

Json measure_photons(const Arguments& a) {
  std::printf(
      "\n## The photon map\n\n| scene | mode | photons | bytes a photon | MB | ns to build, a "
      "photon "
      "| ns a query | photons found | their GB/s | GB/s, in order | ns of a line at random |\n"
      "|---|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n");
  Json list = Json::array();
  for (const auto& name : a.scenes) {
    const renderer::Scene scene =
        benchmarks::load_scene(a.folder, name, "vcm", a.photon_resolution);
    if (scene.has_media()) continue;
    for (const bool polarized : {false, true}) {
      const auto t = profile::time_photons(scene, polarized, a.seconds / 4);
      std::printf("| %s | %s | %zu | %zu | %.1f | %.1f | %.1f | %.2f | %.2f | %.1f | %.1f |\n",
                  name.c_str(), t.mode.c_str(), t.photons, t.bytes_per_photon,
                  static_cast<double>(t.bytes) * 1e-6, t.build, t.query, t.found_per_query,
                  t.found_bandwidth, t.stream_bandwidth, t.random_line);
      std::fflush(stdout);
      list.push_back({{"scene", name},
                      {"mode", t.mode},
                      {"photons", t.photons},
                      {"bytes_per_photon", t.bytes_per_photon},
                      {"bytes", t.bytes},
                      {"nanoseconds_to_build_a_photon", t.build},
                      {"nanoseconds_per_query", t.query},
                      {"found_per_query", t.found_per_query},
                      {"found_gigabytes_per_second", t.found_bandwidth},
                      {"stream_gigabytes_per_second", t.stream_bandwidth},
                      {"nanoseconds_per_random_line", t.random_line}});
    }
  }
  return list;
}

int run(const Arguments& a) {
  benchmarks::reject_nan("--seconds", a.seconds);
  if (!a.json.empty()) renderer::check_writable(a.json);
  const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism, 1);
  tbb::task_arena arena(1);
  return arena.execute([&] {
    Json json;
    json["rays"] = measure_rays(a);
    json["packets"] = measure_packets(a);
    json["photon_map"] = measure_photons(a);
    if (!a.json.empty()) renderer::write_file(a.json, json.dump(2) + "\n");
    return 0;
  });
}

}  // namespace

int main(int argc, char** argv) {
  Arguments a;
  CLI::App app("What a path takes beside Embree's rays alone and memory's limits",
               "benchmark_profile");
  benchmarks::add_scene_options(app, a.scenes, a.folder);
  app.add_option("--algorithm", a.algorithms, "Integrators")->capture_default_str();
  app.add_option("--seconds", a.seconds, "For each row")
      ->check(CLI::Range(0.001, 1e6))
      ->capture_default_str();
  app.add_option("--resolution", a.resolution, "Of pictures whose rays are traced again")
      ->check(CLI::Range(2, 1024))
      ->capture_default_str();
  app.add_option("--photon-resolution", a.photon_resolution, "Of pictures whose photons are found")
      ->check(CLI::Range(2, 4096))
      ->capture_default_str();
  app.add_option("--json", a.json, "File of the same rows");
  return benchmarks::run_program(app, argc, argv, [&] { return run(a); });
}
