// SPDX-License-Identifier: MIT
// Error over time of every scene, algorithm and variant: how long it takes to know S0, S1 to S3 and
// the degree of polarisation to a given accuracy.
//
//   benchmark_convergence --seconds 4 --cache references --json convergence.json
//   benchmarks/convergence/plot.py convergence.json -o plots
//
// Each scene is first rendered twice, by two algorithms (--reference) that share nothing but the
// scene: the truth is known by these two, each with its error bars from batches of its own. They
// are kept in the cache. What errors.hpp says of the measures holds: their noise is not part of the
// errors, and an error that is not well above their standard error is marked and left out of
// slopes and times.
//
// Then each algorithm renders samples a pixel in powers of two, the most of which take about
// --seconds; every picture has a seed of its own, except that variants share them. Repeats take
// turns, as do variants, so that drifts of the machine's speed fall on all alike; a point's time is
// its samples times the median of all pictures' time a sample. With one thread times are the
// processor's.
//
// With several samplers (--sampler independent sobol) the squared errors' ratio is printed, at
// equal samples and at equal time. --budget 15 shares a quarter of an hour among all scenes and
// algorithms.
//
// "unpolarized" is measured against the same truth as the others: all of S1 to S3 is its error, and
// so is what S0 owes to polarisation.
#include <chrono>
#include <cstdio>
#include <numeric>

#include "../program.hpp"
#include "budget.hpp"
#include "io/atomic_file.hpp"
#include "planning.hpp"
#include "report.hpp"

namespace {

using namespace convergence;

struct Arguments {
  std::vector<std::string> scenes{"vcm_box",     "diffuse",      "glossy",   "glass",
                                  "upbp_sphere", "glass_medium", "bathroom", "bathroom_medium"};
  std::vector<std::string> algorithms;
  std::vector<std::string> variants{"unpolarized", "naive", "optimized", "auto"};
  std::vector<std::string> samplers{"auto"};
  std::vector<std::string> recipes;
  std::vector<double> targets{0.1, 0.05};
  std::string folder = MALUS_SCENES_DIR, cache = "references", json;
  double seconds = 2, budget = 0, reference_seconds = 0;
  std::size_t batches = 8;
  int points = 6, repeats = 5, threads = 1, resolution = 128;
  std::uint64_t seed = 1;
};

std::vector<Recipe> recipes_for(const Arguments& a, const renderer::Scene& scene) {
  if (a.recipes.empty()) return suited_recipes(scene);
  std::vector<Recipe> recipes;
  for (const auto& text : a.recipes) recipes.push_back(Recipe::parse(text));
  return recipes;
}

std::vector<std::string> algorithms_for(const Arguments& a, const renderer::Scene& scene) {
  return a.algorithms.empty() ? suited_algorithms(scene) : a.algorithms;
}

renderer::SamplerKind sampler_of(const std::string& sampler, const renderer::Scene& scene) {
  if (sampler == "auto") return renderer::suited_sampler(scene);
  return sampler == "sobol" ? renderer::SamplerKind::sobol : renderer::SamplerKind::independent;
}

/// Of every variant with every sampler, without measured points.
std::vector<Curve> empty_curves(const Arguments& a, const renderer::Scene& scene,
                                const std::string& name, const std::string& algorithm,
                                const std::vector<std::uint64_t>& samples) {
  std::vector<Curve> curves;
  for (const auto& variant : a.variants)
    for (const auto& sampler : a.samplers) {
      const bool polarized = variants::is_polarized(variants::variant_of(variant), scene);
      Curve curve{name,
                  algorithm,
                  variant,
                  sampler,
                  !polarized           ? "unpolarized"
                  : variant == "naive" ? "naive"
                                       : "optimized",
                  renderer::name_of(sampler_of(sampler, scene)),
                  {}};
      for (const std::uint64_t n : samples) curve.points.push_back({n, {}, {}});
      curves.push_back(std::move(curve));
    }
  return curves;
}

std::vector<Curve> measure(const Arguments& a, const SceneFile& file, const std::string& algorithm,
                           double seconds, const Reference& reference) {
  const renderer::Scene scene = load(file, algorithm);
  Job job;
  job.threads = a.threads;
  job.variant = variants::variant_of(a.variants.back());
  const auto samples = ladder(samples_for(scene, seconds, job), a.points);
  std::vector<Curve> curves = empty_curves(a, scene, file.name, algorithm, samples);
  std::uint64_t picture = 0;
  for (int repeat = 0; repeat < a.repeats; ++repeat)
    for (std::size_t point = 0; point < samples.size(); ++point) {
      const std::size_t pictures = pictures_of(samples[point], samples.back());
      std::vector<std::vector<Picture>> rendered(curves.size());
      for (std::size_t i = 0; i < pictures; ++i, ++picture)
        for (std::size_t k = 0; k < curves.size(); ++k) {
          const std::size_t turn = picture % 2 == 0 ? k : curves.size() - 1 - k;
          job.variant = variants::variant_of(curves[turn].variant);
          job.sampler = sampler_of(curves[turn].sampler, scene);
          job.samples = samples[point];
          job.seed = a.seed * 1'000'000'000 + picture;
          rendered[turn].push_back(render(scene, job));
        }
      for (std::size_t k = 0; k < curves.size(); ++k)
        curves[k].points[point].add_repeat(rendered[k], reference);
    }
  return curves;
}

nlohmann::ordered_json settings(const Arguments& a) {
  return {{"seconds", a.seconds}, {"budget", a.budget},     {"repeats", a.repeats},
          {"threads", a.threads}, {"samplers", a.samplers}, {"resolution", a.resolution},
          {"seed", a.seed},       {"targets", a.targets}};
}

/// Says when a run with a budget has to be where.
class Clock {
 public:
  Clock(const Arguments& a, const std::vector<std::size_t>& rows_by_scene)
      : budget_{60 * a.budget, rows_by_scene.size()},
        fixed_(a.seconds),
        cost_(row_cost(a.points, a.repeats, a.variants.size() * a.samplers.size())),
        references_(rows_by_scene.size()),
        rows_(std::accumulate(rows_by_scene.begin(), rows_by_scene.end(), std::size_t{0})) {}

