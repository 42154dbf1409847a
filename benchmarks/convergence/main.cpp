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
// turns, as do variants, so that drifts of the machine's speed fall on all alike. With one thread
// times are the processor's.
//
// "unpolarized" is measured against the same truth as the others: all of S1 to S3 is its error, and
// so is what S0 owes to polarisation.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <map>

#include "io/atomic_file.hpp"
#include "io/input_error.hpp"
#include "report.hpp"
#include "scene/needs.hpp"

namespace {

using namespace convergence;

struct Arguments {
  std::vector<std::string> scenes{"vcm_box", "diffuse",     "glossy",
                                  "glass",   "upbp_sphere", "glass_medium"};
  std::vector<std::string> algorithms;
  std::vector<std::string> variants{"unpolarized", "optimized", "auto"};
  std::vector<std::string> recipes;
  std::vector<double> targets{0.1, 0.05};
  std::string folder = MALUS_SCENES_DIR, cache = "references", json;
  double seconds = 2, reference_seconds = 0;
  std::size_t batches = 8;
  int points = 6, repeats = 5, threads = 1, resolution = 128;
  std::uint64_t seed = 1;
};

/// Where smooth glass or mirrors hide the light from each other, path tracing alone finds some of
/// it so seldom that its mean is no normal variable.
std::vector<Recipe> recipes_for(const Arguments& a, const renderer::Scene& scene) {
  std::vector<Recipe> recipes;
  for (const auto& text : a.recipes) recipes.push_back(Recipe::parse(text));
  if (recipes.empty()) {
    const bool smooth = std::any_of(scene.bsdfs.begin(), scene.bsdfs.end(), [](const auto& bsdf) {
      return std::holds_alternative<renderer::Dielectric>(bsdf.kind());
    });
    recipes.push_back(Recipe::parse("bdpt"));
    recipes.push_back(Recipe::parse(smooth ? "vcm:0.25" : "path"));
  }
  return recipes;
}

/// All, unless some are named: but not light tracing where it can't see what is smooth.
std::vector<std::string> algorithms_for(const Arguments& a, const renderer::Scene& scene) {
  if (!a.algorithms.empty()) return a.algorithms;
  std::vector<std::string> list{"path", "bdpt", "ppm", "bpm", "vcm"};
  const bool smooth = std::any_of(scene.bsdfs.begin(), scene.bsdfs.end(), [](const auto& bsdf) {
    return bsdf.is_delta() && !bsdf.is_sheet();
  });
  if (!smooth) list.insert(list.begin() + 1, "ptracer");
  return list;
}

renderer::Mode mode_of(const std::string& variant, const renderer::Scene& scene) {
  const bool polarizes =
      variant == "optimized" || (variant == "auto" && renderer::find_needs(scene).polarization());
  return polarizes ? renderer::Mode::optimized : renderer::Mode::unpolarized;
}

/// Powers of two, the last the nearest to `most`: some samplers are at their best with these.
std::vector<std::uint64_t> ladder(std::uint64_t most, int points) {
  const auto last = static_cast<int>(std::lround(std::log2(static_cast<double>(most))));
  std::vector<std::uint64_t> list;
  for (int power = std::max(0, last - points + 1); power <= last; ++power)
    list.push_back(std::uint64_t{1} << power);
  return list;
}

std::vector<Curve> measure(const Arguments& a, const SceneFile& file, const std::string& algorithm,
                           const Reference& reference) {
  const renderer::Scene scene = load(file, algorithm);
  Job job;
  job.threads = a.threads;
  job.mode = mode_of(a.variants.back(), scene);
  const auto samples = ladder(samples_for(scene, a.seconds, job), a.points);
  std::vector<Curve> curves;
  for (const auto& variant : a.variants) {
    const bool polarized = mode_of(variant, scene) == renderer::Mode::optimized;
    Curve curve{file.name, algorithm, variant, polarized ? "optimized" : "unpolarized", {}};
    for (const std::uint64_t n : samples) curve.points.push_back({n, {}, {}});
    curves.push_back(std::move(curve));
  }
  std::uint64_t picture = 0;
  for (int repeat = 0; repeat < a.repeats; ++repeat)
    for (std::size_t point = 0; point < samples.size(); ++point) {
      // Short renderings vary most, and cost little: of these a repeat has up to four.
      const std::size_t pictures = std::min<std::size_t>(4, samples.back() / samples[point]);
      std::vector<std::vector<Picture>> rendered(curves.size());
      for (std::size_t i = 0; i < pictures; ++i, ++picture)
        for (std::size_t k = 0; k < curves.size(); ++k) {
          const std::size_t turn = picture % 2 == 0 ? k : curves.size() - 1 - k;
          job.mode = mode_of(curves[turn].variant, scene);
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
  return {{"seconds", a.seconds},       {"repeats", a.repeats}, {"threads", a.threads},
          {"resolution", a.resolution}, {"seed", a.seed},       {"targets", a.targets}};
}

/// CLI11's ranges let it pass.
void reject_nan(const char* option, double value) {
  if (std::isnan(value)) throw renderer::InputError(std::string(option) + ": nan is no number");
}

int run(const Arguments& a) {
  reject_nan("--seconds", a.seconds);
  reject_nan("--reference-seconds", a.reference_seconds);
  for (const double target : a.targets) reject_nan("--target", target);
  if (!a.json.empty()) renderer::check_writable(a.json);
  ReferencePlan plan;
  plan.batches = a.batches;
  plan.seconds = a.reference_seconds > 0 ? a.reference_seconds : 30 * a.seconds;
  plan.threads = a.threads;
  plan.cache = a.cache;
  nlohmann::ordered_json json{{"settings", settings(a)},
                              {"references", nlohmann::ordered_json::array()},
                              {"rows", nlohmann::ordered_json::array()}};
  for (const auto& name : a.scenes) {
    const SceneFile file = find_scene(a.folder, name, a.resolution);
    const renderer::Scene scene = load(file, "path");
    plan.recipes = recipes_for(a, scene);
    const Reference reference = make_reference(file, plan);
    std::printf("\n### %s\n\n", name.c_str());
    print_reference_head();
    print(file, plan, reference);
    json["references"].push_back(to_json(file, plan, reference));
    std::vector<Curve> curves;
    for (const auto& algorithm : algorithms_for(a, scene))
      for (Curve& curve : measure(a, file, algorithm, reference)) {
        json["rows"].push_back(to_json(curve, a.targets, reference));
        curves.push_back(std::move(curve));
      }
    print(curves, a.targets, reference);
    // After every scene, so that what there is outlives a run that is stopped.
    if (!a.json.empty()) renderer::write_file(a.json, json.dump(2) + "\n");
  }
  return 0;
}

void add_options(CLI::App& app, Arguments& a) {
  app.add_option("--scene", a.scenes, "Names of scenes")->capture_default_str();
  app.add_option("--scenes", a.folder, "Folder of the scenes")->check(CLI::ExistingDirectory);
  app.add_option("--algorithm", a.algorithms,
                 "Integrators (default: all, but ptracer only without smooth surfaces)")
      ->check(CLI::IsMember({"path", "ptracer", "bdpt", "ppm", "bpm", "vcm"}));
  app.add_option("--variant", a.variants, "Modes")
      ->check(CLI::IsMember({"unpolarized", "optimized", "auto"}))
      ->capture_default_str();
  app.add_option("--seconds", a.seconds, "Of the longest rendering of a row, about")
      ->check(CLI::Range(0.01, 1e6))
      ->capture_default_str();
  app.add_option("--points", a.points, "Of a row, each of half the samples of the next")
      ->check(CLI::Range(1, 30))
      ->capture_default_str();
  app.add_option("--repeats", a.repeats, "Of every point, up to four pictures each")
      ->check(CLI::Range(2, 1000))
      ->capture_default_str();
  app.add_option("--reference", a.recipes,
                 "How the two halves of the reference are made, as in: bdpt vcm:0.25, the latter "
                 "with merges' radii a quarter of the scene's (default: bdpt path; with smooth "
                 "glass bdpt vcm:0.25; what is lit through glass alone wants vcm twice)")
      ->expected(2);
  app.add_option("--reference-seconds", a.reference_seconds,
                 "Of each half (default: 30 times --seconds)")
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
  try {
    app.parse(argc, argv);
    return run(a);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  } catch (const renderer::InputError& e) {
    std::cerr << "benchmark_convergence: " << e.what() << '\n';
    return 2;
  } catch (const std::exception& e) {
    std::cerr << "benchmark_convergence: " << e.what() << '\n';
    return 1;
  }
}
