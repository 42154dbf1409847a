// SPDX-License-Identifier: MIT
#include "requirements.hpp"

#include "../core/warp.hpp"
#include "../io/input_error.hpp"

namespace renderer {

namespace {

/// Whether the lens is inside a closed body of smooth glass: most rays in all directions then meet
/// a dielectric from within first.
bool camera_is_inside_glass(const Scene& scene) {
  constexpr int rays = 64;
  int inside = 0;
  for (int i = 0; i < rays; ++i) {
    // Fibonacci's spiral covers the sphere evenly.
    const float turn = static_cast<float>(i) * 0.618034f;
    const Vec3 d =
        square_to_sphere({(static_cast<float>(i) + 0.5f) / rays, turn - std::floor(turn)});
    Hit hit;
    if (!scene.intersect({scene.sensor->origin(), d}, hit)) continue;
    const Bsdf* bsdf = scene.shapes[hit.shape].material.front;
    if (bsdf->is_delta() && !bsdf->is_sheet() && glm::dot(hit.geometric_normal, d) > 0) ++inside;
  }
  return inside > rays * 3 / 4;
}

}  // namespace

void check_requirements(Scene& scene, const std::string& file) {
  const std::string& name = scene.integrator.name;
  if (scene.lights.empty()) {
    const std::string lack =
        file + ": the scene has no light: no <emitter>, of its own or of a <shape>";
    if (name == "path")
      scene.warnings.push_back(lack + "; the picture is black");
    else
      throw InputError(lack + ", from which the integrator \"" + name + "\" could trace paths");
  }
  if (scene.integrator.strategy && name != "bdpt")
    throw InputError("--strategy is for the integrator \"bdpt\", not for \"" + name + "\"");
  const auto techniques = Techniques::named(name);
  if (!techniques || !techniques->lens_alone) return;
  const std::string others = "; use \"path\", \"bdpt\" or \"vcm\"";
  if (scene.sensor->kind() == Sensor::Kind::radiancemeter)
    throw InputError(file +
                     ": the sensor is a single ray (radiancemeter), which no light path of " +
                     "\"ptracer\" ever meets" + others);
  if (camera_is_inside_glass(scene))
    throw InputError(file + ": the camera is inside glass, through whose smooth surface no light " +
                     "path of \"ptracer\" can be connected to it" + others);
}

}  // namespace renderer
