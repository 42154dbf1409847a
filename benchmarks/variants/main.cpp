// SPDX-License-Identifier: MIT
// Paths a second of every scene, algorithm and variant, and what following polarisation costs: the
// ratio to the unpolarized variant, both in one process and in turns.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "io/atomic_file.hpp"
#include "io/input_error.hpp"
#include "measurement.hpp"
#include "scene/build.hpp"
#include "scene/requirements.hpp"
#include "scene/xml_reader.hpp"

namespace {

using variants::Row;

struct Arguments {
  std::vector<std::string> scenes{"vcm_box", "diffuse",     "glossy",
                                  "glass",   "upbp_sphere", "glass_medium"};
  std::vector<std::string> algorithms{"path", "bdpt", "vcm"};
  std::string folder = MALUS_SCENES_DIR, json;
  double seconds = 8;
  int rounds = 8, threads = 1, resolution = 512;
};

/// Another renderer's own speed on its scene, one thread, paths of up to 10 edges, in thousand
/// paths a second, on a machine of our kind.
struct Anchor {
  const char *renderer, *scene, *algorithm;
  double speed;
};
constexpr Anchor anchors[] = {
    // SmallVCM's box with the large mirror sphere and the glossy floor, 512 x 512.
    {"SmallVCM", "vcm_box", "path", 760},
    {"SmallVCM", "vcm_box", "bdpt", 265},
    {"SmallVCM", "vcm_box", "vcm", 150},
    // SmallUPBP's box with the large sphere of fog, 256 x 256.
    {"SmallUPBP", "upbp_sphere", "path", 680},
    {"SmallUPBP", "upbp_sphere", "bdpt", 215},
};

std::vector<Row> measure(const Arguments& a, const std::string& name,
                         const std::string& algorithm) {
  const auto file = std::filesystem::path(a.folder) / (name + ".xml");
  const std::string resolution = std::to_string(a.resolution);
  renderer::Scene scene =
      renderer::build_scene(*renderer::read_scene(file, {{"resolution", resolution}}));
  renderer::set_integrator(scene.integrator, algorithm);
  renderer::check_requirements(scene, file.string());
  const std::vector<variants::Variant> list{{"unpolarized", renderer::Mode::unpolarized},
                                            {"optimized", renderer::Mode::optimized}};
  auto rows = variants::measure(scene, list, a.seconds, a.rounds, a.threads);
  for (Row& row : rows) row.scene = name;
  return rows;
}

void print(const Row& row) {
  std::printf("| %s | %s | %s | %.0f | %.3f (%.3f to %.3f) | %zu |", row.scene.c_str(),
              row.algorithm.c_str(), row.variant.c_str(), row.paths_per_second / 1000, row.ratio,
              row.ratio_low, row.ratio_high, row.bytes_per_light_vertex);
  for (const Anchor& anchor : anchors)
    if (row.variant == "unpolarized" && row.scene == anchor.scene &&
        row.algorithm == anchor.algorithm)
      std::printf(" %.2f × %s's %.0f", row.paths_per_second / 1000 / anchor.speed, anchor.renderer,
                  anchor.speed);
  std::printf(" |\n");
}

nlohmann::ordered_json to_json(const Row& row) {
  return {{"scene", row.scene},
          {"algorithm", row.algorithm},
          {"variant", row.variant},
          {"iterations", row.iterations},
          {"seconds", row.seconds},
          {"ratio", row.ratio},
          {"ratio_low", row.ratio_low},
          {"ratio_high", row.ratio_high},
          {"paths_per_second", row.paths_per_second},
          {"bytes_per_light_vertex", row.bytes_per_light_vertex}};
}

int run(const Arguments& a) {
  std::printf(
      "| scene | algorithm | variant | 10³ paths/s | ratio to unpolarized (95 %%) | bytes a light "
      "vertex | |\n|---|---|---|---:|---|---:|---|\n");
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const auto& scene : a.scenes)
    for (const auto& algorithm : a.algorithms)
      for (const Row& row : measure(a, scene, algorithm)) {
        print(row);
        json.push_back(to_json(row));
      }
  if (!a.json.empty()) renderer::write_file(a.json, json.dump(2) + "\n");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Paths a second by scene, algorithm and variant");
  Arguments a;
  app.add_option("--scene", a.scenes, "Names of scenes")->capture_default_str();
  app.add_option("--scenes", a.folder, "Folder of the scenes")->check(CLI::ExistingDirectory);
  app.add_option("--algorithm", a.algorithms, "Integrators")->capture_default_str();
  app.add_option("--seconds", a.seconds, "For each row")
      ->check(CLI::Range(0.01, 1e6))
      ->capture_default_str();
  app.add_option("--rounds", a.rounds, "That the variants take turns in")
      ->check(CLI::Range(2, 1000))
      ->capture_default_str();
  app.add_option("--threads", a.threads)->check(CLI::Range(1, 4096))->capture_default_str();
  app.add_option("--resolution", a.resolution, "Of square pictures")
      ->check(CLI::Range(1, 4096))
      ->capture_default_str();
  app.add_option("--json", a.json, "File of the same rows");
  try {
    app.parse(argc, argv);
    return run(a);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  } catch (const renderer::InputError& e) {
    std::cerr << "benchmark_variants: " << e.what() << '\n';
    return 2;
  } catch (const std::exception& e) {
    std::cerr << "benchmark_variants: " << e.what() << '\n';
    return 1;
  }
}
