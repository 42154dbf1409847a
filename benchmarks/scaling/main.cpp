// SPDX-License-Identifier: MIT
// How the time of a sample grows with threads, with the length of paths, with photons and with
// resolution, unpolarized and optimized.
//
//   benchmark_scaling --json scaling.json
//   benchmarks/scaling/plot.py scaling.json -o scaling.png
//
// The two modes take turns in one process (benchmarks/variants/measurement.hpp), and so do numbers
// of threads, of each mode. Photons of a pass are as many as the picture has pixels, 4096 at least:
// where they are what is varied, so is the picture. Times of several threads are the clock's, the
// others the processor's.
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>

#include "../program.hpp"
#include "../scenes.hpp"
#include "../variants/measurement.hpp"
#include "io/atomic_file.hpp"

namespace {

using variants::Contender;
using variants::Row;

struct Arguments {
  std::vector<std::string> scenes{"vcm_box", "glossy", "upbp_sphere"};
  std::vector<std::string> dimensions{"threads", "depth", "photons", "resolution"};
  std::string folder = MALUS_SCENES_DIR, json;
  double seconds = 1, turn = 0.05;
  int threads = 0, largest = 1024;
};

/// One setting of one dimension.
struct Setting {
  std::string scene, algorithm, dimension;
  int value = 0;
  int resolution = 128, max_depth = 0, threads = 1;  // 0: the scene's own
};

/// Both modes at a setting.
struct Result {
  Setting setting;
  std::string mode;
  Row row;
  /// Of paths a second: to unpolarized, but of threads to one thread of the same mode.
  const char* relative_to;
};

renderer::Scene load(const Arguments& a, const Setting& s) {
  renderer::Scene scene = benchmarks::load_scene(a.folder, s.scene, s.algorithm, s.resolution);
  if (s.max_depth > 0) scene.integrator.max_depth = s.max_depth;
  return scene;
}

/// Passes that run on so many threads, whoever calls them.
class InArena final : public renderer::Passes {
 public:
  InArena(int threads, std::unique_ptr<renderer::Passes> passes)
      : arena_(threads), passes_(std::move(passes)) {}
  bool run(std::uint64_t first, std::uint64_t last, const std::function<bool()>& stopped) override {
    return arena_.execute([&] { return passes_->run(first, last, stopped); });
  }
  void salvage() override { passes_->salvage(); }
  std::vector<std::uint8_t> finished() const override { return passes_->finished(); }
  bool resume(std::vector<std::uint8_t> finished) override {
    return passes_->resume(std::move(finished));
  }
  std::uint64_t next(std::uint64_t done, std::uint64_t step) const override {
    return passes_->next(done, step);
  }
  bool needs_whole_iterations() const override { return passes_->needs_whole_iterations(); }
  renderer::Counters counters() const override { return passes_->counters(); }
  renderer::LightVertexMemory light_vertices() const override { return passes_->light_vertices(); }

