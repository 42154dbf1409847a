// SPDX-License-Identifier: MIT
// The variance of S0 to S2 in thick layers of Rayleigh scatterers, where directions are drawn by
// m00 alone and where the plane of scattering is drawn by the polarisation of what a path carries
// (García Muñoz & Mills 2015), which is what the renderer does.
#include <atomic>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "../program.hpp"
#include "render/render.hpp"
#include "scene/build.hpp"
#include "scene/xml_reader.hpp"

namespace {

struct Arguments {
  std::string scene = MALUS_SCENES_DIR "/thick_slab.xml";
  std::vector<std::string> thicknesses{"1", "10", "100"}, albedos{"1", "0.99"},
      integrators{"path", "bdpt"};
  double seconds = 10;
  int threads = 1;
};

/// One line: the means with their standard errors, and the standard deviation of S0 that one path
/// and one second of work leave.
void measure(const Arguments& a, const std::string& tau, const std::string& albedo,
             const std::string& integrator, bool by_polarization) {
  renderer::Scene scene = renderer::build_scene(
      *renderer::read_scene(std::filesystem::path(a.scene), {{"tau", tau}, {"albedo", albedo}}));
  renderer::set_integrator(scene.integrator, integrator);
  scene.draws_by_polarization = by_polarization;
  renderer::RenderOptions options;
  options.seconds = a.seconds;
  options.threads = a.threads;
  options.seed = 1;
  const std::atomic<bool> stop{false};
  const auto rendering = renderer::render(scene, options, stop, {});
  const auto total = rendering.film.total(0);
  const auto error = rendering.film.standard_error(0);
  std::printf("| %s | %s | %s | %s |", tau.c_str(), albedo.c_str(), integrator.c_str(),
              by_polarization ? "polarisation" : "m00");
  for (std::size_t i = 0; i < 3; ++i)
    std::printf(" %.5f ± %.5f |", total.mean(3 * i), error[3 * i]);
  const double relative = error[0] / total.mean(0);
  std::printf(" %.2f | %.4f |\n",
              // Of the scene's one pixel.
              relative * std::sqrt(static_cast<double>(rendering.counters.samples)),
              relative * std::sqrt(rendering.seconds));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  Arguments a;
  CLI::App app("Variance in thick Rayleigh layers, by what directions are drawn by",
               "benchmark_thick_media");
  app.add_option("--scene", a.scene, "a scene of one pixel with $tau and $albedo");
  app.add_option("--tau", a.thicknesses, "optical thicknesses");
  app.add_option("--albedo", a.albedos, "single-scattering albedos");
  app.add_option("--algorithm", a.integrators, "integrators");
  app.add_option("--seconds", a.seconds, "of each line")->check(CLI::PositiveNumber);
  app.add_option("--threads", a.threads)->check(CLI::PositiveNumber);
  return benchmarks::run_program(app, argc, argv, [&] {
    benchmarks::reject_nan("--seconds", a.seconds);
    std::printf(
        "| τ | albedo | algorithm | drawn by | S0 | S1 | S2 | σ of S0, one path | σ of S0, one "
        "second |\n|--:|--:|---|---|--:|--:|--:|--:|--:|\n");
    for (const auto& tau : a.thicknesses)
      for (const auto& albedo : a.albedos)
        for (const auto& integrator : a.integrators)
          for (const bool by_polarization : {false, true})
            measure(a, tau, albedo, integrator, by_polarization);
    return 0;
  });
}
