// SPDX-License-Identifier: MIT
// Media as scene files give them: parameters, defaults and errors.
#include <doctest/doctest.h>

#include <bit>
#include <malus/optics/mie.hpp>

#include "media/mie_phase.hpp"
#include "medium_scenes.hpp"

using namespace render_test;
using renderer::Medium;
using renderer::Rgb;
using renderer::Vec3;
using scene_test::error_of;
using scene_test::Folder;
using Polarized = malus::Polarized<Rgb>;

namespace {

/// A scene of whose only medium a test asks.
struct Single {
  explicit Single(const std::string& content, const std::string& type = "homogeneous")
      : scene(build(camera + sphere(medium(content, "interior", type)))) {
    REQUIRE(scene.media.size() == 1);
  }
  const Medium* operator->() const { return &scene.media.front(); }
  renderer::Scene scene;
};

/// The medium's element is in line 3.
std::string error(const std::string& content, const std::string& type = "homogeneous") {
  return error_of([&] { Single(content, type); });
}

/// Where the cosine of the deflection is given.
Rgb phase_value(const Single& m, float cosine) {
  const Vec3 exitant(std::sqrt(1 - cosine * cosine), 0, cosine);
  return m->phase().value({0, 0, -1}, exitant).m00;
}

/// Stokes vectors, of 1 in each channel, after a stretch along +z, in frames of x and y.
std::array<Rgb, 4> after(const Single& m, const std::array<float, 4>& s, float length) {
  const Vec3 z(0, 0, 1), x(1, 0, 0);
  const auto frame = malus::Frame<float>::toward(z, x);
  const Polarized::Light light(Rgb{s[0]}, Rgb{s[1]}, Rgb{s[2]}, Rgb{s[3]}, frame);
  const auto t = m->polarized_transmittance<Polarized>(z, length);
  const auto left = Polarized::transmit(t, light).expressed_in(frame);
  return {left[0], left[1], left[2], left[3]};
}

void check_stokes(const std::array<Rgb, 4>& found, const std::array<Rgb, 4>& expected) {
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t c = 0; c < 3; ++c) CHECK(std::abs(found[i][c] - expected[i][c]) < 2e-6f);
}

/// As the file format has it: 2 x 1 x 1 cells in a box from 0 to (4, 1, 1).
std::string grid_file(float a, float b) {
  const auto word = [](std::uint32_t w) {
    std::string bytes;
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>(w >> (8 * i) & 255);
    return bytes;
  };
  std::string bytes = "VOL\3";
  for (const std::uint32_t w : {1u, 2u, 1u, 1u, 1u}) bytes += word(w);
  for (const float v : {0.f, 0.f, 0.f, 4.f, 1.f, 1.f, a, b})
    bytes += word(std::bit_cast<std::uint32_t>(v));
  return bytes;
}
std::string grid(const std::string& name, const std::filesystem::path& file,
                 const std::string& more = "") {
  return "<volume type=\"gridvolume\" name=\"" + name + "\">" + string("filename", file.string()) +
         more + "</volume>";
}

}  // namespace

TEST_CASE("media: a homogeneous medium's parameters and defaults") {
  const Vec3 somewhere(7, 8, 9);
  const Single plain("");
  check_near(plain->extinction(somewhere), Rgb(1));
  check_near(plain->scattering(somewhere), Rgb(0.75f));
  check_near(phase_value(plain, 0.3f), Rgb(1 / (4 * renderer::pi)));
  CHECK(plain->is_homogeneous());
  CHECK(!plain->emits());
  CHECK(!plain->polarizes());
  CHECK(!plain.scene.polarizes);
  CHECK(plain.scene.has_media());
  CHECK(plain.scene.warnings.empty());

  const Single scaled(rgb("sigma_t", "1, 2, 4") + rgb("albedo", "0.5, 0.25, 1") +
                      number("scale", 3) + rgb("emission", "0, 1, 0") + flag("sample_emitters") +
                      flag("has_spectral_extinction"));
  check_near(scaled->extinction(somewhere), {3, 6, 12});
  check_near(scaled->scattering(somewhere), {1.5f, 1.5f, 12});
  CHECK(scaled->emits());
  renderer::Sampler sampler(0, 0, 0);
  check_near(scaled->emitted<malus::Unpolarized<Rgb>>({somewhere, {0, 0, 1}}, 0.5f, sampler),
             {0, (1 - std::exp(-3.0f)) / 6, 0});

  const Single split(rgb("sigma_a", "1, 0, 0") + rgb("sigma_s", "1, 3, 0") + number("scale", 2));
  check_near(split->extinction(somewhere), {4, 6, 0});
  check_near(split->scattering(somewhere), {2, 6, 0});
  const Single volume("<volume type=\"constvolume\" name=\"sigma_t\">" + rgb("value", "1, 2, 3") +
                      "</volume>");
  check_near(volume->extinction(somewhere), {1, 2, 3});
}

