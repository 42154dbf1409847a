// SPDX-License-Identifier: MIT
// Pictures whose answers are known: sheets, mirrors and glass in the way of a radiancemeter's ray.
#include <doctest/doctest.h>

#include <vector>

#include "../reference/fresnel_mirrors.hpp"
#include "../reference/fresnel_special_cases.hpp"
#include "render_scenes.hpp"

using namespace render_test;

namespace {

using Matrix = glm::dmat4;  // by columns, as GLM's are
const glm::dvec3 y_axis{0, 1, 0}, z_axis{0, 0, 1};

/// A sheet in the way of light from the sky to a point, and what else is in the way behind it.
std::string sheets(const glm::dvec3& point, const glm::dvec3& from,
                   const std::vector<std::string>& bsdfs) {
  std::string scene;
  double distance = 2;
  for (const std::string& b : bsdfs) {
    scene += square(point + distance * from, point, 0.3, b);
    distance -= 0.25;
  }
  return scene;
}

/// Sheets that make four linearly independent states of the sky's light, the farthest sheet first.
const std::vector<std::vector<std::string>> states = {
    {bsdf("polarizer", number("theta", 10))},
    {bsdf("polarizer", number("theta", 70))},
    {bsdf("polarizer", number("theta", 130))},
    {bsdf("circular")},
};

std::string dielectric(double n) {
  return bsdf("dielectric", number("int_ior", n) + number("ext_ior", 1));
}

/// The Mueller matrix of a surface z = 0 in frames with x along s = +y, from readings of the light
/// that arrives and of the light that is reflected.
Matrix measured_mirror(const std::string& surface, double degrees) {
  const double a = radians(degrees);
  const glm::dvec3 out(-std::sin(a), 0, std::cos(a)), in(std::sin(a), 0, std::cos(a));
  Matrix incident(0), reflected(0);
  for (int i = 0; i < 4; ++i) {
    const std::string light = sheets({0, 0, 0}, in, states[static_cast<std::size_t>(i)]) + sky;
    incident[i] = read_meter(meter({0, 0, 0}, in, y_axis) + light).stokes;
    reflected[i] = read_meter(meter(4.0 * out, {0, 0, 0}, y_axis) + surface + light).stokes;
  }
  return reflected * glm::inverse(incident);
}

/// By rows: the upper and the lower block of a mirror-symmetric matrix.
Matrix block(double m00, double m01, double m22, double m23) {
  return glm::transpose(
      Matrix{{m00, m01, 0, 0}, {m01, m00, 0, 0}, {0, 0, m22, m23}, {0, 0, -m23, m22}});
}

double difference(const Matrix& a, const Matrix& b) {
  double most = 0;
  for (int i = 0; i < 4; ++i) most = std::max(most, render_test::difference(a[i], b[i]));
  return most;
}

std::string conductor(const reference::Mirror& mirror) {
  return bsdf("conductor", number("eta", mirror.n) + number("k", mirror.k));
}
/// The reference's matrix, whose S3 has the other sign.
Matrix expected_mirror(const reference::MirrorRow& row) {
  return block(row.m00, row.m01, row.m22, -row.m23);
}

Matrix rotation(double a) {
  const double c = std::cos(2 * a), s = std::sin(2 * a);
  return glm::transpose(Matrix{{1, 0, 0, 0}, {0, c, s, 0}, {0, -s, c, 0}, {0, 0, 0, 1}});
}

}  // namespace

TEST_CASE("optics: Malus's law, and that a polarizer's angle turns clockwise") {
  for (const double degrees : {0.0, 15.0, 30.0, 45.0, 60.0, 90.0, 137.0, -20.0}) {
    CAPTURE(degrees);
    const auto scene = example("malus_law.xml", {{"angle", std::to_string(degrees)}});
    const Reading r = reading(render(scene, 64));
    const double a = radians(degrees), s0 = std::cos(a) * std::cos(a) / 2;
    CHECK(render_test::difference(r.stokes, {s0, s0 * std::cos(2 * a), -s0 * std::sin(2 * a), 0}) <
          1e-6);
    CHECK(r.error.x < 1e-7);
  }
}

