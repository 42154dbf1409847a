// SPDX-License-Identifier: MIT
// What was measured, as Markdown on standard output and as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "curve.hpp"
#include "rendering.hpp"

namespace convergence {

void print_reference_head();
void print(const SceneFile& file, const ReferencePlan& plan, const Reference& reference);

/// Tables of one scene: the error of the longest renderings and its slope, and the time to each of
/// the target errors.
void print(const std::vector<Curve>& curves, const std::vector<double>& targets,
           const Reference& reference);

/// What each sampler buys over the first: a table of one scene, if there are several.
void print_gains(const std::vector<Curve>& curves, const std::vector<std::string>& samplers,
                 const Reference& reference);
/// The same by quantity.
nlohmann::ordered_json gains_to_json(const std::vector<Curve>& curves,
                                     const std::vector<std::string>& samplers,
                                     const Reference& reference);

nlohmann::ordered_json to_json(const SceneFile& file, const ReferencePlan& plan,
                               const Reference& reference);
nlohmann::ordered_json to_json(const Curve& curve, const std::vector<double>& targets,
                               const Reference& reference);

}  // namespace convergence