 private:
  tbb::task_arena arena_;
  std::unique_ptr<renderer::Passes> passes_;
};

Contender contender(const renderer::Scene& scene, renderer::Mode mode, int threads) {
  renderer::RenderOptions options;
  options.mode = mode;
  options.seed = 1;
  const bool polarized = mode == renderer::Mode::optimized;
  return {polarized ? "optimized" : "unpolarized", [&scene, options, threads](auto& film) {
            return std::make_unique<InArena>(threads, renderer::make_passes(scene, options, film));
          }};
}

constexpr renderer::Mode modes[] = {renderer::Mode::unpolarized, renderer::Mode::optimized};

std::vector<Result> measure_modes(const Arguments& a, const Setting& s) {
  const renderer::Scene scene = load(a, s);
  std::vector<Contender> contenders;
  for (const auto mode : modes) contenders.push_back(contender(scene, mode, 1));
  std::vector<Result> results;
  for (Row& row : variants::measure(scene, contenders, a.seconds, a.turn, true))
    results.push_back({s, row.variant, row, "unpolarized"});
  return results;
}

/// One thread and each other number of them, of each mode.
std::vector<Result> measure_threads(const Arguments& a, const Setting& s, int most) {
  const renderer::Scene scene = load(a, s);
  std::vector<Result> results;
  for (const auto mode : modes) {
    std::vector<Contender> contenders;
    for (int threads = 1; threads <= most; ++threads)
      contenders.push_back(contender(scene, mode, threads));
    int threads = 1;
    for (Row& row : variants::measure(scene, contenders, a.seconds, a.turn, false)) {
      Result result{s, row.variant, row, "1 thread"};
      result.setting.value = result.setting.threads = threads++;
      results.push_back(std::move(result));
    }
  }
  return results;
}

void print_head(const std::string& dimension) {
  std::printf(
      "\n### %s\n\n| scene | algorithm | %s | mode | ns a path | rays a path | ns a ray | merges a "
      "path | speed, of %s's (95 %%) |\n|---|---|--:|---|--:|--:|--:|--:|---|\n",
      dimension.c_str(), dimension.c_str(), dimension == "threads" ? "one thread" : "unpolarized");
}

double nanoseconds(const Row& row) { return 1e9 / row.paths_per_second; }

void print(const Result& r) {
  const Setting& s = r.setting;
  const Row& row = r.row;
  std::printf("| %s | %s | %d | %s | %.0f | %.2f | %.1f | %.2f | %.3f (%.3f to %.3f) |\n",
              s.scene.c_str(), s.algorithm.c_str(), s.value, r.mode.c_str(), nanoseconds(row),
              row.rays_per_path, nanoseconds(row) / std::max(row.rays_per_path, 1e-9),
              row.merges_per_path, row.ratio.value, row.ratio.low, row.ratio.high);
  std::fflush(stdout);
}

nlohmann::ordered_json to_json(const Result& r) {
  const Setting& s = r.setting;
  return {{"dimension", s.dimension},
          {"value", s.value},
          {"scene", s.scene},
          {"algorithm", s.algorithm},
          {"mode", r.mode},
          {"threads", s.threads},
          {"resolution", s.resolution},
          {"nanoseconds_per_path", nanoseconds(r.row)},
          {"rays_per_path", r.row.rays_per_path},
          {"merges_per_path", r.row.merges_per_path},
          {"paths_per_second", r.row.paths_per_second},
          {"seconds", r.row.seconds},
          {"ratio_to", r.relative_to},
          {"ratio", r.row.ratio.value},
          {"ratio_low", r.row.ratio.low},
          {"ratio_high", r.row.ratio.high}};
}

std::vector<Setting> settings_of(const Arguments& a, const std::string& dimension) {
  std::vector<Setting> list;
  const auto add = [&](const std::string& scene, std::vector<const char*> algorithms,
                       std::vector<int> values, auto&& set) {
    for (const char* algorithm : algorithms)
      for (const int value : values) {
        Setting s{scene, algorithm, dimension, value};
        set(s, value);
        list.push_back(s);
      }
  };
  std::vector<int> sides;
  for (int side = 64; side <= a.largest; side *= 2) sides.push_back(side);
  for (const auto& scene : a.scenes) {
    if (dimension == "threads") add(scene, {"path", "bdpt", "vcm"}, {0}, [](Setting&, int) {});
    if (dimension == "depth")
      add(scene, {"path", "bdpt"}, {2, 4, 8, 16, 32},
          [](Setting& s, int depth) { s.max_depth = depth; });
    if (dimension == "photons")
      add(scene, {"ppm", "vcm"}, sides, [](Setting& s, int side) {
        s.resolution = side;
        s.value = side * side;
      });
    if (dimension == "resolution")
      add(scene, {"path", "bdpt"}, sides, [](Setting& s, int side) { s.resolution = side; });
  }
  return list;
}

int run(const Arguments& a) {
  benchmarks::reject_nan("--seconds", a.seconds);
  benchmarks::reject_nan("--turn", a.turn);
  if (!a.json.empty()) renderer::check_writable(a.json);
  const int most = a.threads > 0 ? a.threads : tbb::info::default_concurrency();
  const tbb::global_control allowed(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(most));
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const auto& dimension : a.dimensions) {
    print_head(dimension);
    for (const Setting& s : settings_of(a, dimension))
      for (const Result& r :
           dimension == "threads" ? measure_threads(a, s, most) : measure_modes(a, s)) {
        print(r);
        json.push_back(to_json(r));
      }
    if (!a.json.empty()) renderer::write_file(a.json, json.dump(2) + "\n");
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments a;
  CLI::App app("Time of a path by threads, length of paths, photons and resolution",
               "benchmark_scaling");
  benchmarks::add_scene_options(app, a.scenes, a.folder);
  app.add_option("--dimension", a.dimensions, "What is varied")
      ->check(CLI::IsMember({"threads", "depth", "photons", "resolution"}))
      ->capture_default_str();
  app.add_option("--seconds", a.seconds, "For each row; one of big pictures takes longer")
      ->check(CLI::Range(0.001, 1e6))
      ->capture_default_str();
  app.add_option("--turn", a.turn, "Seconds after which the other mode takes its turn")
      ->check(CLI::Range(0.001, 1e6))
      ->capture_default_str();
  app.add_option("--threads", a.threads, "The most (0: all there are)")
      ->check(CLI::Range(0, 4096))
      ->capture_default_str();
  app.add_option("--largest", a.largest, "The most pixels across that pictures have")
      ->check(CLI::Range(64, 4096))
      ->capture_default_str();
  app.add_option("--json", a.json, "File of the same rows");
  return benchmarks::run_program(app, argc, argv, [&] { return run(a); });
}