TEST_CASE("optics: Fresnel reflection at glass, and Brewster's angle") {
  constexpr std::uint64_t samples = 1 << 16;
  for (const double degrees : {0.0, 30.0, 56.309932474020215, 75.0}) {
    CAPTURE(degrees);
    const double c = std::cos(radians(degrees)), s = std::sin(radians(degrees));
    const double q = std::sqrt(1.5 * 1.5 - s * s);
    const double rs = std::pow((c - q) / (c + q), 2);
    const double rp = std::pow((2.25 * c - q) / (2.25 * c + q), 2);
    const auto scene = example("brewster.xml", {{"angle", std::to_string(degrees)}});
    const Reading r = reading(render(scene, samples));
    const double s0 = (rs + rp) / 2, s1 = (rs - rp) / 2;
    // Three standard errors: 3 in 1000 seeds would fail one of these.
    CHECK(std::abs(r.stokes.x - s0) < 3 * r.error.x);
    CHECK(std::abs(r.stokes.y - s1) < 3 * r.error.y + 1e-7);
    CHECK(std::abs(r.stokes.z) < 1e-6);
    CHECK(std::abs(r.stokes.w) < 1e-6);
    // A sample reflects with the chance S0 and then reads 1: a binomial's error.
    const double error = std::sqrt(s0 * (1 - s0) / samples);
    CHECK(r.error.x > 0.6 * error);
    CHECK(r.error.x < 1.4 * error);
  }
  const Reading r = reading(render(example("brewster.xml"), samples));
  CHECK(r.stokes.y == doctest::Approx(r.stokes.x).epsilon(1e-5));
  CHECK(std::abs(r.stokes.x - reference::brewster_reflection) < 3 * r.error.x);
}

TEST_CASE("optics: a third polarizer between crossed ones lets an eighth of sin(2a)^2 through") {
  constexpr int resolution = 64;
  for (const double degrees : {45.0, 20.0}) {
    CAPTURE(degrees);
    const auto scene =
        example("crossed_polarizers.xml",
                {{"angle", std::to_string(degrees)}, {"resolution", std::to_string(resolution)}});
    const Rendering rendering = render(scene, 4);
    const double half_width = 20 * std::tan(radians(5.5));
    const auto at = [&](double x, double z) {
      const auto column = static_cast<std::size_t>((x / half_width + 1) / 2 * resolution);
      const auto row = static_cast<std::size_t>((1 - z / half_width) / 2 * resolution);
      return reading(rendering, row * resolution + column).stokes.x;
    };
    const double c2 = std::pow(std::cos(radians(degrees)), 2), s2 = 1 - c2;
    CHECK(at(1.6, 1.6) == doctest::Approx(1));
    CHECK(at(-1, 0.8) == doctest::Approx(0.5));
    CHECK(at(1, -0.8) == doctest::Approx(0.5));
    CHECK(std::abs(at(0, 0.7)) < 1e-4);
    CHECK(at(-1, 0) == doctest::Approx(c2 / 2).epsilon(0.01));
    CHECK(at(1, 0) == doctest::Approx(s2 / 2).epsilon(0.01));
    CHECK(at(0, 0) == doctest::Approx(c2 * s2 / 2).epsilon(0.01));
  }
}

TEST_CASE("optics: a mirror shows Fresnel's matrix") {
  for (const auto& mirror : reference::fresnel_mirrors) {
    if (mirror.k == 0) continue;
    CAPTURE(mirror.material);
    for (const int i : {2, 4, 6, 8}) {
      const reference::MirrorRow& row = mirror.rows[i];
      CAPTURE(row.theta_degrees);
      const std::string surface = square({0, 0, 0}, z_axis, 1, conductor(mirror));
      CHECK(difference(measured_mirror(surface, row.theta_degrees), expected_mirror(row)) < 2e-5);
    }
  }
}

TEST_CASE(
    "optics: a twosided mirror is the same mirror from behind, and a plain one is black there") {
  const auto& gold = reference::fresnel_mirrors[0];
  const std::string both = bsdf("twosided", conductor(gold));
  const std::string behind = square({0, 0, 0}, -z_axis, 1, both);
  CHECK(difference(measured_mirror(behind, 60), expected_mirror(gold.rows[4])) < 2e-5);
  CHECK(difference(measured_mirror(square({0, 0, 0}, -z_axis, 1, conductor(gold)), 60), Matrix(0)) <
        1e-7);
}

TEST_CASE("optics: total internal reflection retards by the known phase") {
  for (const auto& known : reference::total_reflection_phases) {
    CAPTURE(known.source);
    // The square's inner side is up.
    const std::string surface = square({0, 0, 0}, -z_axis, 1, dielectric(known.n));
    const double phase = radians(known.phase_degrees);
    // In amplitudes exp(-iwt) r_p lags behind r_s: light at +45 degrees gains right circularity.
    CHECK(difference(measured_mirror(surface, known.theta_degrees),
                     block(1, 0, std::cos(phase), -std::sin(phase))) < 1e-4);
  }
}

