// SPDX-License-Identifier: MIT
#include "statistics.hpp"

#include <cmath>

namespace renderer {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* form_names[malus::mueller_forms] = {
    "zero",  "plain", "partial", "depolarizing", "depolarizing_enter", "depolarizing_exit",
    "block", "full"};

/// {"S0": [one a channel], "S1": …}; null where a value is not finite.
Json by_component(const std::array<double, 12>& values, StokesFrame frame, bool is_signed) {
  Json json;
  for (std::size_t s = 0; s < 4; ++s) {
    Json channels = Json::array();
    for (std::size_t c = 0; c < 3; ++c) {
      const bool turns = is_signed && frame == StokesFrame::up && (s == 1 || s == 2);
      const double value = turns ? -values[3 * s + c] : values[3 * s + c];
      channels.push_back(std::isfinite(value) ? Json(value) : Json(nullptr));
    }
    json["S" + std::to_string(s)] = channels;
  }
  return json;
}

}  // namespace

Json statistics(const Scene& scene, const RenderOptions& options, const Rendering& rendering,
                StokesFrame frame, int threads) {
  const Counters& c = rendering.counters;
  const double seconds = rendering.seconds;
  const auto rate = [&](std::uint64_t n) {
    return seconds > 0 ? static_cast<double>(n) / seconds : 0.0;
  };
  Json json;
  json["integrator"] = scene.integrator.name;
  json["mode"] = options.mode == Mode::unpolarized ? "unpolarized" : "optimized";
  json["width"] = rendering.film.width();
  json["height"] = rendering.film.height();
  json["seed"] = options.seed;
  json["sampler"] = name_of(options.sampler);
  json["threads"] = threads;
  json["iterations"] = rendering.samples_per_pixel;
  json["resumed_from"] = rendering.resumed_from;
  json["interrupted"] = rendering.interrupted;
  json["seconds"] = seconds;
  json["samples"] = c.samples;
  json["paths_per_second"] = rate(c.samples);
  json["rays"] = c.rays;
  json["shadow_rays"] = c.shadow_rays;
  json["rays_per_second"] = rate(c.rays + c.shadow_rays);
  json["non_finite_samples"] = c.non_finite;
  if (options.mode == Mode::optimized) json["unphysical_samples"] = c.unphysical;
  json["relative_noise"] = rendering.film.relative_noise();
  Json forms = Json::object();
  if (options.mode == Mode::optimized)
    for (std::size_t i = 0; i < c.forms.size(); ++i) forms[form_names[i]] = c.forms[i];
  json["mueller_forms"] = forms;
  if (options.mode == Mode::optimized)
    json["camera_paths"] = {{"without_light", c.dark_paths},
                            {"scatterings", c.scatterings},
                            {"not_evaluated", c.scatterings - c.evaluated}};
  json["connections"] = {{"tried", c.connections},
                         {"shadowed", c.shadowed},
                         {"open", c.connections - c.shadowed},
                         {"left_to_chance", c.left_to_chance}};
  // Path and light tracing store none.
  const LightVertexMemory& memory = rendering.light_vertices;
  json["light_vertices"] = c.light_vertices;
  if (memory.bytes_per_vertex > 0)
    json["stored_light"] = {{"intensity", c.light_vertices - c.stored_stokes},
                            {"stokes_vector", c.stored_stokes}};
  json["bytes_per_light_vertex"] = memory.bytes_per_vertex;
  json["bytes_per_photon"] = memory.bytes_per_photon;
  json["light_vertex_memory"] = memory.peak;
  json["merges"] = c.merges;
  if (memory.bytes_per_photon > 0)
    json["merged_light"] = {{"intensity", c.merges - c.merged_stokes},
                            {"stokes_vector", c.merged_stokes}};
  json["shapes"] = scene.geometry.shape_count();
  json["triangles"] = scene.geometry.triangle_count();
  json["stokes_frame"] = frame == StokesFrame::up ? "up" : "horizontal";
  if (rendering.film.width() == 1 && rendering.film.height() == 1) {
    const PixelSum total = rendering.film.total(0);
    std::array<double, 12> mean{};
    for (std::size_t i = 0; i < mean.size(); ++i) mean[i] = total.mean(i);
    json["measurement"] = by_component(mean, frame, true);
    json["standard_error"] = by_component(rendering.film.standard_error(0), frame, false);
  }
  return json;
}

}  // namespace renderer
