// SPDX-License-Identifier: MIT
// In participating media, too, all integrators give the same picture in all four Stokes components:
// with the camera and the light inside and outside, in nested media, by every phase function, where
// extinction depends on polarisation, where density varies and where media emit. Every comparison
// has the error rate that stokes_agreement.hpp states, 1 in 10^5 sets of seeds.
#include <doctest/doctest.h>

#include <fstream>

#include "agreement_scenes.hpp"
#include "integrators/mis.hpp"
#include "integrators/way.hpp"
#include "picture_files.hpp"

using namespace agreement;
using renderer::Strategy;

namespace {

/// Photons in media are few: what is compared is larger, and their blur tolerated.
const Algorithm media_bpm{"bpm", {.bias = 0.06, .cells = 3}},
    media_ppm{"ppm", {.bias = 0.06, .cells = 3}};
const std::vector<Algorithm> all_in_media{bdpt, ptracer, vcm, media_bpm, media_ppm};

std::string medium(const std::string& content, const std::string& name = "interior",
                   const std::string& type = "homogeneous") {
  return "<medium type=\"" + type + "\" name=\"" + name + "\">" + content + "</medium>";
}
std::string coefficients(const std::string& absorption, const std::string& scattering) {
  return rgb("sigma_a", absorption) + rgb("sigma_s", scattering);
}
std::string phase(const std::string& type, const std::string& content = "") {
  return "<phase type=\"" + type + "\">" + content + "</phase>";
}
const std::string null = bsdf("null");
const std::string rayleigh = phase("rayleigh");
const std::string haze = coefficients("0.02, 0.03, 0.05", "0.1, 0.15, 0.3");

std::string volpath(int max_depth) {
  return "<integrator type=\"volpath\">" + integer("max_depth", max_depth) +
         integer("rr_depth", 2) + number("initial_radius", 0.01) +
         number("initial_media_radius", 0.02) + "</integrator>\n";
}

/// Everything is in one medium: the walls are its end.
Scene filled(const std::string& content, int max_depth = 4, const std::string& more = stage) {
  std::string eye = camera(), light = lamp;
  const std::string inside = "<ref id=\"air\" name=\"medium\"/>";
  eye.insert(eye.find("<film"), inside);
  light.insert(light.find("</emitter>"), inside);
  return build("<medium type=\"homogeneous\" id=\"air\">" + content + "</medium>" +
               volpath(max_depth) + eye + more + light);
}

/// A body of the medium on the stage, without a surface.
std::string body(const std::string& content, double radius = 0.8) {
  return ball({0.3, -0.3, 1.1}, radius, null + medium(content));
}
Scene staged(const std::string& bodies, int max_depth = 4) {
  return build(volpath(max_depth) + camera() + floor_and_wall + lamp + bodies);
}

}  // namespace

TEST_CASE("media agree: a scene full of Rayleigh haze, camera and lamp within") {
  // A ball that says what is before it and what would be behind it.
  const std::string solid = ball(
      {-0.9, -0.6, 0.9}, 0.5,
      grey + "<ref id=\"air\" name=\"exterior\"/>" + medium(coefficients("9, 9, 9", "0, 0, 0")));
  check_agree(filled(haze + rayleigh, 4, stage + solid), all_in_media, 64, 128);
}

TEST_CASE("media agree: dense bodies of every phase function") {
  const std::string thick = coefficients("0.1, 0, 0.4", "1, 2, 4");
  for (const std::string& p :
       {phase("isotropic"), phase("hg", number("g", 0.6)),
        phase("rayleigh", number("depolarization", 0.1)),
        phase("mie", number("radius", 0.25) + number("int_ior", 1.4) + number("ext_ior", 1))}) {
    CAPTURE(p);
    check_agree(staged(body(thick + p)), unbiased, 64);
  }
  check_agree(staged(body(coefficients("0.5, 0.5, 0.5", "2, 2, 2") + phase("isotropic"))),
              connecting, 64);
}

TEST_CASE("media agree: extinction by polarisation in the light's order") {
  // Turns, delays and absorbs polarisations, each otherwise; none of them commute.
  const std::string crystal =
      coefficients("0.4, 0.3, 0.5", "0.15, 0.2, 0.3") + rayleigh +
      "<vector name=\"axis\" value=\"0.3, 0.5, 0.8\"/>" + rgb("linear_dichroism", "0.5, 0.3, 0.4") +
      rgb("circular_dichroism", "-0.1, 0.2, 0.1") + rgb("linear_birefringence", "50, 80, 110") +
      rgb("optical_rotation", "25, 40, 60");
  check_agree(filled(crystal), unbiased, 64, 128);
  check_agree(staged(body(crystal)), {bdpt, vcm}, 64);
}