TEST_CASE("optics: two mirrors act in the light's order, their planes of incidence turned") {
  const auto& gold = reference::fresnel_mirrors[0];
  const auto& aluminium = reference::fresnel_mirrors[1];
  const std::vector<std::string> light = {
      bsdf("polarizer", number("theta", 25)),
      bsdf("retarder", number("theta", 50) + number("delta", 70))};
  for (const double degrees : {30.0, 90.0, 200.0}) {
    CAPTURE(degrees);
    const double phi = radians(degrees);
    const glm::dvec3 second(0, 0, 2), out(std::cos(phi), std::sin(phi), 0);
    const glm::dvec3 s2(-std::sin(phi), std::cos(phi), 0);
    const std::string source = sheets(second, out, light) + sky;
    const glm::dvec4 in = read_meter(meter(second, second + out, s2) + source).stokes;
    // The meter's ray goes along +x, up, then along `out`; both mirrors are met at 45 degrees.
    const std::string mirrors = square({0, 0, 0}, {-1, 0, 1}, 0.4, conductor(gold)) +
                                square(second, second + out - z_axis, 0.4, conductor(aluminium));
    const glm::dvec4 read =
        read_meter(meter({-3, 0, 0}, {0, 0, 0}, y_axis) + mirrors + source).stokes;
    const glm::dvec4 expected =
        expected_mirror(gold.rows[3]) * rotation(phi) * expected_mirror(aluminium.rows[3]) * in;
    CHECK(render_test::difference(read, expected) < 2e-5);
  }
}

TEST_CASE("optics: polarizer and retarder give the known ellipse, from the front and from behind") {
  // Both sheets' u is the meter's right, their fronts face it.
  const auto sheet = [](double y, const std::string& content, bool behind = false) {
    return "<shape type=\"rectangle\"><transform name=\"to_world\"><rotate x=\"1\" angle=\"90\"/>" +
           std::string(behind ? "<rotate z=\"1\" angle=\"180\"/>" : "") + "<translate y=\"" +
           std::to_string(y) + "\"/></transform>" + content + "</shape>";
  };
  const std::string begin =
      meter({0, -4, 0}, {0, 0, 0}, {1, 0, 0}) + sky + sheet(1, bsdf("polarizer"));
  for (const double degrees : {0.0, 30.0, 45.0, 100.0})
    for (const double delta : {50.0, 90.0, 180.0, 270.0}) {
      CAPTURE(degrees);
      CAPTURE(delta);
      const std::string retarder =
          bsdf("retarder", number("theta", degrees) + number("delta", delta));
      const double s = std::sin(radians(2 * degrees)), c = std::cos(radians(2 * degrees));
      const double d = radians(delta);
      const glm::dvec4 expected(0.5, 0.5 * (c * c + s * s * std::cos(d)),
                                0.5 * s * c * (1 - std::cos(d)), 0.5 * s * std::sin(d));
      CHECK(render_test::difference(read_meter(begin + sheet(0, retarder)).stokes, expected) <
            1e-6);
      // Turned about the vertical, its axis is at the opposite angle.
      const glm::dvec4 mirrored(expected.x, expected.y, -expected.z, -expected.w);
      CHECK(render_test::difference(read_meter(begin + sheet(0, retarder, true)).stokes, mirrored) <
            1e-6);
    }
}

TEST_CASE("optics: circular polarizers pass half of the sky's light, right or left circular") {
  const std::string begin = meter({0, -4, 0}, {0, 0, 0}, {1, 0, 0}) + sky;
  const auto read = [&](const std::string& b) {
    return read_meter(begin + square({0, 0, 0}, {0, -1, 0}, 1, b)).stokes;
  };
  CHECK(render_test::difference(read(bsdf("circular")), {0.5, 0, 0, 0.5}) < 1e-6);
  CHECK(render_test::difference(
            read(bsdf("circular", "<boolean name=\"left_handed\" value=\"true\"/>")),
            {0.5, 0, 0, -0.5}) < 1e-6);
  CHECK(render_test::difference(read(bsdf("circular", number("transmittance", 0.3))),
                                {0.15, 0, 0, 0.15}) < 1e-6);
}