TEST_CASE("media: phase functions' parameters and defaults") {
  const auto hg = [](double g, double c) {
    return Rgb(static_cast<float>((1 - g * g) / (4 * pi) / std::pow(1 + g * g - 2 * g * c, 1.5)));
  };
  check_near(phase_value(Single(phase("isotropic")), 0.5f), Rgb(1 / (4 * renderer::pi)));
  check_near(phase_value(Single(phase("hg")), 0.5f), hg(0.8, 0.5));
  check_near(phase_value(Single(phase("hg", number("g", -0.3))), 0.5f), hg(-0.3, 0.5));
  const auto rayleigh = [](double c) {
    return Rgb(static_cast<float>(3 / (16 * pi) * (1 + c * c)));
  };
  const Single ideal(phase("rayleigh"));
  check_near(phase_value(ideal, 0.5f), rayleigh(0.5));
  CHECK(ideal->polarizes());
  CHECK(ideal.scene.polarizes);
  // Hansen and Travis 1974, equations 2.15 and 2.16.
  const double depolarization = 0.2, part = (1 - depolarization) / (1 + depolarization / 2);
  check_near(
      phase_value(Single(phase("rayleigh", number("depolarization", depolarization))), 0.5f),
      rayleigh(0.5) * static_cast<float>(part) + Rgb(static_cast<float>((1 - part) / (4 * pi))));
  // Nothing that scatters, nothing that polarises.
  CHECK(!Single(number("albedo", 0) + phase("rayleigh")).scene.polarizes);

  // Water in air, with the channels' own wavelengths, and one with everything given.
  const auto mie = [](double radius, std::complex<double> inside, double outside,
                      double wavelength) {
    const malus::MieSphere s(2 * pi * radius * outside / wavelength, inside / outside);
    return static_cast<float>(s.elements(0.5).a1 / (4 * pi));
  };
  const Single water(phase("mie", number("radius", 0.3)));
  const Rgb droplets = phase_value(water, 0.5f);
  const Single soot(phase("mie", number("radius", 0.2) + number("geometric_deviation", 1) +
                                     number("int_ior", 1.8) + number("ext_ior", 1.2) +
                                     number("absorption", 0.6) +
                                     rgb("wavelengths", "0.7, 0.5, 0.4")));
  const Rgb grains = phase_value(soot, 0.5f);
  const double by_default[] = {0.61, 0.55, 0.465}, given[] = {0.7, 0.5, 0.4};
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(droplets[i] / mie(0.3, 1.333, 1.000277, by_default[i]) ==
          doctest::Approx(1).epsilon(1e-3));
    CHECK(grains[i] / mie(0.2, {1.8, 0.6}, 1.2, given[i]) == doctest::Approx(1).epsilon(1e-3));
  }
  CHECK(water.scene.polarizes);

  const Folder folder;
  const auto table = folder.write("table.txt", "0 3 0 0 0 0 0\n180 1 0 0 0 0 0\n");
  const Single tabulated(phase("tabulated", string("filename", table.string())));
  check_near(phase_value(tabulated, 1), phase_value(tabulated, -1) * 3.0f);
}

