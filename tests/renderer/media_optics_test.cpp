// SPDX-License-Identifier: MIT
// Media whose pictures are known in closed form, through the renderer: what they leave of light,
// what they do to its polarisation, what they emit and scatter, and in which order.
#include <doctest/doctest.h>

#include "media_pictures.hpp"

using namespace media_test;
using agreement::picture;
using renderer::Strategy;
using scene_test::Folder;

TEST_CASE("media optics: of each channel exp(-sigma d) is left, and of nested media the product") {
  // Of 4, the middle 1.5 is something else.
  const auto nested = [](const std::string& outer, const std::string& inner) {
    return medium(outer, "id=\"outer\"") +
           box({-1, -2, -1}, {1.5, 2, 1.2}, refer("outer", "interior")) +
           box({-0.7, -0.5, -0.6}, {0.5, 1, 0.4}, medium(inner) + refer("outer", "exterior"));
  };
  const auto left = [](double from) {
    Spectrum s;
    const double a[] = {0.1, 0.5, 1}, b[] = {2, 0, 0.3};
    for (std::size_t c = 0; c < 3; ++c)
      s[c] = {std::exp(-a[c] * (2.5 - from) - b[c] * 1.5), 0, 0, 0};
    return s;
  };
  const std::string absorbing = nested(rgb("sigma_a", "0.1, 0.5, 1") + number("sigma_s", 0),
                                       rgb("sigma_a", "2, 0, 0.3") + number("sigma_s", 0));
  check(measure(view() + sky + absorbing), left(0));
  check(measure(view(-1.25, refer("outer")) + sky + absorbing), left(0.75));
  // Paths are drawn where there is scattering, too; those that are scattered are too long to count.
  const std::string scattering = nested(rgb("sigma_t", "0.1, 0.5, 1") + white,
                                        rgb("sigma_a", "1, 0, 0.2") + rgb("sigma_s", "1, 0, 0.1"));
  check(measure(view() + sky + scattering, "path", 1 << 16, 1), left(0), 0.05);
  // However wide it is: no part of it is lost where rays start off the boundary.
  check(measure(view() + sky +
                box({-400, 0, -400}, {400, 1, 400},
                    medium(number("sigma_a", 3) + number("sigma_s", 0)))),
        light({std::exp(-3.0), std::exp(-3.0), std::exp(-3.0)}));
}

TEST_CASE("media optics: a slab's own light, with and without absorption") {
  const std::string glow = rgb("emission", "0.5, 1, 2");
  const double sigma[] = {0, 0.4, 3};
  Spectrum expected;
  for (std::size_t c = 0; c < 3; ++c) {
    const double left = std::exp(-1.5 * sigma[c]), e[] = {0.5, 1, 2};
    expected[c] = {left + e[c] * (sigma[c] > 0 ? (1 - left) / sigma[c] : 1.5), 0, 0, 0};
  }
  const std::string glowing =
      slab(-1, 1.5,
           medium(glow + rgb("sigma_a", "0, 0.4, 3") + number("sigma_s", 0) + number("scale", 1)));
  for (const std::string integrator : {"path", "bdpt"}) {
    CAPTURE(integrator);
    check(measure(view() + sky + glowing, integrator, 1 << 12), expected, 0.02);
  }

  // A thin ball of 1 lights a wall that faces it from 2 by inverse squares, as if from its centre.
  const std::string lit = medium(clear + glow);
  const double from_center = 0.6 / pi * 4 * pi / 3 / 4;
  for (const std::string integrator : {"path", "bdpt"}) {
    CAPTURE(integrator);
    check(
        measure(view(1.5) + ball(lit) +
                    square({0, 2, 0}, {0, 0, 0}, 0.3, bsdf("diffuse", number("reflectance", 0.6))),
                integrator, 1 << 14),
        light({0.5 * from_center, from_center, 2 * from_center}), 0.02);
  }

  // Oriented dye: the light polarised along x loses 2 more by length. Without the sky's.
  const std::string dye =
      slab(-1, 1.5,
           medium(number("emission", 1) + vector("axis", {1, 0, 0}) + number("sigma_a", 0.5) +
                  number("sigma_s", 0) + number("linear_dichroism", 2)));
  const double along = (1 - std::exp(-2.5 * 1.5)) / 2.5, across = (1 - std::exp(-0.5 * 1.5)) / 0.5;
  const double s0 = (across + along) / 2;
  check(measure(view() + dye, "path", 1 << 14),
        light({s0, s0, s0}, {(along - across) / 2 / s0, 0, 0}), 0.01);
}