TEST_CASE("optics: a tilted polarizer passes the field across its projected absorption axis") {
  const glm::dvec3 right(1, 0, 0);
  for (const double theta : {0.0, 30.0, 110.0})
    for (const glm::dvec3 normal :
         {glm::dvec3{0.5, -1, 0}, {0, -1, 1.2}, {2, -1, -1}, {-0.3, 1, 0.4}}) {
      CAPTURE(theta);
      const glm::dvec3 n = glm::normalize(normal);
      // lookat: y is "up" made perpendicular, x is y cross z.
      const glm::dvec3 up(0.3, 1, 0.2), x = glm::normalize(glm::cross(up, n)), y = glm::cross(n, x);
      // Clockwise from x is what passes at normal incidence; across it, what is absorbed.
      const double a = radians(-theta);
      const glm::dvec3 absorbed = -std::sin(a) * x + std::cos(a) * y;
      const glm::dvec3 light(0, -1, 0);
      const glm::dvec3 field = glm::normalize(glm::cross(light, absorbed));
      // The picture's right is +x and its up +z.
      const double fx = field.x, fy = field.z;
      const glm::dvec4 read =
          read_meter(meter({0, -4, 0}, {0, 0, 0}, right) + sky +
                     square({0, 0, 0}, n, 2, bsdf("polarizer", number("theta", theta)), up))
              .stokes;
      CHECK(render_test::difference(read, {0.5, 0.5 * (fx * fx - fy * fy), fx * fy, 0}) < 1e-5);
    }
}

TEST_CASE("optics: a retarder changes continuously with the direction it is seen from") {
  const auto seen = [](double a) {
    // A cone of directions 50 degrees off the normal.
    const glm::dvec3 d(std::sin(radians(50)) * std::cos(a), -std::cos(radians(50)),
                       std::sin(radians(50)) * std::sin(a));
    const glm::dvec3 right = glm::normalize(glm::cross(-d, {0, 0.2, 1}));
    return read_meter(
               meter(4.0 * d, {0, 0, 0}, right) + sky +
               square({0, 0, 0}, {0, -1, 0}, 3, bsdf("retarder", number("theta", 20)), {0, 0, 1}) +
               square({0, 2, 0}, {0, 1, 0}, 9, bsdf("polarizer", number("theta", 0)), {0, 0, 1}))
        .stokes;
  };
  constexpr int steps = 360;
  glm::dvec4 last = seen(0);
  double most = 0;
  for (int i = 1; i <= steps; ++i) {
    const glm::dvec4 next = seen(radians(i));
    most = std::max(most, render_test::difference(last, next));
    last = next;
  }
  CHECK(most > 1e-3);
  CHECK(most < 0.03);
}

TEST_CASE("optics: a tilted retarder retards by its cosine less") {
  // Turned about its fast axis, which stays the picture's right.
  const auto seen = [](double tilt, double delta) {
    const double t = radians(tilt);
    return read_meter(
               meter({0, -4, 0}, {0, 0, 0}, {1, 0, 0}) + sky +
               square({0, 0, 0}, {0, -std::cos(t), std::sin(t)}, 3,
                      bsdf("retarder", number("delta", delta)), {0, std::sin(t), std::cos(t)}) +
               square({0, 9, 0}, {0, 0, 0}, 3, bsdf("polarizer", number("theta", 45)), {0, 0, 1}))
        .stokes;
  };
  for (const double tilt : {30.0, 60.0, -45.0}) {
    CAPTURE(tilt);
    const double seen_delta = 90 * std::cos(radians(tilt));
    CHECK(render_test::difference(seen(tilt, 90), seen(0, seen_delta)) < 1e-5);
    CHECK(std::abs(seen(tilt, 90)[3]) ==
          doctest::Approx(0.5 * std::sin(radians(seen_delta))).epsilon(1e-5));
  }
}

TEST_CASE("optics: radiance grows by the square of the index on its way into glass") {
  // No reflection to speak of in the mean: what arrives is (1 - R) n^2.
  const double n = 1.5, r = 0.04;
  const Reading inside = read_meter(
      meter({0, 0, -1}, {0, 0, 0}, y_axis) + sky + square({0, 0, 0}, z_axis, 5, dielectric(n)) +
          square({0, 0, -2}, z_axis, 50, bsdf("diffuse", number("reflectance", 0))),
      1 << 14);
  CHECK(std::abs(inside.stokes.x - (1 - r) * n * n) < 4 * inside.error.x);
  CHECK(inside.error.x < 0.01);
}
