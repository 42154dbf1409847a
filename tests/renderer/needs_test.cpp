// SPDX-License-Identifier: MIT
// What a scene needs of polarisation: what is skipped changes no picture, and what nearly could be
// skipped would.
#include "scene/needs.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <random>
#include <vector>

#include "agreement_scenes.hpp"
#include "render/command_line.hpp"

using namespace agreement;
using glm::dvec3;
using renderer::find_needs;
using renderer::Needs;

namespace {

using Pixels = std::vector<std::array<double, 12>>;

/// Little noise is asked for, but every path is the same in all modes: no roulette.
Pixels pixels_of(const Rendering& r) {
  Pixels result(static_cast<std::size_t>(r.film.width() * r.film.height()));
  for (std::size_t i = 0; i < result.size(); ++i)
    for (std::size_t c = 0; c < 12; ++c) result[i][c] = r.film.total(i).mean(c);
  return result;
}
Pixels pixels(const Scene& scene, Mode mode) { return pixels_of(render(scene, 4, mode)); }
/// Of light paths whose vertices hold all of their light, or intensities alone.
Pixels pixels(const Scene& scene, bool stores_polarization) {
  renderer::RenderOptions options;
  options.samples_per_pixel = 4;
  options.threads = 2;
  options.stores_polarization = stores_polarization;
  const std::atomic<bool> stop{false};
  return pixels_of(renderer::render(scene, options, stop, {}));
}

/// The largest difference, in parts of the brightest pixel; 0 of two black pictures.
double apart(const Pixels& a, const Pixels& b) {
  double difference = 0, brightest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t c = 0; c < 12; ++c) {
      difference = std::max(difference, std::abs(a[i][c] - b[i][c]));
      brightest = std::max(brightest, a[i][c]);
    }
  return brightest > 0 ? difference / brightest : difference;
}
constexpr double rounding = 1e-5;

Scene small(const std::string& content, const std::string& algorithm) {
  Scene scene = build(content);
  renderer::set_integrator(scene.integrator, algorithm);
  scene.integrator.rr_depth = 100;
  return scene;
}

Scene skipping(const std::string& content, const std::string& algorithm) {
  Scene scene = small(content, algorithm);
  renderer::skip_what_is_not_needed(find_needs(scene), scene);
  return scene;
}

/// One digit for each element, in the file's order: 1 if it matters.
std::string shown(const Needs& needs) {
  std::string result;
  for (const auto& e : needs.elements) result += e.matters ? '1' : '0';
  return result;
}

/// Elements matter as `expected`; skipping the others changes nothing, and skipping any one of the
/// `tight` would be seen.
void check_needs(const std::string& content, const std::string& expected, const std::string& tight,
                 const std::vector<std::string>& algorithms = {"path", "bdpt", "vcm"}) {
  for (const std::string& algorithm : algorithms) {
    CAPTURE(algorithm);
    const Scene scene = small(content, algorithm);
    const Needs needs = find_needs(scene);
    REQUIRE(shown(needs) == expected);
    const Pixels followed = pixels(scene, Mode::optimized);
    const Scene less = skipping(content, algorithm);
    CHECK(find_needs(less).elements.size() ==
          static_cast<std::size_t>(std::count(expected.begin(), expected.end(), '1')));
    CHECK(apart(followed, pixels(less, Mode::optimized)) < rounding);
    if (!needs.polarization()) CHECK(apart(followed, pixels(scene, Mode::unpolarized)) < rounding);
    for (std::size_t i = 0; i < tight.size(); ++i) {
      if (tight[i] == '0') continue;
      CAPTURE(i);
      Scene eager = small(content, algorithm);
      Needs eager_needs = find_needs(eager);
      eager_needs.elements[i].matters = false;
      renderer::skip_what_is_not_needed(eager_needs, eager);
      CHECK(apart(followed, pixels(eager, Mode::optimized)) > 10 * rounding);
    }
  }
}

