// SPDX-License-Identifier: MIT
// Path tracing, light tracing, bidirectional path tracing, photon mapping and vertex connection and
// merging give the same picture in all four Stokes components: in the bundled scenes, for every
// kind of light, through glass, by way of meshes with interpolated normals, through sheets, and
// whatever the film and the sensor are. Every comparison has the error rate that
// stokes_agreement.hpp states, 1 in 10^5 sets of seeds.
#include <doctest/doctest.h>

#include "agreement_scenes.hpp"
#include "picture_files.hpp"

using namespace agreement;

namespace {

Scene bundled(const std::string& name, int max_depth) {
  Scene scene = example(name, {{"resolution", "64"}});
  scene.integrator.max_depth = max_depth;
  return scene;
}

}  // namespace

TEST_CASE("agreement: equal pictures of other seeds pass, and small errors are caught") {
  Scene scene = build(path_of(3) + camera() + stage + lamp);
  const Picture a = picture(scene, "path", 384, 1), b = picture(scene, "path", 384, 2);
  CHECK_AGREE(a, b);
  for (const std::uint64_t seed : {3u, 4u, 5u}) CHECK_AGREE(a, picture(scene, "path", 32, seed));

  const auto planted = [&](std::size_t component, double factor) {
    Picture wrong = b;
    wrong.scale(component, factor);
    return wrong;
  };
  CHECK_DIFFER(a, planted(0, 1.01));
  CHECK_DIFFER(a, planted(0, 0.99));
  CHECK_DIFFER(a, planted(1, -1));
  CHECK_DIFFER(a, planted(2, -1));
  CHECK_DIFFER(a, planted(3, -1));
}

TEST_CASE("agreement: Student's t has its tabulated tails") {
  // Abramowitz & Stegun 1964, table 26.10: two-sided chances of 0.05, 0.01 and 0.002.
  CHECK(agreement::student_tail(12.706, 1) == doctest::Approx(0.05).epsilon(1e-4));
  CHECK(agreement::student_tail(4.303, 2) == doctest::Approx(0.05).epsilon(1e-3));
  CHECK(agreement::student_tail(3.250, 9) == doctest::Approx(0.01).epsilon(1e-3));
  CHECK(agreement::student_tail(3.385, 30) == doctest::Approx(0.002).epsilon(1e-3));
}

TEST_CASE("integrators agree: diffuse.xml") { check_agree(bundled("diffuse.xml", 5), all, 64); }
TEST_CASE("integrators agree: glossy.xml") { check_agree(bundled("glossy.xml", 5), all, 64, 128); }
TEST_CASE("integrators agree: glass.xml") { check_agree(bundled("glass.xml", 5), all, 64, 256); }

TEST_CASE("integrators agree: bathroom.xml, lit through glass alone") {
  // Path tracing finds a lamp here so seldom that its mean of a few thousand paths is no normal
  // variable; light paths find everything that is rough.
  Scene scene = example("bathroom.xml", {{"width", "24"}, {"height", "24"}});
  scene.integrator.max_depth = 8;
  const auto rough = rough_pixels(scene);
  Picture reference = picture(scene, "ptracer", 512, 1);
  reference.use(rough);
  std::uint64_t seed = 2;
  for (const auto& [name, tolerance] :
       {Algorithm{"bdpt", {.cells = 4}}, Algorithm{"vcm", {.bias = 0.01, .cells = 4}}}) {
    CAPTURE(std::string(name));
    Picture other = picture(scene, name, 96, seed++);
    other.use(rough);
    CHECK_AGREE_BUT_FOR(other, reference, tolerance);
  }
}