TEST_CASE("media optics: nothing can be seen in a furnace, whatever scatters") {
  const auto furnace = [](const std::string& sigma_t, const std::string& phase) {
    return view(-3) + sky + ball(medium(rgb("sigma_t", sigma_t) + white + phase));
  };
  for (const auto& p :
       {phase("isotropic"), phase("hg", number("g", 0.9)), phase("hg", number("g", -0.6)),
        phase("rayleigh"), phase("rayleigh", number("depolarization", 0.2)),
        phase("mie", number("radius", 0.4))}) {
    CAPTURE(p);
    // Thin in red and thick in blue: paths are drawn for all channels, and no weight may grow.
    check(measure(furnace("0.3, 2, 8", p), "path", 1 << 14), light({1, 1, 1}), 0.04);
    check(measure(furnace("0.2, 0.7, 1.5", p), "bdpt", 1 << 14), light({1, 1, 1}), 0.04);
  }
  check(measure(furnace("0.2, 0.7, 1.5", phase("rayleigh")), "vcm", 512), light({1, 1, 1}), 0.1);
  // What absorbs as much as it glows, seen from within.
  const std::string kirchhoff = medium(rgb("sigma_a", "2, 0.5, 1") + rgb("emission", "2, 0.5, 1") +
                                           rgb("sigma_s", "0.5, 1, 3") + phase("rayleigh"),
                                       "id=\"fog\"") +
                                view(0.2, refer("fog")) + sky + ball(refer("fog", "interior"));
  for (const std::string integrator : {"path", "bdpt"}) {
    CAPTURE(integrator);
    check(measure(kirchhoff, integrator, 1 << 12), light({1, 1, 1}), 0.02);
  }
}

TEST_CASE("media optics: sugar turns the plane of polarisation clockwise, as Biot's law says") {
  // 30, 60 and -45 degrees by length, 1.5 of it.
  const std::string cuvette = slab(-1, 1.5, medium(clear + rgb("optical_rotation", "30, 60, -45")));
  const double turned[] = {45, 90, -67.5};
  Spectrum expected;
  for (std::size_t c = 0; c < 3; ++c) {
    const double a = radians(2 * (20 - turned[c]));
    expected[c] = {0.5, 0.5 * std::cos(a), 0.5 * std::sin(a), 0};
  }
  check(measure(view() + sky + polarizer(2, 20) + cuvette), expected);
  // Behind a second polarizer, Malus's law from there on.
  for (const double degrees : {-25.0, 65.0, 0.0, 80.0}) {
    CAPTURE(degrees);
    std::array<double, 3> s0;
    for (std::size_t c = 0; c < 3; ++c)
      s0[c] = 0.5 * std::pow(std::cos(radians(20 - turned[c] - degrees)), 2);
    const double a = radians(2 * degrees);
    check(measure(view() + sky + polarizer(2, 20) + cuvette + polarizer(-2, degrees)),
          light(s0, {std::cos(a), std::sin(a), 0}));
  }
}