/// Looks along +y, from y = -5.
std::string eye_with(const std::string& film) {
  return "<sensor type=\"perspective\">" + number("fov", 40) + "<transform name=\"to_world\">" +
         look({0, -5, 1}, {0, 0, 1}, {0, 0, 1}) + "</transform><film type=\"hdrfilm\">" +
         integer("width", 16) + integer("height", 16) + film + "</film></sensor>\n";
}
const std::string eye = eye_with("<rfilter type=\"box\"/>");
/// A floor and a wall, both diffuse, fill the picture.
const std::string furniture =
    square({0, 0, 0}, {0, 0, 1}, 6, grey, {0, 1, 0}) +
    square({0, 4, 2}, {0, 0, 2}, 4, grey, {0, 0, 1}) +
    "<emitter type=\"point\"><point name=\"position\" value=\"1, -3, 3\"/>"
    "<rgb name=\"intensity\" value=\"30\"/></emitter>\n";
const std::string room = eye + furniture;
const std::string lit_room = room + path_of(5);

}  // namespace

TEST_CASE("needs: what only diffuse surfaces precede is skipped, and the same in view is not") {
  // Behind the camera, facing the room.
  const auto mirror = [](double y) { return square({0, y, 1.5}, {0, 0, 1}, 1.5, coat, {0, 0, 1}); };
  check_needs(lit_room + mirror(-6), "0", "");
  check_needs(lit_room + mirror(2), "1", "1");
  // Beside the picture, whose right edge is at x = 5 tan 20° = 1.82 over the origin; and on it.
  const auto beside = [](double x) { return ball({x, 0, 1}, 0.5, metal); };
  check_needs(lit_room + beside(2.36), "0", "");
  check_needs(lit_room + beside(2.34), "1", "", {"path"});
  check_needs(lit_room + beside(2.3), "1", "1");
  // A wide filter sees farther, a part of the film less far.
  const std::string rest = furniture + path_of(5);
  const std::string wide = "<rfilter type=\"gaussian\">" + number("stddev", 1) + "</rfilter>";
  check_needs(eye_with(wide) + rest + beside(2.8), "1", "", {"path"});
  check_needs(eye_with(wide) + rest + beside(4), "0", "");
  const std::string left = "<rfilter type=\"box\"/>" + integer("crop_width", 8);
  check_needs(eye_with(left) + rest + beside(0.6), "0", "");
  check_needs(eye_with(left) + rest + beside(0.3), "1", "1");
  // A single ray hits or misses.
  const auto ray = [](double x) { return meter({0, -5, 1}, {x, 0, 1}, {1, 0, 0}); };
  check_needs(ray(0.95) + rest + beside(0.5), "1", "1", {"path", "bdpt"});
  check_needs(ray(1.05) + rest + beside(0.5), "0", "", {"path", "bdpt"});
  // The camera sees the back of what reflects on its front alone.
  const auto turned = [](double y) { return square({0, 0, 1}, {0, y, 1}, 0.5, coat, {0, 0, 1}); };
  check_needs(lit_room + turned(1), "0", "");
  check_needs(lit_room + turned(-1), "1", "1");
}