TEST_CASE("integrators agree: merges that weigh as much as connections") {
  // The middle of a floor, where light hardly changes within the radius, which stays.
  Scene scene = build(path_of(4) + camera("", number("fov", 12), {0, 0, 0}) +
                      square({0, 0, 0}, {0, 0, 1}, 2, coat, {0, 1, 0}) +
                      square({0, 1.5, 2.5}, {0, 0, 0}, 1.2, metal) +
                      square({-0.5, -1.5, 3}, {0, 0, 0}, 1, black + emits(4)));
  scene.integrator.radius_alpha = 1;
  for (const float radius : {0.01f, 0.03f}) {
    CAPTURE(radius);
    scene.integrator.initial_radius = radius;
    const Picture reference = picture(scene, "path", 128, 1);
    CHECK_AGREE_BUT_FOR(picture(scene, "vcm", 64, 2), reference, vcm.tolerance);
    CHECK_AGREE_BUT_FOR(picture(scene, "bpm", 128, 3), reference,
                        (agreement::Tolerance{.bias = 0.005, .cells = 4}));
  }
  // In the first iterations, between which the radius shrinks as fast as it may.
  scene.integrator.radius_alpha = 0;
  const auto light = [&](const char* name, std::uint64_t samples) {
    scene.integrator.name = name;
    const auto film = render_test::render(scene, samples).film;
    double sum = 0;
    for (std::size_t p = 0; p < 64 * 64; ++p) sum += film.total(p).mean(0);
    return sum;
  };
  CHECK(light("bpm", 16) == doctest::Approx(light("path", 64)).epsilon(0.06));
}

TEST_CASE("integrators agree: every kind of light") {
  const Folder folder;
  const std::string map = picture(folder, "sky.exr", 8, 5, [](int x, int y) {
    return x == 2 && y == 1 ? glm::vec3(30, 20, 10)
                            : glm::vec3(0.2f * static_cast<float>(y), 0.5f, x);
  });
  const std::string point =
      "<emitter type=\"point\"><point name=\"position\" value=\"-1, -1.5, 3\"/>" +
      number("intensity", 9) + "</emitter>";
  const std::string sun =
      "<emitter type=\"directional\"><vector name=\"direction\" value=\"1, 1, -2\"/>" +
      rgb("irradiance", "3, 2, 1") + "</emitter>";
  const std::string envmap =
      "<emitter type=\"envmap\">" + file(map) +
      "<transform name=\"to_world\"><rotate x=\"1\" angle=\"90\"/></transform></emitter>";
  const std::string globe = ball({-1, -0.8, 2.4}, 0.4, black + emits(8));
  struct Case {
    const char* name;
    std::string light;
  };
  for (const auto& [name, light] : {Case{"point", point},
                                    {"directional", sun},
                                    {"constant", sky},
                                    {"envmap", envmap},
                                    {"sphere", globe},
                                    {"all but the map", point + sun + sky + globe + lamp}}) {
    CAPTURE(name);
    check_agree(build(path_of(4) + camera() + stage + light), unbiased, 32);
  }
}

TEST_CASE("integrators agree: light out of glass, into glass and through it") {
  // A glowing ball within a ball of glass: what leaves the glass is spread, what enters is
  // gathered.
  const std::string glowing =
      ball({0.3, -0.3, 0.8}, 0.6, glass) + ball({0.3, -0.3, 0.8}, 0.35, black + emits(6));
  check_agree(build(path_of(6) + camera() + floor_and_wall + glowing), all, 32, 64);
  // Under glass, a coated floor; a large light over all.
  const std::string plate = square({0, 0, 0.4}, {0, 0, 1}, 1.5, glass, {0, 1, 0});
  const std::string wide = square({0, 0, 4}, {0, 0, 0}, 3, black + emits(1), {0, 1, 0});
  check_agree(build(path_of(5) + camera() + floor_and_wall + plate + wide), {bdpt, vcm, ppm}, 32,
              128);
}

