// SPDX-License-Identifier: MIT
// What must be right though a rendering is stopped, split over machines or threads, or meets
// numbers that are none.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <variant>
#include <vector>

#include "film/exposure.hpp"
#include "integrators/counters.hpp"
#include "medium_scenes.hpp"
#include "render/checkpoint.hpp"

namespace {

using namespace render_test;
using renderer::Checkpoint;
using renderer::InputError;
using renderer::RenderOptions;
using scene_test::Folder;

constexpr const char* integrators[] = {"path", "ptracer", "bdpt", "ppm", "bpm", "vcm"};

std::string view(int width, int height) {
  return "<sensor type=\"perspective\"><transform name=\"to_world\">" +
         look({0, -5, 2}, {0, 0, 0.7}, {0, 0, 1}) +
         "</transform><film type=\"hdrfilm\"><integer name=\"width\" value=\"" +
         std::to_string(width) + "\"/><integer name=\"height\" value=\"" + std::to_string(height) +
         "\"/></film></sensor>";
}

/// A rough metal floor under a lamp; with media, a ball of a polarising one on it.
renderer::Scene picture(bool with_media, int width = 33, int height = 17) {
  return build("<integrator type=\"path\"><integer name=\"max_depth\" value=\"4\"/>" +
               number("initial_radius", 0.05) + "</integrator>" + view(width, height) +
               square({0, 0, 0}, {0, 0, 1}, 2, bsdf("roughconductor"), {0, 1, 0}) +
               (with_media ? sphere(medium(phase("rayleigh")), 0.8) : "") +
               "<shape type=\"sphere\"><point name=\"center\" value=\"0, 0, 2\"/>" +
               number("radius", 0.5) + "<emitter type=\"area\"/></shape>");
}

RenderOptions options_of(std::uint64_t samples, int threads) {
  RenderOptions options;
  options.samples_per_pixel = samples;
  options.seed = 4;
  options.threads = threads;
  return options;
}

Rendering run(const renderer::Scene& scene, const RenderOptions& options) {
  const std::atomic<bool> stop{false};
  return renderer::render(scene, options, stop, {});
}

std::size_t different(const Rendering& a, const Rendering& b) {
  const auto x = a.film.sums(), y = b.film.sums();
  REQUIRE(x.size() == y.size());
  std::size_t count = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    count += std::memcmp(&x[i], &y[i], sizeof x[i]) != 0 ? 1 : 0;
  return count;
}

bool is_lit(const Rendering& r) {
  return std::any_of(r.film.sums().begin(), r.film.sums().end(),
                     [](const auto& sum) { return sum.stokes[0] > 0; });
}

const std::map<std::string, std::string> identity = {{"scene", "a"}, {"seed", "4"}};

std::string content(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

TEST_CASE("faults: every integrator's picture has the same bits on 1, 2, 3 and 7 threads") {
  for (const bool with_media : {false, true}) {
    renderer::Scene scene = picture(with_media);
    for (const char* name : integrators) {
      scene.integrator.name = name;
      CAPTURE(scene.integrator.name);
      CAPTURE(with_media);
      const Rendering one = run(scene, options_of(9, 1));
      CHECK(is_lit(one));
      for (const int threads : {2, 3, 7})
        CHECK(different(one, run(scene, options_of(9, threads))) == 0);
    }
  }
}

TEST_CASE("faults: a rendering that goes on from a checkpoint has the bits of one never stopped") {
  const Folder folder;
  const auto path = (folder.path() / "checkpoint").string();
  for (const bool with_media : {false, true}) {
    // The larger picture has one batch, the small one several.
    renderer::Scene scene = with_media ? picture(true) : picture(false, 72, 60);
    for (const char* name : integrators) {
      scene.integrator.name = name;
      CAPTURE(scene.integrator.name);
      for (const auto sampler :
           {renderer::SamplerKind::independent, renderer::SamplerKind::sobol}) {
        RenderOptions options = options_of(11, 2);
        options.sampler = sampler;
        const Rendering whole = run(scene, options);
        // The first run is complete with fewer samples, and the second goes on to more.
        Checkpoint checkpoint(path, 1e6, identity);
        options.checkpoint = &checkpoint;
        options.samples_per_pixel = 5;
        options.threads = 1;
        run(scene, options);
        options.samples_per_pixel = 11;
        options.threads = 3;
        const Rendering resumed = run(scene, options);
        CHECK(checkpoint.failure().empty());
        CHECK(resumed.resumed_from == 5);
        CHECK(different(whole, resumed) == 0);
        CHECK(resumed.counters.rays == whole.counters.rays);
        CHECK(resumed.counters.samples == whole.counters.samples);
        checkpoint.remove();
        CHECK_FALSE(std::filesystem::exists(path));
      }
    }
  }
}

TEST_CASE(
    "faults: what of a pass was done before a stop in its midst is neither lost nor repeated") {
  const Folder folder;
  const auto scene = picture(false);
  // As many samples as a pass of so many pixels has.
  const std::uint64_t samples = (1 << 20) / (33 * 17);
  Checkpoint checkpoint((folder.path() / "checkpoint").string(), 1e6, identity);
  RenderOptions options = options_of(samples, 2);
  options.checkpoint = &checkpoint;
  options.seconds = 0.01;
  const Rendering part = run(scene, options);
  CHECK(part.samples_per_pixel == 0);
  CHECK(part.counters.samples > 0);
  options.seconds = 0;
  const Rendering resumed = run(scene, options);
  options.checkpoint = nullptr;
  const Rendering whole = run(scene, options);
  CHECK(different(whole, resumed) == 0);
  CHECK(resumed.counters.samples == whole.counters.samples);
}

TEST_CASE(
    "faults: a checkpoint of something else, cut short or changed is refused and left as it is") {
  const Folder folder;
  const auto scene = picture(false);
  const auto path = folder.path() / "checkpoint";
  RenderOptions options = options_of(2, 2);
  {
    Checkpoint checkpoint(path.string(), 1e6, identity);
    options.checkpoint = &checkpoint;
    run(scene, options);
  }
  const std::string good = content(path);
  const auto check_refused = [&](const std::string& bytes,
                                 const std::map<std::string, std::string>& who,
                                 const std::string& reason, std::uint64_t samples = 4) {
    CAPTURE(reason);
    folder.write("checkpoint", bytes);
    Checkpoint checkpoint(path.string(), 1e6, who);
    options.checkpoint = &checkpoint;
    options.samples_per_pixel = samples;
    std::string message;
    try {
      run(scene, options);
    } catch (const InputError& error) {
      message = error.what();
    }
    CAPTURE(message);
    CHECK(message.find(reason) != std::string::npos);
    CHECK(message.find("checkpoint: ") != std::string::npos);
    CHECK(content(path) == bytes);
  };
  check_refused(good, {{"scene", "b"}, {"seed", "4"}}, "its scene is \"a\"");
  check_refused(good, {{"scene", "a"}, {"seed", "5"}}, "its seed is \"4\"");
  check_refused(good, {{"scene", "a"}}, "another version");
  check_refused(good, identity, "more than the 1", 1);
  check_refused("precious", identity, "is not a checkpoint");
  check_refused("", identity, "is not a checkpoint");
  for (std::size_t length = 20; length < good.size(); length += good.size() / 37)
    check_refused(good.substr(0, length), identity, "damaged");
  check_refused(good + "x", identity, "damaged");
  for (std::size_t at = good.size() / 41 + 200; at < good.size(); at += good.size() / 41) {
    std::string changed = good;
    changed[at] = static_cast<char>(changed[at] ^ 4);
    check_refused(changed, identity, "damaged");
  }
}

TEST_CASE(
    "faults: parts of one seed by --first-sample add up to the whole, radii of merging included") {
  for (const bool with_media : {false, true}) {
    renderer::Scene scene = picture(with_media, 20, 12);
    for (const char* name : integrators) {
      scene.integrator.name = name;
      CAPTURE(scene.integrator.name);
      const Rendering whole = run(scene, options_of(8, 2));
      RenderOptions options = options_of(5, 2);
      const Rendering first = run(scene, options);
      options.samples_per_pixel = 3;
      options.first_sample = 5;
      const Rendering second = run(scene, options);
      double most = 0;
      for (std::size_t p = 0; p < 20 * 12; ++p)
        for (std::size_t i = 0; i < 12; ++i) {
          const double sum = first.film.total(p).stokes[i] + second.film.total(p).stokes[i];
          most = std::max(most, std::abs(sum - whole.film.total(p).stokes[i]) /
                                    (1e-3 + whole.film.total(p).stokes[0]));
        }
      CHECK(most < 1e-12);
    }
  }
}

TEST_CASE(
    "faults: samples that are infinite or NaN are counted and dropped by every integrator, and not "
    "spread") {
  for (const bool with_media : {false, true}) {
    // Close under the lamp the light is more than a float holds, elsewhere less.
    renderer::Scene scene =
        build("<integrator type=\"path\"><integer name=\"max_depth\" value=\"3\"/>" +
              number("initial_radius", 0.02) + "</integrator>" + view(24, 16) +
              square({0, 0, 0}, {0, 0, 1}, 2, bsdf("diffuse"), {0, 1, 0}) +
              (with_media ? sphere(medium(phase("rayleigh")), 0.8) : "") +
              "<emitter type=\"point\"><point name=\"position\" value=\"0, 0, 0.05\"/></emitter>"
              "<emitter type=\"point\"><point name=\"position\" value=\"0.3, 0, 1.5\"/></emitter>");
    auto& intensity = std::get<renderer::PointLight>(scene.lights[0]).intensity;
    for (const char* name : integrators) {
      scene.integrator.name = name;
      CAPTURE(scene.integrator.name);
      CAPTURE(with_media);
      // What one light path brings is too little to overflow.
      const bool connects = scene.integrator.name == "path" || scene.integrator.name == "bdpt" ||
                            scene.integrator.name == "vcm";
      intensity = renderer::Rgb(connects ? 1e37f : std::numeric_limits<float>::quiet_NaN());
      const Rendering r = run(scene, options_of(8, 2));
      CHECK(r.counters.non_finite > 0);
      CHECK(is_lit(r));
      for (const auto& sum : r.film.sums())
        for (const double value : sum.stokes)
          if (!(std::abs(value) < 1e300)) FAIL_CHECK("not finite");
    }
  }
}

TEST_CASE("faults: a pixel whose sum alone is not finite loses that sample and no other") {
  renderer::FilmSettings settings;
  settings.crop_width = settings.width = 3;
  settings.crop_height = settings.height = 1;
  renderer::Exposure exposure(settings, 1);
  const auto reading = [](float s0) {
    const renderer::Rgb zero(0.0f);
    return malus::Measurement<renderer::Rgb>(renderer::Rgb(s0), zero, zero, zero);
  };
  for (std::size_t p = 0; p < 3; ++p) exposure.add(p, 0, reading(1));
  exposure.add(1, 0, reading(3e38f));
  exposure.add(1, 0, reading(3e38f));
  renderer::Film film(3, 1, 1);
  CHECK(exposure.develop(0, 0, film) == 1);
  CHECK(film.total(0).mean(0) == 1);
  CHECK(film.total(1).count == 0);
  CHECK(film.total(2).mean(0) == 1);
}

TEST_CASE("faults: what extinction leaves that is no light is made light, and all other is kept") {
  using renderer::Rgb;
  const malus::Measurement<Rgb> extinguished(Rgb(-3e-9f, 1e-9f, 2e20f), Rgb(3e-9f, 4e-9f, 1e20f),
                                             Rgb(0, -3e-9f, 1e20f), Rgb(1e-12f, 0, 1e20f));
  CHECK_FALSE(renderer::is_physical(extinguished));
  const auto made = renderer::made_physical(extinguished);
  CHECK(renderer::is_physical(made));
  // Less than no light is none; of more polarised light than light its state is kept.
  for (std::size_t i = 0; i < 4; ++i) CHECK(made[i][0] == 0);
  CHECK(made[0][1] == 1e-9f);
  CHECK(made[1][1] == doctest::Approx(0.8e-9));
  CHECK(made[2][1] == doctest::Approx(-0.6e-9));
  for (std::size_t i = 0; i < 4; ++i) CHECK(made[i][2] == extinguished[i][2]);

  // Fully polarised but for rounding, of any size, and subnormal numbers with few digits.
  for (const float s0 : {0.0f, 1e-43f, 1e-30f, 1.0f, 1e30f}) {
    CAPTURE(s0);
    const Rgb s(s0), p(s0 * 1.00005f), none(0.0f);
    CHECK(renderer::is_physical(malus::Measurement<Rgb>(s, p, none, none)));
  }
  CHECK_FALSE(renderer::is_physical(
      malus::Measurement<Rgb>(Rgb(1.0f), Rgb(0.0f), Rgb(0.0f), Rgb(0, 0, -1.001f))));
}

TEST_CASE("faults: where crossed polarizers extinguish light, what is read is light all the same") {
  std::uint64_t unphysical = 0;
  // A half-wave plate turns what the farther one lets through.
  for (int theta = 0; theta < 90; theta += 5) {
    const auto sheet = [&](double y, const std::string& element) {
      return square({0, y, 0}, {0, -9, 0}, 2, element, {0, 0, 1});
    };
    const auto polarizer = [](double angle) { return bsdf("polarizer", number("theta", angle)); };
    renderer::Scene scene =
        build("<integrator type=\"path\"><integer name=\"max_depth\" value=\"8\"/></integrator>" +
              meter({0, -5, 0}, {0, 0, 0}, {1, 0, 0}) + sheet(-1, polarizer(2 * theta + 90)) +
              sheet(0, bsdf("retarder", number("theta", -theta) + number("delta", 180))) +
              sheet(1, polarizer(0)) + sky);
    for (const char* name : {"path", "bdpt", "vcm"}) {
      scene.integrator.name = name;
      CAPTURE(theta);
      CAPTURE(scene.integrator.name);
      const Rendering r = run(scene, options_of(16, 2));
      unphysical += r.counters.unphysical;
      const renderer::PixelSum sum = r.film.total(0);
      for (std::size_t c = 0; c < 3; ++c) {
        CHECK(sum.stokes[c] >= 0);
        CHECK(sum.stokes[c] < 16 * 1e-6);
        CHECK(std::hypot(sum.stokes[c + 3], sum.stokes[c + 6], sum.stokes[c + 9]) <=
              1.0002 * sum.stokes[c]);
      }
    }
  }
  CHECK(unphysical > 0);
}