TEST_CASE("media: extinction by polarisation goes by the axis, in degrees, times the scale") {
  // A foil: what is polarised along y is taken, the other left.
  const Single foil(vector("axis", "0, 0.5, 0") + number("sigma_a", 0) + number("sigma_s", 0) +
                    rgb("linear_dichroism", "20, 10, 0") + number("scale", 2));
  CHECK(foil->extinguishes_by_polarization());
  CHECK(foil.scene.polarizes);
  const float x = std::exp(-20.0f);
  check_stokes(after(foil, {1, 0, 0, 0}, 1),
               {Rgb(0.5f, (1 + x) / 2, 1), Rgb(0.5f, (1 - x) / 2, 0), Rgb(0), Rgb(0)});
  // The default axis is z: along it there is nothing linear.
  const Single along(number("sigma_t", 0) + number("linear_dichroism", 5));
  check_stokes(after(along, {1, 0, 0, 0}, 1), {Rgb(1), Rgb(0), Rgb(0), Rgb(0)});

  // Right circular light is taken, left circular light spared what others lose.
  const Single handed(number("sigma_a", 1) + number("sigma_s", 0) +
                      rgb("circular_dichroism", "2, 1, 0"));
  check_stokes(after(handed, {1, 0, 0, 1}, 1),
               {Rgb(std::exp(-2.0f), std::exp(-1.5f), std::exp(-1.0f)), Rgb(0), Rgb(0),
                Rgb(std::exp(-2.0f), std::exp(-1.5f), std::exp(-1.0f))});

  // Sugar turns light clockwise as the receiver sees it.
  const Single sugar(number("sigma_t", 0) + rgb("optical_rotation", "30, 60, -60") +
                     number("scale", 0.5));
  const float h = std::sqrt(0.75f);
  check_stokes(after(sugar, {1, 1, 0, 0}, 1),
               {Rgb(1), Rgb(h, 0.5f, 0.5f), Rgb(-0.5f, -h, h), Rgb(0)});
  // x is slow: it lags by 30°, and the field turns from y to x, which is to the right.
  const auto stressed = [](double degrees) {
    return Single(vector("axis", "1, 0, 0") + number("sigma_t", 0) +
                  number("linear_birefringence", 2 * degrees) + number("scale", 0.5));
  };
  check_stokes(after(stressed(15), {1, 0, 1, 0}, 2), {Rgb(1), Rgb(0), Rgb(h), Rgb(0.5f)});
  check_stokes(after(stressed(-15), {1, 0, 1, 0}, 2), {Rgb(1), Rgb(0), Rgb(h), Rgb(-0.5f)});

  // All of it 0: a plain medium.
  CHECK(!Single(vector("axis", "1, 0, 0") + number("optical_rotation", 0))->polarizes());
  CHECK(!Single(number("optical_rotation", 5) + number("scale", 0))->polarizes());
  // What another polarisation is spared may be all of the absorption, and no more.
  const std::string gain = number("sigma_s", 4) + number("circular_dichroism", -0.3);
  CHECK(error(number("sigma_a", 0.15) + gain) == "no error");
  CHECK(error(number("sigma_t", 1) + number("albedo", 0.85) + number("circular_dichroism", 0.3)) ==
        "no error");
  CHECK_MESSAGE_HAS(error(number("sigma_a", 0.1499) + gain), "scene.xml:3: ", "would gain",
                    "is 0.1499;", "allowed: 0.15 or more");
  CHECK_MESSAGE_HAS(error(number("albedo", 1) + rgb("linear_dichroism", "0, 0, -2")), "would gain",
                    "is 0;", "allowed: 2 or more");
}

