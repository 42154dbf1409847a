// SPDX-License-Identifier: MIT
// Published numbers: what a Rayleigh atmosphere sends up and down in sunlight, in I, Q and U, all
// orders of scattering.
//
// Every number is tested by Student's t of the rendering's own batches. A test case calls right
// numbers wrong with a chance below `family_wise_error`, shared by Bonferroni among its numbers.
#include <doctest/doctest.h>

#include "../reference/rayleigh_slabs.hpp"
#include "stokes_agreement.hpp"

using namespace render_test;

namespace {

constexpr std::size_t batches = 64;

/// A layer of thickness 1, as wide as if it had no end: light that gets to the sides would have to
/// leave at less than 0.2 degrees from the horizontal.
struct Atmosphere {
  std::string extinction;  ///< a value, or one a channel
  double depolarization = 0, albedo = 0;
};
/// Sunlight that comes from the azimuth 180 degrees, and what leaves by one direction.
struct Sunlight {
  double irradiance, sun_cosine;
  bool leaves_top;
  double cosine, azimuth;
};

/// A row of a table in Malus's conventions.
struct Row {
  Atmosphere atmosphere;
  Sunlight light;
  glm::dvec3 stokes;
};

Row row(const reference::NatrajRow& r) {
  return {{std::to_string(reference::natraj_depth), 0, r.albedo},
          {pi, r.sun_cosine, r.leaves_top, r.cosine, r.azimuth},
          {r.i, -r.q, r.u}};
}
Row row(const reference::IprtRow& r) {
  return {{std::to_string(reference::iprt_depth), r.depolarization, 0},
          {1, std::cos(radians(r.sza)), r.altitude > 0, std::abs(std::cos(radians(r.vza))),
           r.vaa - r.saa},
          {r.i, r.q, r.u}};
}

constexpr double half_width = 400;

std::string layer(const Atmosphere& a) {
  const std::string wide = std::to_string(half_width);
  return "<shape type=\"cube\"><transform name=\"to_world\"><scale x=\"" + wide + "\" y=\"" + wide +
         "\" z=\"0.5\"/><translate z=\"0.5\"/></transform>" + bsdf("null") +
         "<medium type=\"homogeneous\" name=\"interior\"><rgb name=\"sigma_t\" value=\"" +
         a.extinction + "\"/>" + number("albedo", 1) + "<phase type=\"rayleigh\">" +
         number("depolarization", a.depolarization) + "</phase></medium></shape>\n" +
         square({0, 0, -0.01}, {0, 0, 1}, half_width,
                bsdf("diffuse", number("reflectance", a.albedo)), {0, 1, 0});
}

/// The light propagates along k = (sin θ cos φ, sin θ sin φ, cos θ). Its frame is x = ∂k/∂θ, y =
/// ∂k/∂φ / sin θ = k × x. The meter looks along −k, and the picture's right × up is k: with x to
/// the right, up is k × x, which is y. S1 and S2 are the tables' Q (or −Q) and U without more.
std::string sunlight(const Sunlight& l) {
  const double cosine = l.leaves_top ? l.cosine : -l.cosine;
  const double sine = std::sqrt(1 - cosine * cosine),
               sun = std::sqrt(1 - l.sun_cosine * l.sun_cosine);
  const double c = std::cos(radians(l.azimuth)), s = std::sin(radians(l.azimuth));
  const glm::dvec3 k(sine * c, sine * s, cosine), x(cosine * c, cosine * s, -sine);
  const glm::dvec3 origin(0, 0, l.leaves_top ? 1.005 : -0.005);
  return meter(origin, origin - k, x) +
         "<emitter type=\"directional\"><vector name=\"direction\" value=\"" +
         text({sun, 0, -l.sun_cosine}) + "\"/>" + number("irradiance", l.irradiance) +
         "</emitter>\n";
}

Reading render(const renderer::Scene& scene, std::uint64_t samples, std::uint64_t seed) {
  const std::atomic<bool> stop{false};
  renderer::RenderOptions options;
  options.samples_per_pixel = samples;
  options.seed = seed;
  options.threads = 2;
  options.batches = batches;
  return reading(renderer::render(scene, options, stop, {}));
}

/// As many samples as make the standard error of I its `precision`, by what a few others say.
Reading measure(const Row& r, const std::string& integrator, double precision, std::uint64_t seed) {
  const auto scene =
      build("<integrator type=\"" + integrator + "\"/>" + sunlight(r.light) + layer(r.atmosphere));
  constexpr double few = 1 << 15;
  const double error = render(scene, static_cast<std::uint64_t>(few), 1000 + seed).error.x;
  const double samples = few * std::pow(1.1 * error / (precision * r.stokes.x), 2);
  return render(scene, static_cast<std::uint64_t>(std::clamp(samples, few, 1e7)), seed);
}

/// By how many standard errors I, Q and U differ.
glm::dvec3 deviation(const Reading& r, const glm::dvec3& expected) {
  return (glm::dvec3(r.stokes) - expected) / glm::dvec3(r.error);
}

/// One row, of a test case of so many.
void check(const Row& row, const Reading& r, std::size_t rows, double precision) {
  CAPTURE(row.atmosphere.extinction);
  CAPTURE(row.atmosphere.depolarization);
  CAPTURE(row.atmosphere.albedo);
  CAPTURE(row.light.sun_cosine);
  CAPTURE(row.light.leaves_top);
  CAPTURE(row.light.cosine);
  CAPTURE(row.light.azimuth);
  // The number of samples is a guess.
  CHECK(r.error.x < 1.2 * precision * row.stokes.x);
  const glm::dvec3 z = deviation(r, row.stokes);
  for (int i = 0; i < 3; ++i) {
    CAPTURE(i);
    CAPTURE(row.stokes[i]);
    CAPTURE(r.stokes[i]);
    CAPTURE(z[i]);
    CHECK(agreement::student_tail(z[i], batches - 1) >
          agreement::family_wise_error / static_cast<double>(3 * rows));
  }
  // Linear light stays linear.
  CHECK(std::abs(r.stokes.w) < 1e-9);
}

constexpr double finest = 0.002 / 1.2;

template <class Table>
void check_table(const Table& table) {
  std::uint64_t seed = 1;
  for (const auto& r : table)
    check(row(r), measure(row(r), "path", finest, ++seed), std::size(table), finest);
}

}  // namespace

TEST_CASE("slab: Natraj, Li and Yung's tables of an atmosphere over grey ground") {
  check_table(reference::natraj_rows);
}

TEST_CASE("slab: IPRT's case A1, molecules that depolarise") { check_table(reference::iprt_rows); }

TEST_CASE("slab: the same by bidirectional path tracing") {
  constexpr std::size_t rows = 4;
  constexpr double precision = 0.005;
  std::uint64_t seed = 1;
  for (const std::size_t k : {1u, 9u})
    check(row(reference::natraj_rows[k]),
          measure(row(reference::natraj_rows[k]), "bdpt", precision, ++seed), rows, precision);
  for (const std::size_t k : {6u, 9u})
    check(row(reference::iprt_rows[k]),
          measure(row(reference::iprt_rows[k]), "bdpt", precision, ++seed), rows, precision);
}

TEST_CASE("slab: the same in one channel, whatever the air is to the others") {
  constexpr double precision = 0.005;
  std::uint64_t seed = 1;
  for (const std::string others : {", 4, 0.05", ", 0.05, 1"}) {
    Row r = row(reference::natraj_rows[9]);
    r.atmosphere.extinction += others;
    check(r, measure(r, "path", precision, ++seed), 2, precision);
  }
}
