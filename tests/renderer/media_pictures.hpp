// SPDX-License-Identifier: MIT
// Media in the way of a radiancemeter, and whether its three channels read what they should.
//
// A `check` compares 12 numbers, four Stokes components of three channels, with Student's t of the
// rendering's own batches, and calls right ones wrong with a chance of at most 10^-5.
#pragma once

#include <bit>
#include <functional>

#include "../unit/jones.hpp"
#include "stokes_agreement.hpp"

namespace media_test {

using namespace render_test;
using Spectrum = std::array<glm::dvec4, 3>;  ///< a Stokes vector a channel

inline std::string rgb(const std::string& name, const std::string& value) {
  return "<rgb name=\"" + name + "\" value=\"" + value + "\"/>";
}
inline std::string vector(const std::string& name, const glm::dvec3& v) {
  return "<vector name=\"" + name + "\" value=\"" + text(v) + "\"/>";
}
inline std::string phase(const std::string& type, const std::string& content = "") {
  return "<phase type=\"" + type + "\">" + content + "</phase>";
}
inline std::string medium(const std::string& content,
                          const std::string& attributes = "name=\"interior\"",
                          const std::string& type = "homogeneous") {
  return "<medium type=\"" + type + "\" " + attributes + ">" + content + "</medium>";
}
inline std::string refer(const std::string& id, const std::string& name = "") {
  return "<ref id=\"" + id + "\"" + (name.empty() ? "" : " name=\"" + name + "\"") + "/>";
}

/// Bounded by nothing that could be seen.
inline std::string box(const glm::dvec3& low, const glm::dvec3& high, const std::string& content) {
  return "<shape type=\"cube\"><transform name=\"to_world\"><scale value=\"" +
         text((high - low) / 2.0) + "\"/><translate value=\"" + text((low + high) / 2.0) +
         "\"/></transform>" + bsdf("null") + content + "</shape>\n";
}
inline std::string ball(const std::string& content) {
  return "<shape type=\"sphere\">" + bsdf("null") + content + "</shape>\n";
}
/// Across the view, from y on, so thick.
inline std::string slab(double y, double thickness, const std::string& content) {
  return box({-1.2, y, -0.9}, {0.8, y + thickness, 1.3}, content);
}

/// Looks along +y; the picture's right is +x and its up +z.
inline std::string view(double from = -5, const std::string& content = "") {
  std::string sensor = meter({0, from, 0}, {0, from + 1, 0}, {1, 0, 0});
  return sensor.insert(sensor.find("</sensor>"), content);
}

/// A sheet polarizer across the view, in front of which light is linear at so many degrees,
/// counter-clockwise for the receiver.
inline std::string polarizer(double y, double degrees) {
  return "<shape type=\"rectangle\"><transform name=\"to_world\"><rotate x=\"1\" angle=\"90\"/>"
         "<translate y=\"" +
         std::to_string(y) + "\"/></transform>" + bsdf("polarizer", number("theta", -degrees)) +
         "</shape>\n";
}

struct Measured {
  Spectrum stokes, error;
};

/// Boundaries of media don't count towards `max_depth`.
inline Measured measure(const std::string& content, const std::string& integrator = "path",
                        std::uint64_t samples = 64, int max_depth = -1) {
  auto scene = build("<integrator type=\"volpath\"/>" + content);
  scene.integrator.name = integrator;
  scene.integrator.max_depth = max_depth;
  const auto film = agreement::render(scene, samples, 3).film;
  const auto total = film.total(0);
  const auto error = film.standard_error(0);
  Measured m{};
  for (int channel = 0; channel < 3; ++channel)
    for (int i = 0; i < 4; ++i) {
      const auto k = static_cast<std::size_t>(3 * i + channel),
                 c = static_cast<std::size_t>(channel);
      m.stokes[c][i] = total.mean(k);
      m.error[c][i] = error[k];
    }
  return m;
}

/// Rays start some 1e-5 behind a boundary, so as not to meet it again, and miss so much of what is
/// there.
constexpr double off_boundaries = 1e-4;

/// The standard error of every channel's S0 has to be below `precision`: what is noisy proves
/// nothing, and the variance is bounded that way too.
inline void check(const Measured& found, const Spectrum& expected, double precision = 1e-6) {
  for (std::size_t c = 0; c < 3; ++c) {
    CAPTURE(c);
    CHECK(found.error[c].x <= precision * expected[c].x);
    for (int i = 0; i < 4; ++i) {
      CAPTURE(i);
      CAPTURE(expected[c][i]);
      CAPTURE(found.stokes[c][i]);
      CAPTURE(found.error[c][i]);
      const double d =
          std::max(0.0, std::abs(found.stokes[c][i] - expected[c][i]) - off_boundaries);
      const bool is_right =
          d == 0 || (found.error[c][i] > 0 &&
                     agreement::student_tail(d / found.error[c][i], agreement::batches - 1) >
                         agreement::family_wise_error / 12);
      CHECK(is_right);
    }
  }
}

/// The same polarisation in every channel, or none, of radiance by channel.
inline Spectrum light(const std::array<double, 3>& radiance, const glm::dvec3& polarization = {}) {
  Spectrum s;
  for (std::size_t c = 0; c < 3; ++c) s[c] = radiance[c] * glm::dvec4(1, polarization);
  return s;
}
inline Spectrum light(const jones::Field& field) {
  const auto s = jones::stokes(field);
  Spectrum all;
  all.fill({s[0], s[1], s[2], s[3]});
  return all;
}

/// A half of the sky's light that a polarizer has left, as a field.
inline jones::Field linear(double degrees) {
  const double h = std::sqrt(0.5);
  return {h * std::cos(radians(degrees)), h * std::sin(radians(degrees))};
}

inline double integral(double a, double b, const std::function<double(double)>& f) {
  constexpr int n = 2000;
  double sum = 0;  // Simpson's rule
  for (int i = 0; i <= n; ++i)
    sum += (i == 0 || i == n ? 1 : i % 2 ? 4 : 2) * f(a + (b - a) * i / n);
  return sum * (b - a) / (3 * n);
}

inline const std::string clear = number("sigma_t", 0);
inline const std::string white = number("albedo", 1);

/// Mitsuba's format, of the unit cube.
inline std::string grid_file(const glm::ivec3& size, int channels,
                             const std::vector<float>& values) {
  std::string bytes = "VOL\3";
  const auto add = [&](std::uint32_t w) {
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>(w >> (8 * i) & 255);
  };
  for (const int w : {1, size.x, size.y, size.z, channels}) add(static_cast<std::uint32_t>(w));
  for (const float v : {0.f, 0.f, 0.f, 1.f, 1.f, 1.f}) add(std::bit_cast<std::uint32_t>(v));
  for (const float v : values) add(std::bit_cast<std::uint32_t>(v));
  return bytes;
}

/// From -1 to 1 along all axes.
inline std::string cloud(const std::filesystem::path& file, const std::string& content) {
  return medium("<volume type=\"gridvolume\" name=\"sigma_t\"><string name=\"filename\" value=\"" +
                    file.string() +
                    "\"/><transform name=\"to_world\"><scale value=\"2\"/><translate value=\"-1, "
                    "-1, -1\"/></transform></volume>" +
                    content,
                "id=\"cloud\"", "heterogeneous") +
         box({-1, -1, -1}, {1, 1, 1}, refer("cloud", "interior"));
}

}  // namespace media_test