TEST_CASE("media optics: dichroism polarises across the axis, and against the hand it takes") {
  const auto foil = [](double y, double degrees, double strength, double tilt = 0) {
    const double a = radians(degrees), t = radians(tilt);
    return slab(
        y, 0.5,
        medium(
            number("sigma_a", 0) + number("sigma_s", 0) + number("linear_dichroism", strength) +
            vector("axis", {std::cos(t) * std::cos(a), std::sin(t), std::cos(t) * std::sin(a)})));
  };
  const auto seen = [](double taken, double degrees) {
    const double s0 = (1 + taken) / 2, p = (1 - taken) / (1 + taken), a = radians(2 * degrees);
    return light({s0, s0, s0}, {-p * std::cos(a), -p * std::sin(a), 0});
  };
  check(measure(view() + sky + foil(0, 0, 3)), seen(std::exp(-1.5), 0));
  check(measure(view() + sky + foil(0, 30, 3)), seen(std::exp(-1.5), 30));
  // Seen at an angle to the axis, by the square of its sine.
  check(measure(view() + sky + foil(0, 30, 3, 50)),
        seen(std::exp(-1.5 * std::pow(std::cos(radians(50)), 2)), 30));
  // Thick ones are polarizers.
  for (const double degrees : {0.0, 30.0, 75.0, 90.0}) {
    CAPTURE(degrees);
    const double s0 = std::pow(std::cos(radians(degrees - 10)), 2) / 2, a = radians(2 * degrees);
    check(measure(view() + sky + foil(1, 10, 80) + foil(0, degrees, 80)),
          light({s0, s0, s0}, {-std::cos(a), -std::sin(a), 0}));
  }
  // What right circular light loses more, 1.2, and left circular light less.
  const std::string handed = slab(
      0, 2,
      medium(number("sigma_a", 0.7) + number("sigma_s", 0) + number("circular_dichroism", 1.2)));
  const double s0 = std::exp(-1.4) * std::cosh(1.2);
  check(measure(view() + sky + handed), light({s0, s0, s0}, {0, 0, -std::tanh(1.2)}));
}

namespace {

/// Stretched plastic, whose axis is at so many degrees, counter-clockwise for the receiver, and by
/// how much light along it lags.
struct Plastic {
  double degrees, lag;
  std::string element(double y) const {
    const double a = radians(degrees);
    return slab(y, 0.5,
                medium(clear + number("linear_birefringence", lag / 0.5) +
                       vector("axis", {std::cos(a), 0, std::sin(a)})));
  }
  jones::Matrix matrix() const { return jones::retarder(radians(degrees + 90), radians(lag)); }
};

}  // namespace

TEST_CASE("media optics: birefringence is a retarder whose slow axis is the medium's") {
  // By hand: the fast axis is at -45 degrees from light along x, which is at +45 from it. A
  // quarter wave makes that left circular.
  check(measure(view() + sky + polarizer(2, 0) + Plastic{45, 90}.element(0)),
        light({0.5, 0.5, 0.5}, {0, 0, -1}));
  for (const double lag : {90.0, -60.0, 500.0}) {
    CAPTURE(lag);
    const Plastic p{25, lag};
    check(measure(view() + sky + polarizer(2, 70) + p.element(0)), light(p.matrix() * linear(70)));
  }
  // A sheet with the fast axis there does the same.
  const auto sheet = measure(
      view() + sky + polarizer(2, 70) +
      "<shape type=\"rectangle\"><transform name=\"to_world\"><rotate x=\"1\" angle=\"90\"/>"
      "</transform>" +
      bsdf("retarder", number("theta", 115) + number("delta", 100)) + "</shape>\n");
  check(sheet, light(Plastic{25, 100}.matrix() * linear(70)));

  // Two, in the light's order: they don't commute.
  const Plastic first{0, 80}, second{45, 50};
  check(measure(view() + sky + polarizer(2, 30) + first.element(1) + second.element(0)),
        light(second.matrix() * (first.matrix() * linear(30))));
  check(measure(view() + sky + polarizer(2, 30) + second.element(1) + first.element(0)),
        light(first.matrix() * (second.matrix() * linear(30))));
}

