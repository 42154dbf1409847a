// SPDX-License-Identifier: MIT
// The paper's Table 1 by this renderer, and every other combination of scene and algorithm: paths a
// second of each variant, and what following polarisation costs, as ratios to the unpolarized one.
#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <nlohmann/json.hpp>

#include "../program.hpp"
#include "../scenes.hpp"
#include "io/atomic_file.hpp"
#include "io/input_error.hpp"
#include "measurement.hpp"
#include "paper.hpp"
#include "scene/needs.hpp"
#include "variant.hpp"
#include "verification.hpp"

namespace {

using variants::Row;
using variants::Variant;

struct Arguments {
  std::vector<std::string> scenes{"diffuse",  "glossy",          "glass",   "glass_medium",
                                  "bathroom", "bathroom_medium", "vcm_box", "upbp_sphere"};
  std::vector<std::string> algorithms{"path", "bdpt", "vcm"};
  std::vector<std::string> variants{"unpolarized", "naive", "optimized", "auto"};
  std::string folder = MALUS_SCENES_DIR, json;
  double seconds = 8, turn = 0.25;
  int threads = 1, resolution = 256;
  bool paper_alone = false, verify = false;
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

renderer::Scene load(const Arguments& a, const std::string& name, const std::string& algorithm) {
  return benchmarks::load_scene(a.folder, name, algorithm, a.resolution);
}

void print_head(const char* title) {
  std::printf(
      "\n%s\n\n| scene | algorithm | variant | iterations in 30 min | 10³ paths/s | ratio to "
      "unpolarized (95 %%) | the paper's | bytes a light vertex | |\n"
      "|---|---|---|--:|--:|---|--:|--:|---|\n",
      title);
}

void print(const Row& row) {
  const variants::PaperRow* paper = variants::find_in_table_1(row.scene, row.algorithm);
  std::printf("| %s | %s%s%s | %s | %.0f | %.0f | %.3f (%.3f to %.3f) |", row.scene.c_str(),
              row.algorithm.c_str(), paper ? ", " : "", paper ? paper->label : "",
              row.variant.c_str(), static_cast<double>(row.iterations) / row.seconds * 1800,
              row.paths_per_second / 1000, row.ratio.value, row.ratio.low, row.ratio.high);
  const double ratio = variants::paper_ratio(paper, row.variant);
  if (ratio > 0)
    std::printf(" %.2f |", ratio);
  else
    std::printf(" |");
  if (row.bytes_per_light_vertex > 0)
    std::printf(" %zu |", row.bytes_per_light_vertex);
  else
    std::printf(" |");
  for (const Anchor& anchor : anchors)
    if (row.variant == "unpolarized" && row.scene == anchor.scene &&
        row.algorithm == anchor.algorithm)
      std::printf(" %.2f × %s's %.0f", row.paths_per_second / 1000 / anchor.speed, anchor.renderer,
                  anchor.speed);
  std::printf(" |\n");
  std::fflush(stdout);
}

nlohmann::ordered_json to_json(const Row& row) {
  nlohmann::ordered_json json{{"scene", row.scene},
                              {"algorithm", row.algorithm},
                              {"variant", row.variant},
                              {"iterations", row.iterations},
                              {"seconds", row.seconds},
                              {"ratio", row.ratio.value},
                              {"ratio_low", row.ratio.low},
                              {"ratio_high", row.ratio.high},
                              {"paths_per_second", row.paths_per_second},
                              {"bytes_per_light_vertex", row.bytes_per_light_vertex}};
  const double paper =
      variants::paper_ratio(variants::find_in_table_1(row.scene, row.algorithm), row.variant);
  json["paper_ratio"] = paper > 0 ? nlohmann::ordered_json(paper) : nlohmann::ordered_json();
  return json;
}

/// What is asked for, after what it is compared with.
std::vector<Variant> variants_of(const Arguments& a) {
  std::vector<Variant> list;
  for (const Variant v : variants::all_variants)
    if (v == Variant::unpolarized || std::ranges::count(a.variants, variants::name_of(v)) > 0)
      list.push_back(v);
  return list;
}

/// The combinations that are asked for: those of the paper's table, or the others.
std::vector<std::pair<std::string, std::string>> combinations(const Arguments& a, bool of_paper) {
  std::vector<std::pair<std::string, std::string>> list;
  for (const auto& scene : a.scenes)
    for (const auto& algorithm : a.algorithms)
      if ((variants::find_in_table_1(scene, algorithm) != nullptr) == of_paper)
        list.emplace_back(scene, algorithm);
  return list;
}

/// How much of the processor others had.
void print_load(std::chrono::steady_clock::time_point start, std::clock_t start_of_work) {
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const double work = static_cast<double>(std::clock() - start_of_work) / CLOCKS_PER_SEC;
  std::printf(
      "\nRatios are of processor time, with one thread. Of the %.0f s that all this took, %.0f %% "
      "were this program's.\n",
      seconds, 100 * work / seconds);
}

std::vector<Row> measure_one(const Arguments& a, const renderer::Scene& scene) {
  std::vector<variants::Contender> contenders;
  for (const Variant v : variants_of(a))
    contenders.push_back({variants::name_of(v), [&scene, v](renderer::Film& film) {
                            return variants::make_passes(v, scene, {.seed = 1}, film);
                          }});
  return variants::measure(scene, contenders, a.seconds, a.turn, a.threads == 1);
}

int measure(const Arguments& a) {
  if (!a.json.empty()) renderer::check_writable(a.json);
  const auto start = std::chrono::steady_clock::now();
  const std::clock_t start_of_work = std::clock();
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const bool of_paper : {true, false}) {
    const auto list = combinations(a, of_paper);
    if (list.empty() || (a.paper_alone && !of_paper)) continue;
    print_head(of_paper ? "## Table 1 of the paper" : "## The other combinations");
    for (const auto& [scene, algorithm] : list)
      for (Row& row : measure_one(a, load(a, scene, algorithm))) {
        row.scene = scene;
        print(row);
        json.push_back(to_json(row));
      }
  }
  if (a.threads == 1) print_load(start, start_of_work);
  if (!a.json.empty()) renderer::write_file(a.json, json.dump(2) + "\n");
  return 0;
}

/// 1 if a picture differs from one that it should equal.
int verify(const Arguments& a) {
  std::printf(
      "| scene | algorithm | variants | values that differ by more than %.0e | median | largest | "
      "|\n|---|---|---|--:|--:|--:|---|\n",
      variants::bound);
  bool is_right = true;
  for (const auto& name : a.scenes)
    for (const auto& algorithm : a.algorithms) {
      const renderer::Scene scene = load(a, name, algorithm);
      const auto check = [&](Variant one, Variant other, bool in_every_bit) {
        const auto d = variants::compare(scene, one, other);
        const bool holds = in_every_bit ? d.is_equal : d.share <= variants::allowed_share(scene);
        is_right = is_right && holds;
        std::printf("| %s | %s | %s, %s | %.5f %% | %.1e | %.1e | %s |\n", name.c_str(),
                    algorithm.c_str(), variants::name_of(one), variants::name_of(other),
                    d.share * 100, d.median, d.largest,
                    !holds         ? "**differ**"
                    : in_every_bit ? "same bits"
                                   : "agree");
        std::fflush(stdout);
      };
      check(Variant::optimized, Variant::naive, false);
      if (!renderer::find_needs(scene).polarization())
        check(Variant::unpolarized, Variant::automatic, true);
    }
  return is_right ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Paths a second by scene, algorithm and variant", "benchmark_variants");
  Arguments a;
  benchmarks::add_scene_options(app, a.scenes, a.folder);
  app.add_option("--algorithm", a.algorithms, "Integrators")->capture_default_str();
  app.add_option("--variant", a.variants, "What is compared with unpolarized")
      ->check(CLI::IsMember({"unpolarized", "naive", "optimized", "auto"}))
      ->capture_default_str();
  app.add_flag("--paper", a.paper_alone, "The rows of the paper's Table 1 alone");
  app.add_option("--seconds", a.seconds, "For each row")
      ->check(CLI::Range(0.01, 1e6))
      ->capture_default_str();
  app.add_option("--turn", a.turn, "Seconds after which the next variant takes its turn")
      ->check(CLI::Range(0.001, 1e6))
      ->capture_default_str();
  app.add_option("--threads", a.threads)->check(CLI::Range(1, 4096))->capture_default_str();
  app.add_option("--resolution", a.resolution, "Of square pictures; 0: the scenes' own")
      ->check(CLI::Range(0, 4096))
      ->capture_default_str();
  app.add_option("--json", a.json, "File of the same rows");
  app.add_flag("--verify", a.verify,
               "Measure nothing: check that naive and optimized make the same pictures, and auto "
               "and unpolarized the same bits where nothing polarises");
  return benchmarks::run_program(app, argc, argv, [&] {
    benchmarks::reject_nan("--seconds", a.seconds);
    benchmarks::reject_nan("--turn", a.turn);
    const auto threads = static_cast<std::size_t>(a.threads);
    const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism, threads);
    tbb::task_arena arena(a.threads);
    return arena.execute([&] { return a.verify ? verify(a) : measure(a); });
  });
}
