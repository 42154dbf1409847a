// SPDX-License-Identifier: MIT
// What an integrator needs of a scene.
#pragma once

#include "scene.hpp"

namespace renderer {

/// Throws InputError, naming what is missing, where the scene's integrator could only render black;
/// warns, in scene.warnings, of what is allowed but hardly meant.
void check_requirements(Scene& scene, const std::string& file);

}  // namespace renderer