TEST_CASE("integrators agree: a mesh whose normals are not its faces'") {
  const Folder folder;
  // An octahedron that means to be a sphere.
  const auto mesh = folder.write(
      "m.ply",
      "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float "
      "z\n"
      "property float nx\nproperty float ny\nproperty float nz\nelement face 8\n"
      "property list uchar int vertex_indices\nend_header\n"
      "1 0 0 1 0 0\n-1 0 0 -1 0 0\n0 1 0 0 1 0\n0 -1 0 0 -1 0\n0 0 1 0 0 1\n0 0 -1 0 0 -1\n"
      "3 0 2 4\n3 2 1 4\n3 1 3 4\n3 3 0 4\n3 2 0 5\n3 1 2 5\n3 3 1 5\n3 0 3 5\n");
  for (const std::string& material : {grey, coat, glass}) {
    const std::string shape =
        "<shape type=\"ply\">" + file(mesh.string()) +
        "<transform name=\"to_world\"><rotate x=\"1\" y=\"0.4\" angle=\"25\"/><translate x=\"0.2\" "
        "y=\"-0.3\" z=\"1.3\"/></transform>" +
        material + "</shape>";
    check_agree(build(path_of(4) + camera() + floor_and_wall + shape + lamp),
                material == glass ? connecting : all, 32, 64);
  }
  // A leaf whose normals lean to the camera, which sees it from behind: there is nothing to see.
  const auto leaf = square_with_normal(folder, "0 0.575 0.818");
  check_agree(build(path_of(3) + camera() + floor_and_wall + lamp + "<shape type=\"ply\">" +
                    file(leaf.string()) + "<transform name=\"to_world\"><scale value=\"0.7\"/>" +
                    look({0.3, -0.3, 1.1}, {-0.075, 0.171, 1.899}, {-0.061, -0.957, 0.285}) +
                    "</transform>" + grey + "</shape>"),
              unbiased, 64);
}

TEST_CASE("integrators agree: sheets before the light and before the camera, counted or not") {
  const auto sheet = [](const glm::dvec3& at, const glm::dvec3& facing, double size,
                        const std::string& content) {
    return square(at, facing, size, content, {0.4, 0.1, 1});
  };
  const std::string sheets =
      sheet({-0.5, -0.6, 2.8}, {0, 0, 0}, 1.2, bsdf("polarizer", number("theta", 20))) +
      sheet({-0.4, -0.6, 2.6}, {0, 0, 0}, 1.2,
            bsdf("retarder", number("theta", 60) + number("delta", 70))) +
      sheet({0.4, -3, 1.8}, {0, -5, 2.5}, 0.5, bsdf("circular")) +
      sheet({-0.2, -3.3, 1.9}, {0, -5, 2.5}, 0.5, bsdf("null")) +
      sheet({-0.2, -3.2, 1.8}, {0, -5, 2.5}, 0.5,
            bsdf("retarder", number("theta", 10) + number("delta", 100)));
  for (const auto& [count, depth] :
       {std::pair{true, -1}, {true, 5}, {true, 3}, {false, -1}, {false, 3}}) {
    CAPTURE(count);
    CAPTURE(depth);
    Scene scene = build(path_of(depth) + camera() + stage + lamp + sheets);
    scene.integrator.sheets_count = count;
    check_agree(std::move(scene), count && depth == -1 ? all : unbiased, 32, 32);
  }
}

TEST_CASE("integrators agree: sheets that cover a part, before the light and before the camera") {
  const auto part = [](const std::string& sheet) {
    return "<bsdf type=\"mask\">" + number("opacity", 0.4) + sheet + "</bsdf>";
  };
  const std::string sheets =
      square({-0.5, -0.6, 2.8}, {0, 0, 0}, 1.2, part(bsdf("polarizer", number("theta", 20)))) +
      square({0.1, -3, 1.8}, {0, -5, 2.5}, 0.5,
             part(bsdf("circular", number("transmittance", 0.5))));
  check_agree(build(path_of(4) + camera() + stage + lamp + sheets), unbiased, 64);
}

TEST_CASE("integrators agree: surfaces of two sides, and a light seen from behind") {
  const std::string both = "<bsdf type=\"twosided\">" + metal + coat + "</bsdf>";
  // The light's back is dark, though its BSDF has two sides.
  const std::string light = square({-0.8, -0.8, 2.2}, {0.3, 2, 1}, 0.5,
                                   "<bsdf type=\"twosided\">" + coat + "</bsdf>" + emits(9));
  const std::string leaf = square({0.3, -0.3, 0.9}, {2, -1, 2.5}, 0.7, both);
  const std::string turned_leaf = square({-0.9, 0.4, 0.9}, {0, 2, 0.3}, 0.6, both);
  check_agree(build(path_of(4) + camera() + floor_and_wall + leaf + turned_leaf + light), all, 32,
              64);
}

