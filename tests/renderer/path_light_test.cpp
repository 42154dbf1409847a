// SPDX-License-Identifier: MIT
// Direct light, its weights and limits: known irradiances, light through sheets in the light's
// order, furnaces.
#include <doctest/doctest.h>

#include <limits>

#include "integrators/visibility.hpp"
#include "render_scenes.hpp"

using namespace render_test;

namespace {

const std::string floor_of_08 =
    square({0, 0, 0}, {0, 0, 1}, 50, bsdf("diffuse", number("reflectance", 0.8)));
const std::string eye = meter({0, -4, 4}, {0, 0, 0}, {1, 0, 0});
/// Below any sheets.
const std::string low_eye = meter({0, -4, 0.3}, {0, 0, 0}, {1, 0, 0});

/// A sheet above the origin, its front up and its u along +x.
std::string sheet(double z, const std::string& content, double size = 0.5) {
  return "<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"" +
         std::to_string(size) + "\"/><translate z=\"" + std::to_string(z) + "\"/></transform>" +
         content + "</shape>";
}

const std::string lamp =
    square({0, 0, 3}, {0, 0, 0}, 2,
           bsdf("diffuse", number("reflectance", 0)) + "<emitter type=\"area\">" +
               number("radiance", 2) + "</emitter>");

/// |a - b| in standard errors of both.
double deviation(const Reading& a, const Reading& b, int i = 0) {
  return std::abs(a.stokes[i] - b.stokes[i]) / std::hypot(a.error[i], b.error[i]);
}

}  // namespace

TEST_CASE("light: a shadow ray meets sheets in the light's order") {
  const std::string point = "<emitter type=\"point\"><point name=\"position\" value=\"0, 0, 3\"/>" +
                            number("intensity", 9) + "</emitter>";
  // rho/pi I/d^2 without sheets.
  const double full = 0.8 / pi;
  const auto read = [&](const std::string& s) {
    return read_meter(eye + floor_of_08 + point + s).stokes;
  };
  CHECK(render_test::difference(read(""), {full, 0, 0, 0}) < 1e-5);

  const std::string left = "<boolean name=\"left_handed\" value=\"true\"/>";
  for (const double theta : {20.0, 70.0, 100.0})
    for (const double axis : {65.0, 10.0}) {
      CAPTURE(theta);
      CAPTURE(axis);
      const std::string polarizer = bsdf("polarizer", number("theta", theta));
      const std::string retarder = bsdf("retarder", number("theta", axis) + number("delta", 70));
      // The sheets' fronts are up: their angles turn as seen from above, clockwise of the
      // polarizer, and counter-clockwise of the retarder. The receiver, below, sees the opposite:
      // light at +theta, a fast axis at -axis from the common u.
      const double a = radians(theta), f = radians(-axis), d = radians(70);
      const double s3 = -std::sin(2 * (a - f)) * std::sin(d);
      const auto through = [&](const std::string& third) {
        return full / 2 * (1 + (third.empty() ? s3 : -s3)) / 2;
      };
      // Through the retarder of fast axis f, light at a gains S3 = sin 2(f - a) sin d.
      CHECK(read(sheet(2, polarizer) + sheet(1.5, retarder) + sheet(1, bsdf("circular"))).x ==
            doctest::Approx(through("")).epsilon(1e-4));
      CHECK(read(sheet(2, polarizer) + sheet(1.5, retarder) + sheet(1, bsdf("circular", left))).x ==
            doctest::Approx(through(left)).epsilon(1e-4));
      // The other way round circular light meets the retarder first: S2 of S3 by it, at 45 degrees
      // to its axis.
      const double passed = full / 2 * (1 + std::sin(2 * (a - f)) * std::sin(d) * -1) / 2;
      CHECK(read(sheet(1, polarizer) + sheet(1.5, retarder) + sheet(2, bsdf("circular"))).x ==
            doctest::Approx(full / 2 - passed).epsilon(1e-4));
    }
}

TEST_CASE(
    "light: sheets between a lamp and a floor act alike on shadow rays and on paths that find the "
    "lamp") {
  const std::string sheets = sheet(2, bsdf("polarizer", number("theta", 20)), 9) +
                             sheet(1, bsdf("polarizer", number("theta", 50)), 9) +
                             sheet(1.5, bsdf("null"), 9);
  const Reading both = read_meter(low_eye + floor_of_08 + lamp + sheets, 1 << 16);
  // Glass of index 1 does nothing but stop shadow rays: all light is then found by the BSDF's
  // directions.
  const std::string cover =
      sheet(0.5, bsdf("dielectric", number("int_ior", 1) + number("ext_ior", 1)), 50);
  const Reading found = read_meter(low_eye + floor_of_08 + lamp + sheets + cover, 1 << 18);
  CHECK(both.error.x < found.error.x);
  CHECK(found.error.x < 0.01 * found.stokes.x);
  CHECK(deviation(both, found) < 4);  // 6 in 10^5 seeds would fail
}