TEST_CASE("media: a density that varies, and an albedo") {
  const Folder folder;
  const auto file = folder.write("d.vol", grid_file(0.25f, 0.75f));
  const std::string box = "<boolean name=\"use_grid_bbox\" value=\"true\"/>";
  const Single cloud(grid("sigma_t", file, box) + number("scale", 4) + rgb("albedo", "0.5, 1, 0"),
                     "heterogeneous");
  CHECK(!cloud->is_homogeneous());
  check_near(cloud->extinction({1, 0.5f, 0.5f}), Rgb(1));
  check_near(cloud->extinction({2, 0.5f, 0.5f}), Rgb(2));
  check_near(cloud->scattering({3.5f, 0.5f, 0.5f}), {1.5f, 3, 0});
  check_near(cloud->extinction({4.1f, 0.5f, 0.5f}), Rgb(0));

  const std::string moved =
      "<transform name=\"to_world\"><scale value=\"2\"/><translate y=\"5\"/></transform>";
  const Single mixed(grid("sigma_t", file, moved + string("filter_type", "nearest")) +
                         grid("albedo", file, box + string("wrap_mode", "clamp")),
                     "heterogeneous");
  check_near(mixed->extinction({0.99f, 5.5f, 0.5f}), Rgb(0.25f));
  check_near(mixed->extinction({1.01f, 6.5f, 1.5f}), Rgb(0.75f));
  check_near(mixed->extinction({2.01f, 6.5f, 1.5f}), Rgb(0));
  // Outside its box the albedo is that of the nearest cell.
  check_near(mixed->scattering({1.01f, 6.5f, 1.5f}), Rgb(0.75f * 0.2525f));

  // The transform acts on the file's box.
  const std::string aside =
      "<transform name=\"to_world\"><scale value=\"2\"/><translate x=\"1\"/></transform>";
  const Single both(grid("sigma_t", file, box + aside), "heterogeneous");
  check_near(both->extinction({8.9f, 1.9f, 1.9f}), Rgb(0.75f));
  check_near(both->extinction({9.1f, 1.9f, 1.9f}), Rgb(0));
  check_near(both->extinction({1.1f, 0.1f, 1.9f}), Rgb(0.25f));

  // As in Mitsuba: the same everywhere, of the unit cube.
  const Single cube(rgb("sigma_t", "1, 2, 3"), "heterogeneous");
  check_near(cube->extinction({0.5f, 0.9f, 0.1f}), {1, 2, 3});
  check_near(cube->extinction({1.5f, 0.9f, 0.1f}), Rgb(0));
  check_near(cube->scattering({0.5f, 0.5f, 0.5f}), {0.75f, 1.5f, 2.25f});
  REQUIRE(cube.scene.warnings.size() == 1);
  CHECK_MESSAGE_HAS(cube.scene.warnings[0], "scene.xml:3: ", "unit cube", "homogeneous");
  const Single larger("<volume type=\"constvolume\" name=\"sigma_t\">" + moved + "</volume>",
                      "heterogeneous");
  check_near(larger->extinction({1.5f, 6.9f, 0.1f}), Rgb(1));

  for (const auto& name : {"linear_dichroism", "circular_dichroism", "linear_birefringence",
                           "optical_rotation", "axis"})
    CHECK_MESSAGE_HAS(error(number(name, 1), "heterogeneous"), "scene.xml:3: ", name,
                      "density varies", "homogeneous");
  const auto dense = folder.write("e.vol", grid_file(1, 1.01f));
  CHECK_MESSAGE_HAS(error(grid("albedo", dense), "heterogeneous"), "scene.xml:3: ", "albedo",
                    "1.01", "allowed: 0 to 1");
  CHECK_MESSAGE_HAS(error(grid("sigma_t", file) + number("scale", 5e9), "heterogeneous"),
                    "no error");
  CHECK_MESSAGE_HAS(error(grid("sigma_t", dense) + number("scale", 1e10), "heterogeneous"), "scale",
                    "magnitudes up to 10000000000");
  CHECK_MESSAGE_HAS(error(grid("sigma_t", file), "homogeneous"), "varies", "heterogeneous");
  CHECK_MESSAGE_HAS(error(grid("sigma_t", "none.vol"), "heterogeneous"), "none.vol",
                    "no such file");
  CHECK_MESSAGE_HAS(error(grid("sigma_t", file, string("wrap_mode", "repeat")), "heterogeneous"),
                    "repeat", "allowed: clamp");
  CHECK_MESSAGE_HAS(error(grid("sigma_t", file, string("filter_type", "cubic")), "heterogeneous"),
                    "cubic", "allowed: nearest, trilinear");
  CHECK_MESSAGE_HAS(error("<volume type=\"smoke\" name=\"sigma_t\"/>", "heterogeneous"), "smoke",
                    "constvolume, gridvolume");
  const auto flat = folder.write("f.vol", grid_file(1, 1).replace(36, 4, std::string(4, '\0')));
  CHECK(error(grid("sigma_t", flat), "heterogeneous") == "no error");
  CHECK_MESSAGE_HAS(error(grid("sigma_t", flat, box), "heterogeneous"), "from 0 to 0", "not empty");
}