TEST_CASE("media agree: media within each other, behind glass and behind sheets") {
  const std::string inner = ball({0.3, -0.3, 1.1}, 0.5,
                                 null + medium(coefficients("0, 0, 0", "2, 1, 0.5") + rayleigh) +
                                     "<ref id=\"milk\" name=\"exterior\"/>");
  const std::string outer =
      ball({0.3, -0.3, 1.1}, 0.9, null + "<ref id=\"milk\" name=\"interior\"/>");
  const std::string milk = "<medium type=\"homogeneous\" id=\"milk\">" +
                           coefficients("0.1, 0.2, 0.3", "0.5, 0.7, 0.9") +
                           phase("hg", number("g", 0.4)) + "</medium>";
  const std::string foil = square({0.1, -1.6, 1.4}, {0, -5, 2.5}, 0.8,
                                  bsdf("polarizer", number("theta", 30)), {0.4, 0.1, 1});
  check_agree(staged(milk + inner + outer + foil), unbiased, 64);
  // Through glass nothing is connected: light has to find its way. The lamp is all around.
  const std::string filled_glass = ball(
      {0.3, -0.3, 0.8}, 0.6, glass + medium(coefficients("0, 0.1, 0.2", "1, 2, 3") + rayleigh));
  const std::string wide = square({0, 0, 5}, {0, 0, 0}, 4, black + emits(1), {0, 1, 0});
  check_agree(build(volpath(5) + camera() + floor_and_wall + filled_glass + wide), {bdpt, vcm}, 64,
              128);
}

TEST_CASE("media agree: density that varies") {
  const Folder folder;
  // 4 x 3 x 2 cells of a density, in Mitsuba's format.
  std::string bytes = "VOL\x03";
  const auto put = [&](auto value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  for (const std::int32_t i : {1, 4, 3, 2, 1}) put(i);
  for (const float f : {0.f, 0.f, 0.f, 1.f, 1.f, 1.f}) put(f);
  for (int i = 0; i < 24; ++i) put(static_cast<float>(i * 7 % 11) / 10);
  const auto path = folder.path() / "smoke.vol";
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<int>(bytes.size()));
  const std::string place =
      "<transform name=\"to_world\"><scale value=\"1.4\"/><rotate z=\"1\" angle=\"30\"/><translate "
      "x=\"-0.2\" y=\"-1.2\" z=\"0.4\"/></transform>";
  const std::string smoke = "<volume name=\"sigma_t\" type=\"gridvolume\">" + file(path.string()) +
                            place + "</volume>" + rgb("albedo", "0.9, 0.8, 0.6") +
                            number("scale", 5) + rayleigh;
  const std::string box =
      "<shape type=\"cube\"><transform name=\"to_world\"><translate x=\"1\" "
      "y=\"1\" z=\"1\"/><scale value=\"0.7\"/><rotate z=\"1\" angle=\"30\"/>"
      "<translate x=\"-0.2\" y=\"-1.2\" z=\"0.4\"/></transform>" +
      null + medium(smoke, "interior", "heterogeneous") + "</shape>";
  check_agree(staged(box), unbiased, 64);
}

TEST_CASE("media agree: media that emit") {
  const std::string fire =
      coefficients("0.5, 1, 2", "0.3, 0.2, 0.1") + rgb("emission", "0.9, 0.4, 0.1") + rayleigh;
  check_agree(build(volpath(4) + camera() + floor_and_wall + body(fire)),
              {bdpt, vcm, ptracer, media_ppm, media_bpm}, 64);
  check_agree(staged(body(fire)), {ptracer}, 64);
}