TEST_CASE("needs: what another polarising element may see is not skipped") {
  // The ball is in view. The square behind the camera faces away from it, or nearly so.
  const std::string stand =
      lit_room + ball({0, 0, 1}, 0.8, metal) + square({0, -9, 2}, {0, -5, 2}, 3, grey, {0, 0, 1});
  const auto behind = [](double z) {
    return square({0, -7, 1}, {0, -7 - std::cos(z), 1 + std::sin(z)}, 1.5, coat, {1, 0, 0});
  };
  check_needs(stand + behind(0), "10", "1");
  check_needs(stand + behind(1), "10", "1");
  check_needs(stand + behind(2.2), "11", "11");
  // What has two sides sees the ball behind it; of two with a BSDF each, that counts which does.
  const auto pane = [&](const std::string& material) {
    return stand + square({0, -7, 1}, {0, -8, 1}, 1.5, material, {0, 0, 1});
  };
  const auto sides = [](const std::string& front, const std::string& back) {
    return "<bsdf type=\"twosided\">" + front + back + "</bsdf>";
  };
  check_needs(pane(sides(coat, "")), "11", "11", {"path", "vcm"});
  check_needs(pane(sides(coat, grey)), "10", "1", {"path", "vcm"});
  check_needs(pane(sides(grey, coat)), "11", "11", {"path", "vcm"});
  check_needs(pane(sides(coat, metal)), "101", "101", {"path"});
  check_needs(pane(bsdf("roughdielectric")), "11", "1", {"path"});
  check_needs(pane(bsdf("polarizer")), "11", "1", {"path"});
  // Its top reaches above the square's plane by a tenth.
  const double tilt = std::asin(0.7 / 7.0);
  check_needs(stand + behind(pi / 2 - tilt), "11", "1", {"path"});
  check_needs(stand + behind(pi / 2 - std::asin(0.9 / 7.0)), "10", "1", {"path"});
}

TEST_CASE("needs: two walls in a plane, and what is behind a wall, are not seen from it") {
  const auto floor_at = [](double x, double z) {
    return square({x, -7, z}, {x, -7, z + 1}, 0.5, coat, {0, 1, 0});
  };
  check_needs(lit_room + floor_at(-2, 0.5) + floor_at(2, 0.5), "00", "");
  check_needs(lit_room + floor_at(-2, 0.5) + floor_at(2, 0.1), "00", "");
  // Face to face, at any distance.
  const std::string above = square({-2, -7, 2}, {-2, -7, 0}, 0.5, coat, {0, 1, 0});
  check_needs(lit_room + floor_at(-2, 0.5) + above, "11", "", {"path", "vcm"});
  check_needs(lit_room + floor_at(-2, 0.5) + floor_at(2, 0.1) + above, "111", "", {"path"});
}

TEST_CASE("needs: merging gives light to what is near, unless nothing else is") {
  const auto hidden = [](double z) { return lit_room + ball({0, -5.6, z}, 0.3, metal); };
  check_needs(hidden(0.31), "0", "", {"path", "bdpt"});
  check_needs(hidden(0.31), "1", "", {"bpm", "vcm"});
  check_needs(hidden(0.6), "0", "", {"bpm", "vcm"});
}

TEST_CASE("needs: paths that are too long don't count") {
  const std::string seen = ball({0.5, 0, 0.8}, 0.6, metal), hidden = ball({0, -7, 2}, 0.6, metal);
  check_needs(
      room + seen + hidden + path_of(1) + square({0, 3, 1}, {0, 0, 1}, 0.5, black + emits(1)), "00",
      "");
  check_needs(room + seen + hidden + path_of(2), "10", "1");
  check_needs(room + seen + hidden + path_of(3), "11", "1");
  check_needs(room + hidden + ball({0, -8, 1}, 0.3, metal) + path_of(3), "00", "");
  check_needs(room + hidden + ball({0, -8, 1}, 0.3, metal) + path_of(4), "11", "");
  // Sheets count for "path", not for "volpath".
  const std::string lamp_behind_sheet = square({0, 3, 1}, {0, 0, 1}, 0.5, black + emits(1)) +
                                        square({0, 1, 1}, {0, 0, 1}, 1, bsdf("polarizer"));
  check_needs(room + lamp_behind_sheet + path_of(2), "1", "1", {"path", "volpath"});
  check_needs(room + lamp_behind_sheet + path_of(1), "1", "1", {"volpath"});
  CHECK(shown(find_needs(small(room + lamp_behind_sheet + path_of(1), "path"))) == "0");
}