TEST_CASE("media: what is wrong is said, with the line, the value and what is allowed") {
  const auto check = [](const std::string& content, const std::string& name,
                        const std::string& value, const std::string& allowed) {
    CHECK_MESSAGE_HAS(error(content), "scene.xml:3: ", name, value, "allowed: " + allowed);
  };
  check(number("sigma_t", -1), "sigma_t", "-1", "0 to 10000000000");
  check(number("albedo", 1.5), "albedo", "1.5", "0 to 1");
  check(number("scale", -2), "scale", "-2", "0 to 10000000000");
  check(number("sigma_t", 1e6) + number("scale", 1e6), "scale", "1000000000000",
        "magnitudes up to 10000000000");
  check(number("linear_dichroism", 1e6) + number("scale", 1e6), "linear_dichroism", "1000000000000",
        "magnitudes up to 10000000000");
  check(number("emission", -1), "emission", "-1", "0 to 10000000000");
  check(number("optical_rotation", 1e11), "optical_rotation", "100000000000",
        "-10000000000 to 10000000000");
  check(number("density", 1), "density", "unknown", "sample_emitters, has_spectral_extinction, ");
  check(phase("hg", number("g", 1)), "\"g\"", "1", "above -1");
  check(phase("hg", number("g", -1)), "\"g\"", "-1", "above -1");
  check(phase("rayleigh", number("depolarization", 0.9)), "depolarization", "0.9", "0 to 6/7");
  check(phase("mie"), "radius", "missing", "<float>");
  check(phase("mie", number("radius", 0)), "radius", "0", "more than 0");
  check(phase("mie", number("radius", 1) + number("geometric_deviation", 0.5)),
        "geometric_deviation", "0.5", "1 to 3");
  check(phase("mie", number("radius", 1) + number("absorption", -1)), "absorption", "-1", "0 to");
  check(phase("mie", number("radius", 1) + number("wavelengths", 0)), "wavelengths", "0",
        "0.001 to");
  check(phase("mie", number("radius", 1) + number("int_ior", 1.2) + number("ext_ior", 1.2)),
        "Mie particles", "1.2", "another index");
  CHECK_MESSAGE_HAS(error(phase("mie", number("radius", 1) + string("int_ior", "jelly"))), "jelly",
                    "water");
  CHECK_MESSAGE_HAS(error(phase("tabulated", string("filename", "no.txt"))),
                    "scene.xml:3: ", "no.txt");
  CHECK_MESSAGE_HAS(error(phase("velvet")), "scene.xml:3: ", "velvet",
                    "hg, isotropic, mie, rayleigh, tabulated");
  CHECK_MESSAGE_HAS(error(phase("hg") + phase("hg")), "2 nested <phase>");
  CHECK_MESSAGE_HAS(error("", "foggy"), "foggy", "heterogeneous, homogeneous");
  CHECK_MESSAGE_HAS(error(number("sigma_t", 1) + number("sigma_a", 1)), "sigma_t and albedo or by");
  CHECK_MESSAGE_HAS(error(number("albedo", 1) + number("sigma_s", 1)), "sigma_t and albedo or by");
  CHECK_MESSAGE_HAS(error(number("sigma_a", 1)), "both or neither");
  CHECK_MESSAGE_HAS(error(vector("axis", "0, 0, 0")), "axis is not (0, 0, 0)");
  const auto scene_error = [](const std::string& content) {
    return error_of([&] { build(camera + content); });
  };
  // What nothing refers to is checked all the same.
  for (const auto& wrong :
       {medium(number("albedo", 2)), phase("hg", number("g", 2)),
        std::string("<volume type=\"constvolume\"><rgb name=\"value\" value=\"-1\"/></volume>")})
    CHECK_MESSAGE_HAS(scene_error(wrong), "scene.xml:3: ", "allowed: ");
  CHECK_MESSAGE_HAS(scene_error(sphere(medium("", "inside"))), "scene.xml:3: ", "inside",
                    "<medium name=\"interior\">");
  for (const std::string type : {"constant", "directional"})
    CHECK_MESSAGE_HAS(scene_error("<emitter type=\"" + type + "\">" + medium("") + "</emitter>"),
                      "scene.xml:3: ", type, "infinity");
  CHECK_MESSAGE_HAS(
      scene_error("<emitter type=\"point\">" + medium("", "a") + medium("", "b") + "</emitter>"),
      "2 nested <medium>");
}