TEST_CASE("integrators agree: rough glass, plastic, bumps and masks") {
  const Folder folder;
  const auto wave = [](int x, int y) {
    return glm::vec3(0.5f + 0.4f * static_cast<float>(std::sin(0.8 * x) * std::cos(0.9 * y)));
  };
  const std::string raw = "<boolean name=\"raw\" value=\"true\"/>";
  const std::string waves = picture(folder, "waves.exr", 32, 32, wave);
  const std::string bumpy = "<bsdf type=\"bumpmap\">" + bitmap("arbitrary", waves, raw) +
                            number("scale", 0.15) + coat + "</bsdf>";
  const std::string holed = "<bsdf type=\"mask\">" + bitmap("opacity", waves, raw) +
                            "<bsdf type=\"twosided\">" + coat + "</bsdf></bsdf>";
  const std::string rough_glass =
      bsdf("roughdielectric", number("alpha", 0.4) + number("int_ior", 1.5) + number("ext_ior", 1));
  const std::string detailed = square({0, 0, 0}, {0, 0, 1}, 2, bumpy, {0, 1, 0}) +
                               ball({0.5, -0.4, 0.9}, 0.6, rough_glass) +
                               square({-0.8, -0.3, 1.2}, {-0.4, -5, 2}, 0.7, holed) + lamp;
  check_agree(build(path_of(4) + camera() + detailed), all, 32, 64);
  // Its coat is a mirror, in which no light path is seen.
  const std::string plastic = square({0, 2.3, 1.9}, {0, 0, 1.6}, 1.5, bsdf("plastic"), {0, 0, 1});
  check_agree(build(path_of(4) + camera() + plastic + detailed), {bdpt, vcm, ppm}, 32, 64);
}

TEST_CASE("integrators agree: paths of one, two and three segments") {
  for (const int depth : {1, 2, 3}) {
    CAPTURE(depth);
    check_agree(
        build(path_of(depth) + camera() + stage + ball({-1, -0.8, 1.4}, 0.4, coat + emits(8))), all,
        32, 32);
  }
}

TEST_CASE("integrators agree: filters wider than a pixel, and a part of the film") {
  for (const std::string& filter :
       {"<rfilter type=\"box\">" + number("radius", 1.3) + "</rfilter>",
        std::string("<rfilter type=\"tent\"/>"), std::string("<rfilter type=\"gaussian\"/>")}) {
    CAPTURE(filter);
    const std::string crop = integer("crop_offset_x", 5) + integer("crop_offset_y", 23) +
                             integer("crop_width", 37) + integer("crop_height", 32);
    check_agree(build(path_of(3) + camera(crop + filter) + stage + lamp), unbiased, 32, 32);
  }
}

TEST_CASE(
    "integrators agree: a shifted, narrow camera that sees nothing nearer than its near plane") {
  const std::string lens = number("fov", 40) + number("near_clip", 3) + number("far_clip", 6.5) +
                           number("principal_point_offset_x", 0.13) +
                           number("principal_point_offset_y", -0.07);
  // Nearer than the plane; the wall is beyond the far one in part.
  const std::string near = ball({0, -3.2, 1.6}, 0.3, grey);
  // Beyond the far one.
  const std::string far = square({-1, 2, 1.8}, {0, -5, 2.5}, 0.4, black + emits(1));
  check_agree(build(path_of(4) + camera("", lens) + stage + lamp + near + far), all, 32, 32);
}

TEST_CASE("integrators agree: lights hidden from the camera are seen in reflections alone") {
  const std::string globe = ball({-1, -0.8, 1.4}, 0.4, coat + emits(8));
  check_agree(build(path_of(3, "<boolean name=\"hide_emitters\" value=\"true\"/>") + camera() +
                    stage + globe + sky),
              unbiased, 32, 32);
  // The half that is seen through a sheet is not hidden.
  const std::string foil = square({-0.9, -3, 1.95}, {0, -5, 2.5}, 0.42,
                                  bsdf("polarizer", number("theta", 20)), {0, 0, 1});
  check_agree(build(path_of(3, "<boolean name=\"hide_emitters\" value=\"true\"/>") + camera() +
                    stage + globe + foil),
              unbiased, 32, 32);
}