TEST_CASE("media optics: everything at once is what many thin slices of it are") {
  const double angle = 35, tilt = 25, length = 1.4;
  const double a = radians(angle), t = radians(tilt), sin2 = std::pow(std::cos(t), 2);
  const std::string glassy = slab(
      -1, length,
      medium(number("sigma_a", 1) + number("sigma_s", 0) + number("linear_dichroism", 0.8) +
             number("circular_dichroism", 0.5) + number("linear_birefringence", 120) +
             number("optical_rotation", 50) +
             vector("axis", {std::cos(t) * std::cos(a), std::sin(t), std::cos(t) * std::sin(a)})));
  constexpr int slices = 20000;
  const double dz = length / slices;
  const auto along = jones::polarizer(a), across = jones::polarizer(a + pi / 2);
  const auto right = jones::projector({0, 0, 1}), left = jones::projector({0, 0, -1});
  const jones::Matrix slice =
      std::polar(std::exp(-0.4 * sin2 * dz), radians(120) * sin2 * dz) * along + across;
  const jones::Matrix handed =
      jones::Complex(std::exp(-0.125 * dz)) * right + jones::Complex(std::exp(0.125 * dz)) * left;
  const jones::Matrix thin =
      jones::Complex(std::exp(-0.5 * dz)) * (jones::rotator(-radians(50) * dz) * (handed * slice));
  jones::Field field = linear(60);
  for (int i = 0; i < slices; ++i) field = thin * field;
  check(measure(view() + sky + polarizer(2, 60) + glassy), light(field));
}

TEST_CASE("media optics: light paths and camera paths meet a stack in the light's order") {
  // Light comes down along -y through a polarizer and two birefringent layers to a rough mirror,
  // which sends it up to the camera.
  const auto bench = [](const Plastic& first, const Plastic& second) {
    return build(
        "<integrator type=\"volpath\"/><sensor type=\"perspective\"><float name=\"fov\" "
        "value=\"10\"/><transform name=\"to_world\">" +
        look({0, 0, 4}, {0, 0, 0}, {0, 1, 0}) +
        "</transform><film type=\"hdrfilm\"><integer name=\"width\" value=\"8\"/><integer "
        "name=\"height\" value=\"8\"/><rfilter type=\"box\"/></film></sensor>\n" +
        square({0, 0, 0}, {0, 1, 1}, 0.4,
               bsdf("roughconductor",
                    "<string name=\"material\" value=\"Ag\"/>" + number("alpha", 0.3))) +
        first.element(1.6) + second.element(0.9) +
        square({0, 2.5, 0}, {0, 0, 0}, 0.7, bsdf("polarizer", number("theta", 35)), {0, 0, 1}) +
        square({0, 3, 0}, {0, 0, 0}, 0.5,
               "<emitter type=\"area\">" + rgb("radiance", "3, 4, 5") + "</emitter>"));
  };
  const Plastic a{0, 80}, b{45, 60};
  renderer::Scene scene = bench(a, b);
  scene.integrator.max_depth = 2;
  const auto expected = picture(scene, "path", 1024, 1);
  CHECK_AGREE(picture(scene, "ptracer", 1024, 2), expected);
  for (const Strategy strategy : {Strategy{0, 3}, Strategy{1, 2}, Strategy{2, 1}}) {
    CAPTURE(strategy.s);
    scene.integrator.strategy = strategy;
    CHECK_AGREE(picture(scene, "bdpt", 1024, 3), expected);
  }
  renderer::Scene other = bench(b, a);
  other.integrator.max_depth = 2;
  CHECK_DIFFER(picture(other, "path", 1024, 4), expected);
}

