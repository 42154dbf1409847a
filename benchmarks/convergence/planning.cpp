// SPDX-License-Identifier: MIT
#include "planning.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

namespace convergence {

namespace {

bool is_smooth_glass(const renderer::Bsdf& bsdf) {
  return std::holds_alternative<renderer::Dielectric>(bsdf.kind());
}

/// Of the lights' power, the part that meets smooth glass first.
double power_through_glass(const renderer::Scene& scene) {
  constexpr std::uint64_t samples = 4096;
  double all = 0, through_glass = 0;
  for (std::uint64_t i = 0; i < samples; ++i) {
    renderer::Sampler random(0, 0, i);
    renderer::EmissionSample e;
    if (!scene.emit(random, false, e)) continue;
    const double power = static_cast<double>(e.power[0] + e.power[1] + e.power[2]);
    all += power;
    renderer::Hit hit;
    if (!scene.intersect({e.position + e.reach * e.normal, e.direction}, hit)) continue;
    if (is_smooth_glass(scene.shapes[hit.shape].material.facing(hit, -e.direction)))
      through_glass += power;
  }
  return all > 0 ? through_glass / all : 0;
}

}  // namespace

std::vector<Recipe> suited_recipes(const renderer::Scene& scene) {
  if (!std::any_of(scene.bsdfs.begin(), scene.bsdfs.end(), is_smooth_glass))
    return {Recipe::parse("bdpt"), Recipe::parse("path")};
  const bool is_enclosed = power_through_glass(scene) > 0.5;
  return {Recipe::parse(is_enclosed ? "vcm:0.25" : "bdpt"), Recipe::parse("vcm:0.25")};
}

std::vector<std::string> suited_algorithms(const renderer::Scene& scene) {
  std::vector<std::string> list{"path", "bdpt", "ppm", "bpm", "vcm"};
  const bool smooth = std::any_of(scene.bsdfs.begin(), scene.bsdfs.end(), [](const auto& bsdf) {
    return bsdf.is_delta() && !bsdf.is_sheet();
  });
  if (!smooth) list.insert(list.begin() + 1, "ptracer");
  return list;
}

std::vector<std::uint64_t> ladder(std::uint64_t most, int points) {
  const auto last = static_cast<int>(std::lround(std::log2(static_cast<double>(most))));
  std::vector<std::uint64_t> list;
  for (int power = std::max(0, last - points + 1); power <= last; ++power)
    list.push_back(std::uint64_t{1} << power);
  return list;
}

}  // namespace convergence