TEST_CASE("media agree: several media that emit, one in two bodies, and a body within one") {
  const auto fire = [](const std::string& radiance) {
    return coefficients("0.5, 1, 2", "0.3, 0.2, 0.1") + rgb("emission", radiance) + rayleigh;
  };
  const std::string room = volpath(3) + camera() + floor_and_wall;
  const auto flame = [](const glm::dvec3& center, double radius, const std::string& content) {
    return ball(center, radius, null + content);
  };
  const std::string pair = flame({0.8, -0.5, 0.8}, 0.5, medium(fire("2, 1, 0.5"))) +
                           flame({-0.7, 0.2, 1.2}, 0.8, medium(fire("0.3, 0.6, 0.9")));
  const std::string one_in_two =
      "<medium type=\"homogeneous\" id=\"fire\">" + fire("0.9, 0.4, 0.1") + "</medium>" +
      flame({0.9, -0.5, 0.7}, 0.4, "<ref id=\"fire\" name=\"interior\"/>") +
      flame({-0.7, 0.2, 1.2}, 0.6, "<ref id=\"fire\" name=\"interior\"/>");
  // What bounds nothing doesn't say which medium is around it.
  const std::string around = body(fire("0.9, 0.4, 0.1"), 0.9) + ball({0.3, -0.3, 1.1}, 0.5, grey);
  for (const std::string& bodies : {pair, one_in_two, around}) {
    CAPTURE(bodies);
    check_agree(build(room + bodies), {ptracer, media_ppm}, 64);
  }
}

TEST_CASE("media agree: what a medium emits goes by its density, on light paths as well") {
  const Folder folder;
  std::string bytes = "VOL\x03";
  const auto put = [&](auto value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  for (const std::int32_t i : {1, 3, 2, 2, 1}) put(i);
  for (const float f : {0.f, 0.f, 0.f, 1.f, 1.f, 1.f}) put(f);
  for (int i = 0; i < 12; ++i) put(static_cast<float>(i * 5 % 7) / 3);
  const auto path = folder.path() / "flame.vol";
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<int>(bytes.size()));
  const std::string place =
      "<transform name=\"to_world\"><scale value=\"1.4\"/><translate x=\"-0.5\" y=\"-1\" "
      "z=\"0.4\"/></transform>";
  const std::string flame = "<volume name=\"sigma_t\" type=\"gridvolume\">" + file(path.string()) +
                            place + "</volume>" + rgb("albedo", "0.5, 0.3, 0.2") +
                            rgb("emission", "0.9, 0.4, 0.1");
  const std::string box =
      "<shape type=\"cube\"><transform name=\"to_world\"><translate x=\"1\" y=\"1\" "
      "z=\"1\"/><scale value=\"0.7\"/><translate x=\"-0.5\" y=\"-1\" z=\"0.4\"/></transform>" +
      null + medium(flame, "interior", "heterogeneous") + "</shape>";
  check_agree(build(volpath(3) + camera() + floor_and_wall + box), {ptracer, media_ppm}, 64);
}

TEST_CASE("media agree: what is before a near plane neither takes light nor gives any") {
  std::string eye = camera("", number("fov", 40) + number("near_clip", 2));
  eye.insert(eye.find("<film"), "<ref id=\"air\" name=\"medium\"/>");
  std::string light = lamp;
  light.insert(light.find("</emitter>"), "<ref id=\"air\" name=\"medium\"/>");
  check_agree(build("<medium type=\"homogeneous\" id=\"air\">" + haze + rayleigh + "</medium>" +
                    volpath(3) + eye + stage + light),
              unbiased, 64);
  // Nor does what is beyond the far one.
  const std::string fire =
      coefficients("0.5, 1, 2", "0.3, 0.2, 0.1") + rgb("emission", "2, 1, 0.5");
  check_agree(build(volpath(3) + camera("", number("fov", 40) + number("far_clip", 4.2)) +
                    floor_and_wall + body(fire, 0.6)),
              {ptracer}, 64);
}

TEST_CASE("media agree: each strategy alone gives all light of its length") {
  Scene scene = filled(coefficients("0.1, 0.1, 0.2", "0.2, 0.3, 0.2") + rayleigh +
                           rgb("linear_birefringence", "20, 30, 50"),
                       3, square({0, 0, 0}, {0, 0, 1}, 2, coat, {0, 1, 0}));
  scene.film.width = scene.film.height = scene.film.crop_width = scene.film.crop_height = 32;
  std::uint64_t seed = 10;
  for (const int k : {2, 3}) {
    scene.integrator.strategy.reset();
    scene.integrator.max_depth = k;
    Picture expected = picture(scene, "path", 512, 1);
    scene.integrator.max_depth = k - 1;
    expected -= picture(scene, "path", 512, 1);
    scene.integrator.max_depth = k;
    for (int s = 0; s <= k; ++s) {
      CAPTURE(k);
      CAPTURE(s);
      scene.integrator.strategy = Strategy{s, k + 1 - s};
      // Connections within a medium have no bound: the distance may be any.
      const std::uint64_t samples = s > 1 && s < k ? 1024 : 512;
      CHECK_AGREE_BUT_FOR(picture(scene, "bdpt", samples, ++seed), expected,
                          (agreement::Tolerance{.cells = 3}));
    }
  }
}