TEST_CASE("light: between points of one masked plane a shadow ray comes to its end") {
  // Which side of it the other point is on is rounding, wherever the plane is.
  const std::string mask = "<bsdf type=\"mask\">" + number("opacity", 0.3) +
                           bsdf("twosided", bsdf("diffuse")) + "</bsdf>";
  renderer::Sampler sampler(11, 0, 0);
  const auto within = [&] { return 2 * sampler.next_1d() - 1; };
  for (int plane = 0; plane < 8; ++plane) {
    const float a = within(), b = within(), c = within();
    const renderer::Scene scene = build(eye + square({2 * a, 3 * b, 5 * c}, {b, c, a}, 1, mask));
    renderer::Counters counters;
    renderer::Visibility<malus::Unpolarized<renderer::Rgb>, renderer::NoMedia> visibility(scene,
                                                                                          counters);
    const auto point = [&] {
      const renderer::Vec3 center(2 * a, 3 * b, 5 * c),
          normal = glm::normalize(renderer::Vec3(b, c, a) - center);
      const renderer::Basis basis(normal);
      const renderer::Vec3 off = center + 0.6f * (within() * basis.s + within() * basis.t) + normal;
      renderer::Hit hit;
      REQUIRE(scene.intersect({off, -normal}, hit));
      return hit;
    };
    for (int i = 0; i < 4000; ++i) {
      const renderer::Hit from = point(), to = point();
      const renderer::Vec3 way = renderer::normalized(to.position - from.position);
      // As two vertices are connected, and as a vertex is to a lamp in the plane.
      for (const renderer::Ray& ray : {from.leave_for(to, way), from.leave_for(to.position, way)}) {
        REQUIRE(visibility.open(ray, from.position, to.position, std::numeric_limits<int>::max(),
                                {}, sampler));
        CHECK(visibility.passed() <= 1);
      }
    }
  }
}

TEST_CASE("light: a length limit cuts both strategies at the same number of vertices") {
  const std::string sheets = sheet(2, bsdf("polarizer"), 9) + sheet(1, bsdf("null"), 9);
  // Eye, floor, two sheets, lamp: four vertices after the eye.
  const Reading all = read_meter(integrator(-1) + low_eye + floor_of_08 + lamp + sheets, 1 << 14);
  const Reading four = read_meter(integrator(4) + low_eye + floor_of_08 + lamp + sheets, 1 << 14);
  const Reading three = read_meter(integrator(3) + low_eye + floor_of_08 + lamp + sheets, 1 << 14);
  CHECK(all.stokes.x > 0.05);
  CHECK(deviation(all, four) < 4);
  CHECK(three.stokes.x == 0);
  // Mitsuba's volpath counts surfaces that scatter alone: the floor and the lamp.
  const std::string volpath =
      "<integrator type=\"volpath\"><integer name=\"max_depth\" value=\"2\"/></integrator>";
  CHECK(deviation(all, read_meter(volpath + low_eye + floor_of_08 + lamp + sheets, 1 << 14)) < 4);
  CHECK(read_meter(integrator(1) + low_eye + floor_of_08 + lamp).stokes.x == 0);
  CHECK(deviation(read_meter(integrator(2) + low_eye + floor_of_08 + lamp, 1 << 14),
                  read_meter(integrator(-1) + low_eye + floor_of_08 + lamp, 1 << 14)) < 4);
  CHECK(read_meter(integrator(1) + eye + sky).stokes.x == 1);
}

TEST_CASE("light: a sphere gives the irradiance pi L (r/d)^2 cos, whatever its distance") {
  for (const glm::dvec3 center : {glm::dvec3{0, 0, 2}, {0.5, 0.5, 0.56}, {2, 0, 3}})
    for (const double radius : {0.05, 0.5}) {
      CAPTURE(center.z);
      CAPTURE(radius);
      const double d2 = glm::dot(center, center);
      const double expected = 0.8 * 20 * radius * radius / d2 * center.z / std::sqrt(d2);
      const std::string sphere = "<shape type=\"sphere\"><point name=\"center\" value=\"" +
                                 text(center) + "\"/>" + number("radius", radius) +
                                 "<emitter type=\"area\">" + number("radiance", 20) +
                                 "</emitter></shape>";
      const Reading r = read_meter(integrator(2) + eye + floor_of_08 + sphere, 1 << 16);
      CHECK(r.error.x < 0.003 * expected);
      // Six comparisons at 4 standard errors: 4 in 10^4 sets of seeds would fail.
      CHECK(std::abs(r.stokes.x - expected) < 4 * r.error.x);
    }
}

