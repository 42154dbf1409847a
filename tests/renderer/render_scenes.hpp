// SPDX-License-Identifier: MIT
// Small scenes for the tests of the renderer, rendered through its public interface, and their
// readings.
#pragma once

#include <array>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <glm/glm.hpp>
#include <sstream>
#include <string>

#include "render/render.hpp"
#include "scene/build.hpp"
#include "scene_files.hpp"

namespace render_test {

using renderer::Mode;
using renderer::Rendering;
using scene_test::Definitions;

constexpr double pi = 3.14159265358979323846;
constexpr double radians(double degrees) { return degrees * pi / 180; }

inline std::string text(const glm::dvec3& v) {
  std::ostringstream out;
  out.precision(17);
  out << v.x << ", " << v.y << ", " << v.z;
  return out.str();
}
inline std::string number(const std::string& name, double value) {
  std::ostringstream out;
  out.precision(17);
  out << "<float name=\"" << name << "\" value=\"" << value << "\"/>";
  return out.str();
}

inline std::string look(const glm::dvec3& origin, const glm::dvec3& target, const glm::dvec3& up) {
  return "<lookat origin=\"" + text(origin) + "\" target=\"" + text(target) + "\" up=\"" +
         text(up) + "\"/>";
}

/// A radiancemeter in whose picture `right` (perpendicular to the way it looks) is to the right.
inline std::string meter(const glm::dvec3& origin, const glm::dvec3& target,
                         const glm::dvec3& right) {
  return "<sensor type=\"radiancemeter\"><transform name=\"to_world\">" +
         look(origin, target, glm::cross(right, target - origin)) + "</transform></sensor>\n";
}

inline std::string bsdf(const std::string& type, const std::string& parameters = "") {
  return "<bsdf type=\"" + type + "\">" + parameters + "</bsdf>";
}

/// A square of half the width `size`, whose front looks at a point.
inline std::string square(const glm::dvec3& center, const glm::dvec3& facing, double size,
                          const std::string& content, const glm::dvec3& up = {0.3, 1, 0.2}) {
  return "<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"" +
         std::to_string(size) + "\"/>" + look(center, facing, up) + "</transform>" + content +
         "</shape>\n";
}

/// The file of a square of half the width 1 about the origin, whose front faces +z, and whose
/// normal is interpolated from the same one, such as "0 0.6 0.8", everywhere.
inline std::filesystem::path square_with_normal(const scene_test::Folder& folder,
                                                const std::string& normal) {
  const std::string n = " " + normal + "\n";
  return folder.write(
      "square " + normal + ".ply",
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
      "z\nproperty float nx\nproperty float ny\nproperty float nz\nelement face 2\nproperty list "
      "uchar int vertex_indices\nend_header\n-1 -1 0" +
          n + "1 -1 0" + n + "1 1 0" + n + "-1 1 0" + n + "3 0 1 2\n3 0 2 3\n");
}

inline const std::string sky =
    "<emitter type=\"constant\"><rgb name=\"radiance\" value=\"1\"/></emitter>\n";

inline std::string integrator(int max_depth) {
  return "<integrator type=\"path\"><integer name=\"max_depth\" value=\"" +
         std::to_string(max_depth) + "\"/></integrator>\n";
}

inline renderer::Scene build(std::string_view content, const Definitions& definitions = {}) {
  return renderer::build_scene(*scene_test::read(content, definitions));
}
inline renderer::Scene example(const std::string& name, const Definitions& definitions = {}) {
  return renderer::build_scene(
      *renderer::read_scene(std::filesystem::path(MALUS_SCENES_DIR) / name, definitions));
}

inline Rendering render(const renderer::Scene& scene, std::uint64_t samples,
                        Mode mode = Mode::optimized, std::uint64_t seed = 1, int threads = 2) {
  const std::atomic<bool> stop{false};
  renderer::RenderOptions options;
  options.mode = mode;
  options.samples_per_pixel = samples;
  options.seed = seed;
  options.threads = threads;
  return renderer::render(scene, options, stop, {});
}

/// The first channel's Stokes vector of a pixel, and its standard error.
struct Reading {
  glm::dvec4 stokes, error;
};

inline Reading reading(const Rendering& rendering, std::size_t pixel = 0) {
  const auto total = rendering.film.total(pixel);
  const auto error = rendering.film.standard_error(pixel);
  Reading r{};
  for (int i = 0; i < 4; ++i) {
    const auto channel = static_cast<std::size_t>(3 * i);
    r.stokes[i] = total.mean(channel);
    r.error[i] = error[channel];
  }
  return r;
}

/// Of a scene without chance in it, or of many samples of one with.
inline Reading read_meter(std::string_view content, std::uint64_t samples = 16) {
  return reading(render(build(content), samples));
}

inline double difference(const glm::dvec4& a, const glm::dvec4& b) {
  const glm::dvec4 d = glm::abs(a - b);
  return std::max(std::max(d.x, d.y), std::max(d.z, d.w));
}

}  // namespace render_test