TEST_CASE("needs: what is never met or takes all light is no element") {
  const auto masked = [](double opacity) {
    return ball({0, 0, 1}, 0.8,
                "<bsdf type=\"mask\">" + number("opacity", opacity) + metal + "</bsdf>");
  };
  check_needs(lit_room + masked(0), "", "");
  check_needs(lit_room + masked(0.3), "1", "1");
  const auto reflecting = [](double r) {
    return ball({0, 0, 1}, 0.8,
                bsdf("pplastic", number("diffuse_reflectance", 0) +
                                     number("specular_reflectance", r) + number("alpha", 0.3)));
  };
  check_needs(lit_room + reflecting(0), "", "");
  check_needs(lit_room + reflecting(1), "1", "1");
  CHECK(find_needs(build(lit_room + reflecting(0))).idle.size() == 1);
}

TEST_CASE("needs: a retarder by itself is skipped, between polarising elements it is not") {
  const auto sheet = [](double y, const std::string& type) {
    return square({0, y, 1}, {0, -9, 1}, 2, bsdf(type, number("theta", 20)), {0, 0, 1});
  };
  const std::string bent = ball({0, 0, 1}, 0.8, metal);
  check_needs(lit_room + sheet(-2, "retarder"), "0", "");
  check_needs(lit_room + sheet(-2, "retarder") + sheet(-1, "retarder"), "00", "");
  check_needs(lit_room + sheet(-2, "polarizer"), "1", "1");
  check_needs(lit_room + sheet(-2, "retarder") + bent, "11", "11");
  check_needs(lit_room + sheet(-2, "retarder") + sheet(-1, "polarizer"), "11", "11");
  check_needs(lit_room + sheet(-3, "retarder") + sheet(-2, "retarder") + bent, "111", "111",
              {"path"});
  // Behind the camera, a polarizer takes half of what passes.
  check_needs(lit_room + sheet(-6, "polarizer"), "0", "");
  check_needs(lit_room + square({0, -6, 1}, {0, -9, 1}, 2,
                                "<bsdf type=\"mask\">" + number("opacity", 0.4) + bsdf("circular") +
                                    "</bsdf>"),
              "0", "");
  // Light that passes it straight meets the ball no more.
  check_needs(lit_room + sheet(-6, "retarder") + ball({0, -8, 1}, 0.5, metal), "00", "");
}

TEST_CASE("needs: media count where they are seen, or see themselves") {
  const auto cloud = [](double x, const std::string& phase) {
    return "<shape type=\"sphere\"><point name=\"center\" value=\"" + text({x, 0, 1}) + "\"/>" +
           number("radius", 0.8) + bsdf("null") +
           "<medium type=\"homogeneous\" name=\"interior\">" + number("sigma_t", 0.7) +
           number("albedo", 0.9) + "<phase type=\"" + phase + "\"/></medium></shape>\n";
  };
  check_needs(room + path_of(5) + cloud(0, "hg"), "", "", {"path"});
  check_needs(room + path_of(4) + cloud(0, "rayleigh"), "1", "1", {"path", "bdpt"});
  check_needs(room + path_of(2) + cloud(0, "rayleigh"), "1", "1", {"volpath"});
  // Not seen: light, a scattering, and the wall; one scattering more.
  check_needs(room + path_of(3) + cloud(2.8, "rayleigh"), "0", "", {"volpath", "vcm"});
  check_needs(room + path_of(4) + cloud(2.8, "rayleigh"), "1", "", {"volpath"});
  // In a body with an open side, or around one, it is everywhere.
  const auto jar = [](const std::string& shape, double x, const std::string& side) {
    return "<shape type=\"" + shape + "\"><transform name=\"to_world\"><scale value=\"0.5\"/>" +
           "<translate value=\"" + text({x, 0, 1}) + "\"/></transform>" + bsdf("null") +
           "<medium type=\"homogeneous\" name=\"" + side + "\">" + number("sigma_t", 0.2) +
           "<phase type=\"rayleigh\"/></medium></shape>\n";
  };
  check_needs(room + path_of(3) + jar("cube", 3, "interior"), "0", "", {"volpath"});
  check_needs(room + path_of(3) + jar("cube", 2, "interior"), "1", "1", {"volpath"});
  check_needs(room + path_of(3) + jar("cube", 3, "exterior"), "1", "", {"volpath"});
  check_needs(room + path_of(3) + jar("rectangle", 3, "interior"), "1", "", {"volpath"});
  // A square turned away from it is in the picture.
  const std::string before = square({0, -0.9, 1}, {0, -4, 1}, 0.4, coat, {0, 0, 1});
  check_needs(room + path_of(3) + before + cloud(2.8, "rayleigh"), "10", "1", {"volpath", "bdpt"});
}

