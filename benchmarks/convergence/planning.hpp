// SPDX-License-Identifier: MIT
// What suits a scene: references, algorithms and sample counts.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rendering.hpp"

namespace convergence {

/// bdpt beside path. Path tracing alone finds light that comes by way of smooth glass so seldom
/// that its mean is no normal variable: vcm takes its place where there is such glass, and both
/// places where next to all light has to leave through it, which bdpt then finds by chance alone.
std::vector<Recipe> suited_recipes(const renderer::Scene& scene);

/// All algorithms, but not light tracing where it can't see what is smooth.
std::vector<std::string> suited_algorithms(const renderer::Scene& scene);

/// Powers of two, the last the nearest to `most`: some samplers are at their best with these.
std::vector<std::uint64_t> ladder(std::uint64_t most, int points);

}  // namespace convergence