TEST_CASE("light: a floor under a sphere of light, within it, is lit from everywhere") {
  const std::string inside =
      "<shape type=\"sphere\"><float name=\"radius\" value=\"20\"/><boolean "
      "name=\"flip_normals\" value=\"true\"/><emitter type=\"area\">" +
      number("radiance", 1) + "</emitter></shape>";
  const std::string small_floor =
      square({0, 0, 0}, {0, 0, 1}, 1, bsdf("diffuse", number("reflectance", 0.8)));
  const Reading r = read_meter(eye + small_floor + inside, 1 << 14);
  CHECK(r.error.x < 0.01);
  CHECK(std::abs(r.stokes.x - 0.8) < 4 * r.error.x);
}

TEST_CASE("light: directional and point lights give the irradiance they say") {
  const std::string directional =
      "<emitter type=\"directional\"><vector name=\"direction\" value=\"1, 0, -1\"/>" +
      number("irradiance", 2) + "</emitter>";
  CHECK(read_meter(eye + floor_of_08 + directional).stokes.x ==
        doctest::Approx(0.8 / pi * 2 * std::sqrt(0.5)).epsilon(1e-5));
  // Without a direction, along the transform's z: the same.
  const std::string turned =
      "<emitter type=\"directional\"><transform name=\"to_world\"><rotate y=\"1\" "
      "angle=\"135\"/><scale value=\"3\"/></transform>" +
      number("irradiance", 2) + "</emitter>";
  CHECK(read_meter(eye + floor_of_08 + turned).stokes.x ==
        doctest::Approx(0.8 / pi * 2 * std::sqrt(0.5)).epsilon(1e-5));
  const std::string point = "<emitter type=\"point\"><point name=\"position\" value=\"3, 0, 4\"/>" +
                            number("intensity", 5) + "</emitter>";
  CHECK(read_meter(eye + floor_of_08 + point).stokes.x ==
        doctest::Approx(0.8 / pi * 5 / 25 * 0.8).epsilon(1e-5));
}

TEST_CASE("light: a shape that emits and names no BSDF is black, any other is half grey") {
  const std::string shape =
      "<shape type=\"rectangle\"><transform name=\"to_world\"><rotate x=\"1\" "
      "angle=\"90\"/></transform>";
  const std::string begin = meter({0, -4, 0}, {0, 0, 0}, {1, 0, 0}) + sky + shape;
  CHECK(read_meter(begin + "<emitter type=\"area\">" + number("radiance", 3) + "</emitter></shape>")
            .stokes.x == doctest::Approx(3));
  const Reading grey = read_meter(begin + "</shape>", 1 << 12);
  CHECK(std::abs(grey.stokes.x - 0.5) < 4 * grey.error.x);
}

TEST_CASE("light: a furnace of white, glass and perfect mirrors stays 1 and unpolarised") {
  const auto scene = example("furnace.xml", {{"resolution", "16"}});
  const Rendering rendering = render(scene, 512);
  const double batches = static_cast<double>(rendering.film.batches());
  glm::dvec4 squares(0), sum(0), variance(0);
  int counts[4] = {0, 0, 0, 0};
  for (std::size_t p = 0; p < 256; ++p) {
    const Reading r = reading(rendering, p);
    const glm::dvec4 d = r.stokes - glm::dvec4(1, 0, 0, 0);
    CAPTURE(p);
    for (int i = 0; i < 4; ++i) {
      sum[i] += d[i];
      variance[i] += r.error[i] * r.error[i];
      if (r.error[i] < 1e-5) {
        CHECK(std::abs(d[i]) < 1e-3);
        continue;
      }
      squares[i] += d[i] * d[i] / (r.error[i] * r.error[i]);
      ++counts[i];
    }
  }
  for (int i = 0; i < 4; ++i) {
    CAPTURE(i);
    // The picture's mean: 3 in 10^4 seeds would fail one of four.
    CHECK(std::abs(sum[i]) < 4 * std::sqrt(variance[i]) + 256 * 1e-5);
    if (counts[i] < 16) continue;
    // Student's t of `batches` batches has the variance (b - 1)/(b - 3); the bound is five standard
    // deviations away, for the heavy tails of few samples' errors.
    const double expected = (batches - 1) / (batches - 3);
    CHECK(squares[i] / counts[i] < expected * (1 + 5 * std::sqrt(3.0 / counts[i])));
  }
  CHECK(counts[0] > 60);
}