TEST_CASE("media optics: camera and lamp in Rayleigh fog, light scattered once, and a wall") {
  const std::string fog =
      medium(rgb("sigma_a", "0.1, 0.3, 0") + rgb("sigma_s", "0.2, 0.5, 1") + phase("rayleigh"),
             "id=\"fog\"");
  const glm::dvec3 lamp(0.8, -1.2, 0.6);
  const std::string scene =
      fog + view(-2, refer("fog")) + "<emitter type=\"point\"><point name=\"position\" value=\"" +
      text(lamp) + "\"/>" + number("intensity", 3) + refer("fog") + "</emitter>" +
      square({0, 0, 0}, {0, -1, 0}, 30, bsdf("diffuse", number("reflectance", 0.4)));
  const double sigma_t[] = {0.3, 0.8, 1}, sigma_s[] = {0.2, 0.5, 1};
  const double distance2 = 1;  // of the lamp from the line of sight
  Spectrum expected;
  for (std::size_t c = 0; c < 3; ++c) {
    const double r = std::sqrt(distance2 + lamp.y * lamp.y);
    const double wall = 0.4 / pi * 3 * (-lamp.y / r) / (r * r) * std::exp(-sigma_t[c] * (2 + r));
    const auto scattered = [&](double t, double sign) {
      const double y = -2 + t - lamp.y, r2 = distance2 + y * y;  // light goes on along -y
      const double cosine2 = y * y / r2;
      return sigma_s[c] * 3 / (16 * pi) * (1 + sign * cosine2) * 3 / r2 *
             std::exp(-sigma_t[c] * (t + std::sqrt(r2)));
    };
    const double s0 = wall + integral(0, 2, [&](double t) { return scattered(t, 1); });
    const double s = integral(0, 2, [&](double t) { return scattered(t, -1); });
    // Across the plane of scattering, which holds the line of sight, +y, and the lamp: y x (0.8, 0,
    // 0.6) = (0.6, 0, -0.8), right and down in the picture.
    expected[c] = {s0, s * (0.36 - 0.64), s * 2 * 0.6 * -0.8, 0};
  }
  for (const std::string integrator : {"path", "bdpt"}) {
    CAPTURE(integrator);
    check(measure(scene, integrator, 1 << 17, 2), expected, 0.01);
  }
}

TEST_CASE("media optics: through a density that rises, by tracking, and its own light") {
  const Folder folder;
  // Along y: 0.5 as far as -0.5, rising to 2 at 0.5, and so on to 1.
  const auto ramp = folder.write("ramp.vol", grid_file({1, 2, 1}, 1, {0.5f, 2}));
  const std::string grid = cloud(ramp, number("scale", 0.8) + number("albedo", 0.25));
  const double all = std::exp(-0.8 * 2.5);
  const double upper = std::exp(-0.8 * (0.5 * (1.25 + 2) / 2 + 1));
  // Paths that are scattered are too long to count.
  check(measure(view() + sky + grid, "path", 1 << 15, 1), light({all, all, all}), 0.05);
  check(measure(grid + view(0, refer("cloud")) + sky, "path", 1 << 15, 1),
        light({upper, upper, upper}), 0.05);
  // A lamp in the cloud lights a wall outside.
  const std::string lamp =
      "<emitter type=\"point\"><point name=\"position\" value=\"0, 0, 0\"/>" +
      number("intensity", 10) + refer("cloud") + "</emitter>" + view(2) +
      square({0, 3, 0}, {0, 0, 0}, 1, bsdf("diffuse", number("reflectance", 0.6)));
  const double lit = 0.6 / pi * 10 / 9 * upper;
  for (const std::string integrator : {"path", "bdpt"}) {
    CAPTURE(integrator);
    check(measure(grid + lamp, integrator, 1 << 15, 2), light({lit, lit, lit}), 0.05);
  }
  // Its light goes by its density.
  const std::string glowing =
      cloud(ramp, number("scale", 0.8) + number("albedo", 0) + rgb("emission", "0.2, 1, 3"));
  const double part = (1 - all) / 0.8;
  check(measure(view() + sky + glowing, "path", 1 << 15),
        light({all + 0.2 * part, all + part, all + 3 * part}), 0.05);
}

TEST_CASE("media optics: nothing can be seen in a furnace, however the density varies") {
  const Folder folder;
  std::vector<float> values;
  for (int i = 0; i < 81; ++i) values.push_back(static_cast<float>(i * 37 % 81) / 27);
  const auto file = folder.write("clouds.vol", grid_file({3, 3, 3}, 3, values));
  const std::string scene =
      view() + sky + cloud(file, number("scale", 2) + white + phase("rayleigh"));
  for (const std::string integrator : {"path", "bdpt"}) {
    CAPTURE(integrator);
    check(measure(scene, integrator, 1 << 13), light({1, 1, 1}), 0.05);
  }
}