TEST_CASE("media agree: both modes take the same paths where media don't polarise") {
  Scene plain = build(volpath(4) + camera() + square({0, 0, 0}, {0, 0, 1}, 2, grey, {0, 1, 0}) +
                      lamp + body(haze));
  for (const char* name : {"path", "bdpt", "ptracer", "vcm"}) {
    CAPTURE(std::string(name));
    plain.integrator.name = name;
    const auto with = agreement::render(plain, 4, 1),
               without = agreement::render(plain, 4, 1, Mode::unpolarized);
    double largest = 0, light = 0;
    for (std::size_t p = 0; p < 64 * 64; ++p)
      for (std::size_t i = 0; i < 12; ++i) {
        const double a = with.film.total(p).mean(i), b = without.film.total(p).mean(i);
        largest = std::max(largest, std::abs(a - b) / (1 + std::abs(b)));
        light += b;
      }
    CHECK(light > 0);
    CHECK(largest < 1e-5);
  }
}

TEST_CASE("media agree: the same picture on any number of threads") {
  Scene scene = filled(haze + rayleigh, 3);
  for (const char* name : {"path", "vcm"}) {
    scene.integrator.name = name;
    const auto one = agreement::render(scene, 2, 1, Mode::optimized, 1),
               three = agreement::render(scene, 2, 1, Mode::optimized, 3);
    bool same = true;
    for (std::size_t p = 0; p < 64 * 64; ++p)
      for (std::size_t i = 0; i < 12; ++i)
        same = same && one.film.total(p).mean(i) == three.film.total(p).mean(i);
    CHECK(same);
  }
}

TEST_CASE(
    "media agree: the three weights of a path of two segments sum to one, however thin they are") {
  using renderer::SubpathMis;
  const float paths = 4096, lens_pdf = 7000, cos_z = 0.7f, cos_zl = 0.4f, cos_l = 0.6f;
  const float d1 = 3, d2 = 1.7f, pdf_incident = 0.3f, pdf_exitant = 0.11f, per_area = 2.5f;
  const renderer::MisFactors factors{.connection = 1};
  // Through hardly anything; through what lets nothing through by all expectation, as a hole in a
  // cloud may do yet.
  for (const float first : {1.0f, 1e-4f, 1e-30f, 0.0f})
    for (const float second : {1.0f, 1e-6f, 1e-20f, 0.0f}) {
      CAPTURE(first);
      CAPTURE(second);
      const float to_z = renderer::arrival_chance(renderer::Rgb(first)),
                  to_light = renderer::arrival_chance(renderer::Rgb(second));
      // The light: by area, by cosine; seen from z by solid angle.
      const float light_pdf = per_area * d2 * d2 / cos_l, ratio = cos_l / (renderer::pi * d2 * d2);

      SubpathMis camera;
      camera.vcm = paths / lens_pdf;
      camera.arrive(d1 * d1, cos_z, to_z, to_z);
      const float connected =
          renderer::mis_weight(pdf_incident * to_light / light_pdf,
                               ratio * cos_zl * to_light * camera.connected(pdf_exitant, 0));

      camera.scatter({.pdf = pdf_incident, .reverse_pdf = pdf_exitant}, cos_zl, factors, 0);
      camera.arrive(d2 * d2, cos_l, to_light, to_light);
      const float found = renderer::mis_weight(
          0, per_area * camera.vcm + per_area * cos_l / renderer::pi * camera.vc);

      SubpathMis light;
      light.vc = renderer::pi / per_area;
      light.vcm = 1 / ratio;
      light.arrive(cos_zl, to_light, to_light);
      const float seen = renderer::mis_weight(
          lens_pdf * cos_z / (d1 * d1) * to_z / paths * light.connected(pdf_incident, 0), 0);
      CHECK(connected + found + seen == doctest::Approx(1).epsilon(1e-5));
    }
}
