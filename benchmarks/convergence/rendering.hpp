// SPDX-License-Identifier: MIT
// Pictures rendered for measuring, and the references made of them, which a folder keeps.
#pragma once

#include <filesystem>
#include <string>
#include <utility>

#include "../variants/variant.hpp"
#include "errors.hpp"
#include "render/render.hpp"
#include "scene_file.hpp"

namespace convergence {

struct Job {
  variants::Variant variant = variants::Variant::optimized;
  renderer::SamplerKind sampler = renderer::SamplerKind::independent;
  std::uint64_t samples = 1, seed = 0;
  int threads = 1;
};

/// The seconds are the processor's with one thread, so that other programs on the machine count
/// less, else the clock's.
Picture render(const renderer::Scene& scene, const Job& job);

/// About how many samples a pixel take so many seconds; at least one.
std::uint64_t samples_for(const renderer::Scene& scene, double seconds, Job job);

/// How one half of a reference is made: "bdpt", or "vcm:0.25" with merges' radii a quarter of the
/// scene's.
struct Recipe {
  std::string algorithm;
  double radius_factor = 1;

  static Recipe parse(const std::string& text);
  std::string text() const;
};

struct ReferencePlan {
  std::vector<Recipe> recipes;  ///< two
  std::size_t batches = 8;      ///< of each
  double seconds = 60;          ///< of each recipe
  int threads = 1;
  std::filesystem::path cache;
};

/// Renders what the cache doesn't hold yet of it. A batch there is used if it is of the same files
/// and parameters and of no less seconds than are asked for.
Reference make_reference(const SceneFile& file, const ReferencePlan& plan);

}  // namespace convergence
