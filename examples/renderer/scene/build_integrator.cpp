// SPDX-License-Identifier: MIT
#include "build.hpp"

namespace renderer {

namespace {

/// As a part of the scene's radius.
float read_radius(const Object& o, std::string_view name, float otherwise) {
  return static_cast<float>(o.number_in(name, static_cast<double>(otherwise), 1e-5, 1));
}

void read_merging(const Object& o, IntegratorSettings& settings) {
  const IntegratorSettings defaults;
  settings.initial_radius = read_radius(o, "initial_radius", defaults.initial_radius);
  settings.initial_media_radius =
      read_radius(o, "initial_media_radius", defaults.initial_media_radius);
  o.positive("radius_alpha", 1);
  settings.radius_alpha = static_cast<float>(o.number_in("radius_alpha", 0.75, 0, 1));
}

}  // namespace

void set_integrator(IntegratorSettings& settings, const std::string& name) {
  // Media need no other integrator: Mitsuba's names for one with them differ in what counts. That
  // stays as a file has it when another integrator is asked for, so that pictures can be compared.
  const bool is_volpath = name == "volpath" || name == "volpathmis";
  if (is_volpath) settings.sheets_count = false;
  settings.name = is_volpath ? "path" : name;
}

void build_integrator(const Object& o, Scene& scene) {
  // Mitsuba's "stokes" wraps the integrator whose Stokes vectors are wanted; here they always are.
  if (o.type() == "stokes") {
    const auto inner = o.only_child("integrator");
    if (!inner) o.fail("a \"stokes\" integrator holds the <integrator> to be used");
    o.reject_unknown();
    return build_integrator(*inner, scene);
  }
  const auto techniques = Techniques::named(o.type());
  if (!techniques && o.type() != "path" && o.type() != "volpath" && o.type() != "volpathmis")
    fail_unknown_plugin(o, {"bdpt", "bpm", "path", "ppm", "ptracer", "vcm", "volpath", "volpathmis",
                            "and \"stokes\" around them"});
  IntegratorSettings& settings = scene.integrator;
  set_integrator(settings, o.type());
  settings.max_depth = static_cast<int>(o.integer_in("max_depth", -1, -1, 1 << 20));
  if (settings.max_depth == 0) o.fail("max_depth", "max_depth is -1 (no limit) or at least 1");
  settings.rr_depth = static_cast<int>(o.integer_in("rr_depth", 5, 1, 1 << 20));
  settings.hide_emitters = o.boolean("hide_emitters", false);
  if (techniques && techniques->lens_alone) o.integer_in("samples_per_pass", -1, -1, 1LL << 40);
  // Another integrator may be asked for in the end: these may be given with any.
  read_merging(o, settings);
  settings.connection_threshold = static_cast<float>(
      o.number_in("connection_threshold", IntegratorSettings().connection_threshold, 0, 1));
  o.reject_unknown();
}

}  // namespace renderer