namespace {

/// Two to five things of any material, anywhere about the room.
std::string random_things(std::mt19937& random) {
  const auto pick = [&](int n) { return std::uniform_int_distribution<int>(0, n - 1)(random); };
  const auto place = [&](double most) {
    const auto from = [&](double low) {
      return std::uniform_real_distribution<double>(low, most)(random);
    };
    const double x = from(-most), y = from(-most);
    return dvec3(x, y - 3, std::abs(from(-most)) + 0.1);
  };
  const std::string coated = "<bsdf type=\"twosided\">" + coat + grey + "</bsdf>";
  const std::string masked = "<bsdf type=\"mask\">" + number("opacity", 0.5) + metal + "</bsdf>";
  const std::vector<std::string> materials{coat,
                                           metal,
                                           glass,
                                           bsdf("conductor"),
                                           bsdf("polarizer"),
                                           bsdf("retarder"),
                                           coated,
                                           masked,
                                           bsdf("roughdielectric", number("alpha", 0.3))};
  std::string things;
  for (int i = pick(4) + 2; i > 0; --i) {
    const std::string& material = materials[static_cast<std::size_t>(pick(9))];
    const dvec3 at = place(6);
    const int shape = pick(6);
    if (shape < 2)
      things += ball(at, 0.6, material);
    else if (shape == 2)
      things += "<shape type=\"cube\"><transform name=\"to_world\"><scale value=\"0.4\"/>" +
                look(at, place(6), {0.3, 1, 0.2}) + "</transform>" + material + "</shape>\n";
    else
      things += square(at, place(6), 0.3 * (1 + pick(5)), material);
  }
  return things;
}

}  // namespace

TEST_CASE("needs: in random scenes, what is skipped changes no picture") {
  std::mt19937 random(7);
  std::size_t skipped = 0, kept = 0;
  constexpr int scenes = 60;
  for (int i = 0; i < scenes; ++i) {
    const std::string content =
        room + random_things(random) + path_of(3 + static_cast<int>(random() % 3));
    const std::string algorithm =
        std::vector<std::string>{"path", "bdpt", "vcm", "bpm"}[random() % 4];
    const Scene scene = small(content, algorithm);
    const Needs needs = find_needs(scene);
    const std::size_t matter = needs.count_mattering();
    kept += matter;
    skipped += needs.elements.size() - matter;
    if (matter == needs.elements.size()) continue;
    CAPTURE(content);
    CAPTURE(algorithm);
    const Pixels followed = pixels(scene, Mode::optimized);
    CHECK(apart(followed, pixels(skipping(content, algorithm), Mode::optimized)) < rounding);
    if (matter == 0) CHECK(apart(followed, pixels(scene, Mode::unpolarized)) < rounding);
  }
  CHECK(skipped > kept / 10);
}