TEST_CASE("integrators agree: roulette from the first vertex on") {
  const std::string white = bsdf("diffuse", number("reflectance", 0.6));
  Scene scene = build(path_of(5) + camera() + square({0, 0, 0}, {0, 0, 1}, 2, white, {0, 1, 0}) +
                      square({0, 2.3, 1.9}, {0, 0, 1.6}, 1.5, white, {0, 0, 1}) +
                      ball({0.3, -0.3, 0.8}, 0.6, white) + lamp);
  scene.integrator.rr_depth = 1;
  check_agree(std::move(scene), all, 64);
}

TEST_CASE("integrators agree: a picture so large that photons are traced part by part") {
  // A row of tiles more than 2^20 pixels, seen from above: two parts.
  constexpr int width = 1024, height = 1040, last_rows = 16;
  Scene scene = build(path_of(2) + camera() + square({0, 0, 0}, {0, 0, 1}, 2, grey, {0, 1, 0}) +
                      square({0, 0, 3}, {0, 0, 0}, 2, black + emits(1), {0, 1, 0}));
  scene.film.width = scene.film.crop_width = width;
  scene.film.height = scene.film.crop_height = height;
  scene.sensor =
      build("<sensor type=\"perspective\">" + number("fov", 80) + "<transform name=\"to_world\">" +
            look({0, 0, 2.2}, {0, 0, 0}, {0, 1, 0}) + "</transform></sensor>" + sky)
          .sensor;
  scene.integrator.initial_radius = 0.005f;
  // Where the parts meet, and of the last.
  const auto rows = [&](const char* name) {
    scene.integrator.name = name;
    const auto film = render_test::render(scene, 1, Mode::unpolarized).film;
    const auto sum = [&](int first, int last) {
      double light = 0;
      for (int p = width * first; p < width * last; ++p)
        light += film.total(static_cast<std::size_t>(p)).mean(0);
      return light;
    };
    return std::pair{sum(height / 2, height / 2 + 64), sum(height - last_rows, height)};
  };
  const auto expected = rows("bdpt"), gathered = rows("ppm");
  CHECK(gathered.first == doctest::Approx(expected.first).epsilon(0.02));
  CHECK(gathered.second == doctest::Approx(expected.second).epsilon(0.05));
  const auto merged = rows("vcm");
  CHECK(merged.first == doctest::Approx(expected.first).epsilon(0.02));
  CHECK(merged.second == doctest::Approx(expected.second).epsilon(0.02));
}

TEST_CASE("integrators agree: a radiancemeter") {
  const std::string eye = meter({0, -5, 2.5}, {0.3, 0, 0}, {1, 0, 0});
  const std::string glassy = ball({0.3, -0.6, 0.8}, 0.5, glass);
  for (const std::string& scene : {eye + stage + lamp, eye + floor_and_wall + glassy + lamp})
    check_agree(build(path_of(5) + scene), connecting, 64, 1 << 16);
}

TEST_CASE(
    "integrators agree: both modes take the same paths, and see the same light where none is "
    "polarised") {
  Scene plain = bundled("diffuse.xml", 4);
  // Of one bounce's light, which was not polarised before, S0 is what m00 says.
  Scene polarizing = build(path_of(2) + camera() + stage + lamp);
  for (Scene* scene : {&plain, &polarizing})
    for (const char* name : {"path", "bdpt", "ptracer", "ppm", "bpm", "vcm"}) {
      CAPTURE(scene == &plain);
      CAPTURE(std::string(name));
      scene->integrator.name = name;
      const auto with = agreement::render(*scene, 4, 1),
                 without = agreement::render(*scene, 4, 1, Mode::unpolarized);
      const std::size_t components = scene == &plain ? 12 : 3;
      double largest = 0, light = 0;
      for (std::size_t p = 0; p < 64 * 64; ++p)
        for (std::size_t i = 0; i < components; ++i) {
          const double a = with.film.total(p).mean(i), b = without.film.total(p).mean(i);
          largest = std::max(largest, std::abs(a - b) / (1 + std::abs(b)));
          light += b;
        }
      CHECK(light > 0);
      CHECK(largest < 1e-4);
    }
}