  double reference_seconds() const {
    return budget_.seconds > 0 ? budget_.reference_seconds() : 30 * fixed_;
  }
  void finish_reference() { --references_; }
  /// Of the longest rendering of the next row.
  double begin_row() {
    if (!(budget_.seconds > 0)) return fixed_;
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start_;
    return budget_.row_seconds(passed.count(), rows_--, cost_, references_);
  }

 private:
  Budget budget_;
  double fixed_, cost_;
  std::size_t references_, rows_;  // to come
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

void check(const Arguments& a) {
  benchmarks::reject_nan("--seconds", a.seconds);
  benchmarks::reject_nan("--budget", a.budget);
  benchmarks::reject_nan("--reference-seconds", a.reference_seconds);
  for (const double target : a.targets) benchmarks::reject_nan("--target", target);
  if (!a.json.empty()) renderer::check_writable(a.json);
}

int run(const Arguments& a) {
  check(a);
  std::vector<SceneFile> files;
  std::vector<std::size_t> rows;
  for (const auto& name : a.scenes) {
    files.push_back(find_scene(a.folder, name, a.resolution));
    rows.push_back(algorithms_for(a, load(files.back(), "path")).size());
  }
  Clock clock(a, rows);
  ReferencePlan plan;
  plan.batches = a.batches;
  plan.seconds = a.reference_seconds > 0 ? a.reference_seconds : clock.reference_seconds();
  plan.threads = a.threads;
  plan.cache = a.cache;
  nlohmann::ordered_json json{{"settings", settings(a)},
                              {"references", nlohmann::ordered_json::array()},
                              {"gains", nlohmann::ordered_json::array()},
                              {"rows", nlohmann::ordered_json::array()}};
  for (const SceneFile& file : files) {
    const renderer::Scene scene = load(file, "path");
    plan.recipes = recipes_for(a, scene);
    const Reference reference = make_reference(file, plan);
    clock.finish_reference();
    std::printf("\n### %s\n\n", file.name.c_str());
    print_reference_head();
    print(file, plan, reference);
    json["references"].push_back(to_json(file, plan, reference));
    std::vector<Curve> curves;
    for (const auto& algorithm : algorithms_for(a, scene))
      for (Curve& curve : measure(a, file, algorithm, clock.begin_row(), reference)) {
        json["rows"].push_back(to_json(curve, a.targets, reference));
        curves.push_back(std::move(curve));
      }
    print(curves, a.targets, reference);
    print_gains(curves, a.samplers, reference);
    for (auto& gain : gains_to_json(curves, a.samplers, reference))
      json["gains"].push_back(std::move(gain));
    // After every scene, so that what there is outlives a run that is stopped.
    if (!a.json.empty()) renderer::write_file(a.json, json.dump(2) + "\n");
  }
  return 0;
}

void add_options(CLI::App& app, Arguments& a) {
  benchmarks::add_scene_options(app, a.scenes, a.folder);
  app.add_option("--algorithm", a.algorithms,
                 "Integrators (default: all, but ptracer only without smooth surfaces)")
      ->check(CLI::IsMember({"path", "ptracer", "bdpt", "ppm", "bpm", "vcm"}));
  app.add_option("--variant", a.variants, "Modes, and full matrices as in benchmark_variants")
      ->check(CLI::IsMember({"unpolarized", "naive", "optimized", "auto"}))
      ->capture_default_str();
  app.add_option("--sampler", a.samplers,
                 "Samplers, each with every variant; what the others buy over the first is "
                 "printed, as in: independent sobol")
      ->check(CLI::IsMember({"auto", "independent", "sobol"}))
      ->capture_default_str();
  app.add_option("--seconds", a.seconds, "Of the longest rendering of a row, about")
      ->check(CLI::Range(0.01, 1e6))
      ->capture_default_str();
  app.add_option("--budget", a.budget,
                 "Minutes for everything, which takes the place of --seconds: a quarter is for "
                 "references, the rest shared by scenes and algorithms")
      ->check(CLI::Range(0.0, 1e6));
  app.add_option("--points", a.points, "Of a row, each of half the samples of the next")
      ->check(CLI::Range(1, 30))
      ->capture_default_str();
  app.add_option("--repeats", a.repeats, "Of every point, up to four pictures each")
      ->check(CLI::Range(2, 1000))
      ->capture_default_str();
  app.add_option("--reference", a.recipes,
                 "How the two halves of the reference are made, as in: bdpt vcm:0.25, the latter "
                 "with merges' radii a quarter of the scene's (default: bdpt path; with smooth "
                 "glass bdpt vcm:0.25; where most light leaves through it vcm:0.25 twice)")
      ->expected(2);
  app.add_option("--reference-seconds", a.reference_seconds,
                 "Of each half (default: 30 times --seconds, or a part of --budget)")
      ->check(CLI::Range(0.01, 1e7));
  app.add_option("--batches", a.batches, "Of each half")
      ->check(CLI::Range(3, 1000))
      ->capture_default_str();
  app.add_option("--cache", a.cache, "Folder that references are kept in")->capture_default_str();
  app.add_option("--target", a.targets, "Relative errors to say the time to")
      ->check(CLI::Range(1e-6, 10.0))
      ->capture_default_str();
  app.add_option("--seed", a.seed)->check(CLI::Range(0, 1'000'000))->capture_default_str();
  app.add_option("--threads", a.threads)->check(CLI::Range(1, 4096))->capture_default_str();
  app.add_option("--resolution", a.resolution, "Width of the pictures")
      ->check(CLI::Range(2, 4096))
      ->capture_default_str();
  app.add_option("--json", a.json, "File of the same numbers and all points");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Error over time by scene, algorithm and variant", "benchmark_convergence");
  app.footer(
      "Errors are roots of means over pixels, relative to S0 (1/(S0² + (a tenth of its mean)²)); "
      "in JSON absolute\nones too. Those of S1-S3 are of the three together. DoP is the degree of "
      "polarisation of the mean of the\nchannels, where there is light; noise alone raises it, "
      "which counts as error (in JSON dop_bias).\n≤ means that the first point is better already, "
      "≈ along the line through the last three points; — more than\n30 times as far, or never.");
  Arguments a;
  add_options(app, a);
  return benchmarks::run_program(app, argc, argv, [&] { return run(a); });
}