TEST_CASE("needs: photons may be polarised where a rough surface that polarises receives them") {
  const std::string glass_ball = ball({-1, 0, 1}, 0.6, glass);
  const std::string seen = square({1, 0, 1}, {1, -1, 1}, 0.5, coat, {0, 0, 1});
  const auto check = [](const std::string& content, bool stored) {
    for (const char* algorithm : {"bdpt", "bpm", "vcm"}) {
      const Scene scene = small(content, algorithm);
      CAPTURE(content);
      CAPTURE(algorithm);
      CHECK(find_needs(scene).stored_polarization() == stored);
      // Where they need not be, the picture is the same of intensities alone; else it isn't.
      const double difference = apart(pixels(scene, true), pixels(scene, false));
      CHECK((difference > rounding) == stored);
    }
  };
  check(lit_room + glass_ball, false);
  check(lit_room + seen, false);
  // Between the lamp and what it shines on.
  check(lit_room + ball({1, -1.5, 2}, 0.4, glass) + seen, true);
}

namespace {

struct Said {
  int status;
  std::string out, err;
};

Said malus_render(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "malus-render");
  std::vector<const char*> argv;
  for (const auto& a : arguments) argv.push_back(a.c_str());
  std::ostringstream out, err;
  const int status = renderer::malus_render(static_cast<int>(argv.size()), argv.data(), out, err);
  return {status, out.str(), err.str()};
}

std::string explained(const std::string& scene, const std::string& integrator,
                      const std::string& mode = "auto") {
  const Said said = malus_render({std::string(MALUS_SCENES_DIR) + "/" + scene, "--explain",
                                  "--integrator", integrator, "--mode", mode});
  CHECK(said.status == 0);
  CHECK(said.err.empty());
  return said.out;
}

}  // namespace

TEST_CASE("needs: --explain says which code runs and why, and renders nothing") {
  CHECK_MESSAGE_HAS(explained("diffuse.xml", "path"), "unpolarized), since nothing polarises",
                    "no code for media", "shadow rays end at the first surface", "None are traced");
  CHECK_MESSAGE_HAS(explained("diffuse.xml", "vcm", "optimized"), "as asked for",
                    "\"auto\" would render intensities alone");
  CHECK_MESSAGE_HAS(explained("box.xml", "vcm"), "optimized), since all of 2 elements",
                    "dielectric (line 98) of the sphere \"glass\" (line 95): matters, since the "
                    "sensor may see it, and it may exchange light with the sphere \"metal\"",
                    "a photon", "the intensity alone is kept");
  CHECK_MESSAGE_HAS(explained("glossy.xml", "vcm"), "Its light is a Stokes vector");
  CHECK_MESSAGE_HAS(explained("box.xml", "path", "unpolarized"), "would matter");
  CHECK_MESSAGE_HAS(explained("sky_slab.xml", "path"), "what is scattered in \"atmosphere\"",
                    "drawn by the polarisation that a path carries", "Distances are drawn in");
  CHECK_MESSAGE_HAS(explained("sugar_jar.xml", "bdpt"), "extinction in \"syrup\"", "2 shapes");
  CHECK_MESSAGE_HAS(explained("bathroom.xml", "path"), "bathroom/things.xml:", "32 elements",
                    "texture coordinates of 3 shapes of 44");

  const scene_test::Folder folder;
  const auto scene =
      folder.write("scene.xml", scene_test::in_scene(lit_room + ball({0, -8, 1}, 0.5, metal)));
  const Said hidden = malus_render({scene.string(), "--explain"});
  CHECK_MESSAGE_HAS(hidden.out, "since what can polarise doesn't matter",
                    "neither the sensor nor anything else that polarises may see it");
  const std::string panel = explained("hidden_panel.xml", "vcm");
  CHECK_MESSAGE_HAS(panel, "roughconductor (line 51) of the rectangle \"panel\" (line 45)",
                    "unpolarized), since what can polarise doesn't matter");
  CHECK_FALSE(scene_test::contains(panel, "edge"));
  CHECK_MESSAGE_HAS(malus_render({std::string(MALUS_SCENES_DIR) + "/hidden_panel.xml", "--explain",
                                  "-D", "turn=125"})
                        .out,
                    "matters, since the sensor may see it");
  const auto cut_off = folder.write(
      "cut_off.xml", scene_test::in_scene(room + ball({0, 0, 1}, 0.5, metal) + path_of(1)));
  CHECK_MESSAGE_HAS(malus_render({cut_off.string(), "--explain"}).out, "of at most 1 edge.");
  std::filesystem::remove(cut_off);
  CHECK(malus_render({scene.string()}).status == 2);
  CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 1);
}

TEST_CASE("needs: --stats counts what was skipped, and what was not") {
  const scene_test::Folder folder;
  const std::string out = (folder.path() / "out.exr").string(),
                    stats = (folder.path() / "stats.json").string();
  const auto run = [&](const std::string& content, const std::string& mode) {
    const auto scene = folder.write("scene.xml", scene_test::in_scene(content));
    REQUIRE(malus_render({scene.string(), "-o", out, "--stats", stats, "--spp", "16",
                          "--integrator", "vcm", "--mode", mode})
                .status == 0);
    std::ifstream file(stats);
    const auto json = nlohmann::json::parse(file);
    CHECK(json["connections"]["tried"] == json["connections"]["shadowed"].get<std::uint64_t>() +
                                              json["connections"]["open"].get<std::uint64_t>());
    CHECK(json["merges"] == json["merged_light"]["intensity"].get<std::uint64_t>() +
                                json["merged_light"]["stokes_vector"].get<std::uint64_t>());
    CHECK(json["light_vertices"] == json["stored_light"]["intensity"].get<std::uint64_t>() +
                                        json["stored_light"]["stokes_vector"].get<std::uint64_t>());
    return json;
  };
  // The hidden square scatters much of the light.
  const std::string hidden = lit_room + square({0, -7, 2}, {0, 0, 2}, 2, coat, {0, 0, 1});
  const auto skipped = run(hidden, "auto"), followed = run(hidden, "optimized");
  CHECK(skipped["mode"] == "unpolarized");
  CHECK(skipped["polarizing_elements"] == 1);
  CHECK(skipped["skipped_elements"] == 1);
  CHECK(skipped["stored_light"]["stokes_vector"] == 0);
  CHECK(followed["skipped_elements"] == 0);
  CHECK(followed["stored_light"]["stokes_vector"] > 0);
  // All that is seen depolarises.
  CHECK(followed["merged_light"]["intensity"] > 0);
  CHECK(followed["merged_light"]["stokes_vector"] == 0);
  CHECK(followed["connections"]["shadowed"] > 0);
  CHECK(followed["connections"]["left_to_chance"] > 0);
  CHECK(followed["mueller_forms"]["full"] > 0);

  const auto some = run(hidden + square({0, 1, 1}, {0, -5, 1}, 0.4, coat, {0, 0, 1}) +
                            square({0, 3, 1}, {0, 9, 1}, 0.4, coat, {0, 0, 1}),
                        "auto");
  CHECK(some["mode"] == "optimized");
  CHECK(some["polarizing_elements"] == 3);
  CHECK(some["skipped_elements"] == 1);
  const auto& paths = some["camera_paths"];
  CHECK(paths["not_evaluated"] > 0);
  CHECK(paths["not_evaluated"] < paths["scatterings"]);
  CHECK(some["merged_light"]["stokes_vector"] > 0);

  // Two walls and no light between them but the lamp's, which most paths meet behind a wall.
  const auto dark = run(eye + square({0, 0, 0}, {0, 0, 1}, 6, coat, {0, 1, 0}) +
                            square({0, -3, -2}, {0, -3, -3}, 0.5, black + emits(1)) + path_of(4),
                        "optimized");
  CHECK(dark["camera_paths"]["without_light"] == dark["samples"]);
  CHECK(dark["camera_paths"]["not_evaluated"] == dark["camera_paths"]["scatterings"]);
}
