// SPDX-License-Identifier: MIT
// malus-render as its user meets it: command lines, exit statuses, files written and files left
// alone.
#include <doctest/doctest.h>
#include <sys/stat.h>

#include <chrono>
#include <csignal>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>
#include <vector>

#include "io/exr.hpp"
#include "render/command_line.hpp"
#include "scene_files.hpp"

namespace {

namespace fs = std::filesystem;
using scene_test::Folder;

struct Result {
  int status = -1;
  std::string out, err;
};

Result run(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "malus-render");
  std::vector<const char*> argv;
  for (const auto& a : arguments) argv.push_back(a.c_str());
  std::ostringstream out, err;
  Result r;
  r.status = renderer::malus_render(static_cast<int>(argv.size()), argv.data(), out, err);
  r.out = out.str();
  r.err = err.str();
  return r;
}

std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// In line 2, and what stands in line 3.
std::string scene_text(const std::string& third,
                       const std::string& sensor = "<sensor type=\"radiancemeter\"/>") {
  return scene_test::in_scene(sensor + "\n" + third);
}
const std::string sky = "<emitter type=\"constant\"/>";

/// One line that holds all parts, status 2, nothing on standard output, and what stood at the
/// output stands there.
void check_refused(const std::string& scene, std::initializer_list<std::string> parts,
                   const std::vector<std::string>& more = {}) {
  const Folder folder;
  const auto path = folder.write("scene.xml", scene);
  const auto output = folder.write("out.exr", "precious");
  std::vector<std::string> arguments{path.string(), "-o", output.string(), "--spp", "1"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const Result r = run(arguments);
  CAPTURE(scene);
  CAPTURE(r.err);
  CHECK(r.status == 2);
  CHECK(r.out.empty());
  CHECK(std::count(r.err.begin(), r.err.end(), '\n') == 1);
  for (const auto& part : parts) {
    CAPTURE(part);
    CHECK(scene_test::contains(r.err, part));
  }
  CHECK(content(output) == "precious");
  CHECK(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()) == 2);
}

}  // namespace

TEST_CASE("malus-render: --help and --version succeed") {
  const Result help = run({"--help"});
  CHECK(help.status == 0);
  CHECK_MESSAGE_HAS(help.out, "--spp", "--stokes-frame", "--stats");
  CHECK(help.err.empty());
  CHECK(run({"--version"}).status == 0);
}

TEST_CASE("malus-render: what is wrong in a scene is told with its file and line") {
  check_refused(scene_text("<shape type=\"teapot\"/>"), {"scene.xml:3", "teapot", "rectangle"});
  check_refused(scene_text("<bsdf type=\"velvet\"/>"), {"scene.xml:3", "velvet", "diffuse"});
  check_refused(scene_text("<emitter type=\"sun\"/>"), {"scene.xml:3", "sun", "directional"});
  check_refused(scene_text("<integrator type=\"photonmapper\"/>"),
                {"scene.xml:3", "photonmapper", "path"});
  check_refused(scene_text("<shape type=\"sphere\">\n<float name=\"raduis\" value=\"1\"/></shape>"),
                {"scene.xml:4", "raduis", "radius"});
  check_refused(scene_text("<shape type=\"sphere\"><float name=\"radius\" value=\"-1\"/></shape>"),
                {"scene.xml:3", "radius", "-1"});
  check_refused(
      scene_text("<shape type=\"obj\"><string name=\"filename\" value=\"none.obj\"/></shape>"),
      {"scene.xml:3", "none.obj"});
  check_refused(scene_text("<shape type=\"sphere\">"), {"scene.xml:"});
  check_refused(scene_text("<emitter type=\"constant\"/><emitter type=\"constant\"/>"),
                {"scene.xml:3", "environment"});
  check_refused(
      scene_text(
          "<integrator type=\"path\"><integer name=\"max_depth\" value=\"0\"/></integrator>"),
      {"scene.xml:3", "max_depth"});
  check_refused(
      scene_text(
          "<bsdf type=\"dielectric\"><string name=\"int_ior\" value=\"unobtainium\"/></bsdf>"),
      {"scene.xml:3", "unobtainium", "bk7"});
  check_refused(scene_text("<bsdf type=\"twosided\"><bsdf type=\"dielectric\"/></bsdf>"),
                {"scene.xml:3", "transmits"});
  check_refused(scene_text(sky, ""), {"scene.xml:1", "sensor"});
  check_refused(scene_text("<sensor type=\"radiancemeter\"/>"), {"scene.xml:3", "second"});
  check_refused(scene_text(sky, "<sensor type=\"radiancemeter\"><film type=\"hdrfilm\"/></sensor>"),
                {"scene.xml:2", "width 1"});
  check_refused("not XML at all", {"scene.xml"});
  check_refused("", {"scene.xml"});
}

TEST_CASE("malus-render: what is wrong in a scene is told with the value and what is allowed") {
  const auto sphere = [](const std::string& radius) {
    return scene_text("<shape type=\"sphere\"><float name=\"radius\" value=\"" + radius +
                      "\"/></shape>" + sky);
  };
  check_refused(sphere("1e39"), {"scene.xml:3", "radius is 1e+39 ", "reaches to 1e+39 "});
  check_refused(sphere("1e-50"), {"scene.xml:3", "radius is 1e-50 ", "allowed: a radius of 1e-18"});
  const auto camera = [](const std::string& parameters) {
    return scene_text(sky, "<sensor type=\"perspective\">" + parameters + "</sensor>");
  };
  const auto number = [](const std::string& name, const std::string& value) {
    return "<float name=\"" + name + "\" value=\"" + value + "\"/>";
  };
  check_refused(camera(number("fov", "180")), {"scene.xml:2", "\"fov\" is 180; ", "less than 180"});
  check_refused(camera(number("near_clip", "3") + number("far_clip", "2.5")),
                {"scene.xml:2", "\"far_clip\" is 2.5; ", "more than near_clip, 3"});
  check_refused(camera(number("near_clip", "20000")), {"\"far_clip\" is 10000; ", "20000"});
  check_refused(
      scene_text("<bsdf type=\"conductor\">"
                 "<rgb name=\"eta\" value=\"1, 1e-50, 1\"/><rgb name=\"k\" value=\"1, 0, 1\"/>"
                 "</bsdf>" +
                 sky),
      {"scene.xml:3", "in the channel G", "1e-50 and 0;", "allowed: one of them above 0"});
  check_refused(scene_text("<bsdf type=\"mask\"><bsdf type=\"mask\"><bsdf type=\"diffuse\"/></bsdf>"
                           "</bsdf>" +
                           sky),
                {"scene.xml:3", "its <bsdf type=\"mask\"> is masked already", "allowed: one mask"});
}

TEST_CASE("malus-render: what is wrong in a file is told with the line that asks for it") {
  const auto refusal = [](const std::string& name, const std::string& bytes,
                          const std::string& before, const std::string& after) {
    const Folder folder;
    folder.write(name, bytes);
    const auto scene = folder.write(
        "scene.xml",
        scene_text(before + "<string name=\"filename\" value=\"" + name + "\"/>" + after));
    const Result r = run({scene.string(), "-o", (folder.path() / "out.exr").string()});
    CHECK(r.status == 2);
    CHECK(std::count(r.err.begin(), r.err.end(), '\n') == 1);
    return r.err;
  };
  const auto mesh = [&](const std::string& type, const std::string& bytes) {
    return refusal("a." + type, bytes, "<shape type=\"" + type + "\">", "</shape>" + sky);
  };
  CHECK_MESSAGE_HAS(mesh("obj", "v 0 0 0\nf 1 2 3\n"), "a.obj:2: ", "(asked for in ",
                    "scene.xml:3)");
  CHECK_MESSAGE_HAS(mesh("ply", "ply\nformat runes 1.0\n"), "a.ply:2: ", "(asked for in ",
                    "scene.xml:3)");
  const auto picture = [&](const std::string& name, const std::string& bytes) {
    return refusal(name, bytes, "<texture type=\"bitmap\">", "</texture>" + sky);
  };
  CHECK_MESSAGE_HAS(picture("a.exr", "\x76\x2f\x31\x01"), "a.exr: ", "(asked for in ",
                    "scene.xml:3)");
  const std::string header("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\7\0\0\0\5\x08\x02\0\0\0....", 33);
  CHECK_MESSAGE_HAS(picture("a.png", header), "scene.xml:3: ", "a.png", "truncated or damaged",
                    "allowed: a whole PNG file");
  CHECK_MESSAGE_HAS(picture("a.png", header.substr(0, 20)), "scene.xml:3: ", "begins as a PNG",
                    "truncated or damaged");
  const std::string wide = header.substr(0, 17) + "\1\x86\xa0" + header.substr(20);
  CHECK_MESSAGE_HAS(picture("a.png", wide), "allowed: 65536 pixels a side");
  CHECK_MESSAGE_HAS(picture("a.tga", "no picture at all"), "cannot be read as a picture",
                    "allowed: OpenEXR");
  const std::string told = picture("none.png", header.substr(0, 20));
  CHECK_FALSE(scene_test::contains(told, "asked for in"));
}

TEST_CASE("malus-render: what is wrong on the command line is told in one line") {
  const std::string good = scene_text(sky);
  check_refused(good, {"-D", "NAME=VALUE"}, {"-D", "novalue"});
  check_refused(good, {"-D", "nosuch"}, {"-D", "nosuch=1"});
  check_refused(good, {"twice"}, {"-D", "a=1", "-D", "a=2"});
  check_refused(good, {"--integrator"}, {"--integrator", "magic"});
  check_refused(good, {"--mode"}, {"--mode", "magic"});
  check_refused(good, {"--sampler"}, {"--sampler", "magic"});
  check_refused(good, {"--stokes-frame"}, {"--stokes-frame", "down"});
  check_refused(good, {"--threads"}, {"--threads", "0"});
  check_refused(good, {"--seed"}, {"--seed", "-1"});
  check_refused(good, {"--time"}, {"--time", "1"});
  check_refused(good, {"nosuch"}, {"--nosuch"});
  check_refused(good, {"stats"}, {"--stats", "/no/such/folder/stats.json"});

  const Folder folder;
  const std::string scene = folder.write("scene.xml", good).string();
  const std::string output = (folder.path() / "out.exr").string();
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{},
        {scene},
        {"-o", output},
        {(folder.path() / "none.xml").string(), "-o", output},
        {folder.path().string(), "-o", output},
        {scene, "-o", output, "--spp", "0"},
        {scene, "-o", output, "--time", "nan"},
        {scene, "-o", output, "--time", "-3"},
        {scene, "-o", output, "--spp", "many"},
        {scene, "-o", (folder.path() / "no" / "out.exr").string()},
        {scene, "-o", folder.path().string()},
        {scene, "-o", ""}}) {
    const Result r = run(arguments);
    CAPTURE(r.err);
    CHECK(r.status == 2);
    CHECK(std::count(r.err.begin(), r.err.end(), '\n') == 1);
    CHECK_FALSE(fs::exists(output));
  }
}

TEST_CASE("malus-render: numbers are decimal, and none is made to fit") {
  const std::string good = scene_text(sky);
  const std::string large = "99999999999999999999999";
  check_refused(good, {"--seed", large, "in [0 - 18446744073709551615]"}, {"--seed", large});
  check_refused(good, {"--seed", "\"-1\"", "[0 - "}, {"--seed", "-1"});
  check_refused(good, {"--seed", "\"0x10\""}, {"--seed", "0x10"});
  check_refused(good, {"--threads", "\"0x2\"", "in [1 - 4096]"}, {"--threads", "0x2"});
  check_refused(good, {"--threads", "\"5000\"", "in [1 - 4096]"}, {"--threads", "5000"});
  check_refused(good, {"--first-sample", "\"1e3\""}, {"--first-sample", "1e3"});
  check_refused(good, {"--checkpoint-every", "\"0x10\""}, {"--checkpoint-every", "0x10"});
  check_refused(good, {"--strategy", "\"0x1\"", "in [0 - 1048576]"}, {"--strategy", "0x1,2"});

  const Folder folder;
  const std::string scene = folder.write("scene.xml", good).string();
  const std::string output = (folder.path() / "out.exr").string();
  REQUIRE(run({scene, "-o", output, "--spp", "010", "--seed", "18446744073709551615"}).status == 0);
  const auto image = renderer::read_exr(output);
  CHECK(image.metadata.at("malus:samples_per_pixel") == "10");
  CHECK(image.metadata.at("malus:seed") == "18446744073709551615");
}

TEST_CASE("malus-render: OpenEXR is not written under the name of another format") {
  const Folder folder;
  const std::string scene = folder.write("scene.xml", scene_text(sky)).string();
  for (const std::string name :
       {"a.png", "a.JPG", "a.jpeg", "a.hdr", "a.pfm", "a.tif", "a.tiff", "a.bmp", "a.tga"}) {
    const std::string output = (folder.path() / name).string();
    const Result r = run({scene, "-o", output, "--spp", "1"});
    CHECK(r.status == 2);
    CHECK(std::count(r.err.begin(), r.err.end(), '\n') == 1);
    CHECK_MESSAGE_HAS(r.err, "--output: ", name + "\"", "OpenEXR (.exr)", "malus-image");
    CHECK_FALSE(fs::exists(output));
  }
  for (const std::string name : {"a.EXR", "a", "a.png.exr"})
    CHECK(run({scene, "-o", (folder.path() / name).string(), "--spp", "1"}).status == 0);
}

TEST_CASE("malus-render: a file or folder that must not be written is left alone") {
  const Folder folder;
  const std::string scene = folder.write("scene.xml", scene_text(sky)).string();
  CHECK(run({scene, "-o", folder.path().string()}).status == 2);
  CHECK(run({scene, "-o", (folder.path() / "none" / "out.exr").string()}).status == 2);
  // What is read, or written already, by this name or another.
  const std::string out = (folder.path() / "new.exr").string(),
                    same = (folder.path() / "." / "scene.xml").string();
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{scene, "-o", scene},
        {scene, "-o", same},
        {scene, "-o", out, "--stats", same},
        {scene, "-o", out, "--checkpoint", scene},
        {scene, "-o", out, "--stats", out},
        {scene, "-o", out, "--checkpoint", out},
        {scene, "-o", out, "--stats", out + "s", "--checkpoint", out + "s"}}) {
    CHECK(run(arguments).status == 2);
    CHECK(content(scene) == scene_text(sky));
    CHECK_FALSE(fs::exists(out));
  }
  if (geteuid() == 0) return;  // the superuser may write anything
  const auto output = folder.write("out.exr", "precious");
  ::chmod(output.c_str(), 0444);
  CHECK(run({scene, "-o", output.string()}).status == 2);
  CHECK(content(output) == "precious");
}

TEST_CASE("malus-render: writes R G B and the four Stokes components, and says what they are") {
  const Folder folder;
  const std::string law = std::string(MALUS_SCENES_DIR) + "/malus_law.xml";
  const auto output = (folder.path() / "out.exr").string(),
             stats = (folder.path() / "stats.json").string();
  const auto up = (folder.path() / "up.exr").string();
  const Result r =
      run({law, "-o", output, "--stats", stats, "--spp", "128", "--seed", "7", "-D", "angle=30"});
  CAPTURE(r.err);
  REQUIRE(r.status == 0);
  CHECK_MESSAGE_HAS(r.out, "1 x 1", "128 samples");
  const auto image = renderer::read_exr(output);
  CHECK(image.channels.size() == 15);
  CHECK(image.plane("S0.R")[0] == doctest::Approx(0.375));
  CHECK(image.plane("R")[0] == image.plane("S0.R")[0]);
  CHECK(image.plane("S1.G")[0] == doctest::Approx(0.1875));
  CHECK(image.plane("S2.B")[0] == doctest::Approx(-0.375 * std::sqrt(0.75)));
  CHECK(image.metadata.at("malus:stokes_frame") == "horizontal");
  CHECK(image.metadata.at("malus:mode") == "optimized");
  CHECK(image.metadata.at("malus:seed") == "7");
  CHECK(image.metadata.at("malus:samples_per_pixel") == "128");

  const auto json = nlohmann::json::parse(content(stats));
  CHECK(json["measurement"]["S0"][0].get<double>() == doctest::Approx(0.375));
  CHECK(json["measurement"]["S2"][2].get<double>() == doctest::Approx(-0.375 * std::sqrt(0.75)));
  CHECK(json["standard_error"]["S0"].size() == 3);
  CHECK(json["samples"] == 128);
  CHECK(json["seed"] == 7);
  CHECK(json["interrupted"] == false);

  REQUIRE(
      run({"-o", up, "--stokes-frame", "up", "--spp", "128", "--seed", "7", "-D", "angle=30", law})
          .status == 0);
  const auto turned = renderer::read_exr(up);
  CHECK(turned.metadata.at("malus:stokes_frame") == "up");
  for (const std::string& c : image.channels) {
    const bool negated = c.starts_with("S1") || c.starts_with("S2");
    CHECK(turned.plane(c)[0] == (negated ? -image.plane(c)[0] : image.plane(c)[0]));
  }
}

TEST_CASE("malus-render: auto is the unpolarised mode bit for bit where nothing polarises") {
  const Folder folder;
  const auto render = [&](const std::string& scene, const std::string& mode) {
    const auto output = (folder.path() / (mode + ".exr")).string();
    REQUIRE(run({std::string(MALUS_SCENES_DIR) + "/" + scene, "-o", output, "--mode", mode, "--spp",
                 "2", "-D", "resolution=24"})
                .status == 0);
    return renderer::read_exr(output);
  };
  const auto automatic = render("diffuse.xml", "auto"),
             without = render("diffuse.xml", "unpolarized");
  CHECK(automatic.metadata.at("malus:mode") == "unpolarized");
  CHECK(automatic.data == without.data);
  const auto glass = render("box.xml", "auto"), with = render("box.xml", "optimized");
  CHECK(glass.metadata.at("malus:mode") == "optimized");
  CHECK(glass.data == with.data);
}

TEST_CASE("malus-render: Mitsuba's stokes wrapper and volpath are taken as they are") {
  const Folder folder;
  const auto scene = folder.write(
      "scene.xml",
      scene_text("<integrator type=\"stokes\"><integrator type=\"volpath\"/></integrator>" + sky));
  CHECK(run({scene.string(), "-o", (folder.path() / "out.exr").string()}).status == 0);
}

namespace {
void ignore_signal(int) {}
}  // namespace

TEST_CASE("malus-render: an interrupt writes what there is and exits with 130") {
  const Folder folder;
  const auto output = (folder.path() / "out.exr").string(),
             stats = (folder.path() / "stats.json").string();
  std::signal(SIGINT, ignore_signal);
  std::thread user([] {
    // Once the renderer listens, and has had time for some samples.
    for (;;) {
      struct sigaction now {};
      ::sigaction(SIGINT, nullptr, &now);
      if (now.sa_handler != ignore_signal) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    std::raise(SIGINT);
  });
  const Result r = run({std::string(MALUS_SCENES_DIR) + "/diffuse.xml", "-o", output, "--stats",
                        stats, "--time", "60", "-D", "resolution=32"});
  user.join();
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  CHECK(r.status == 130);
  CHECK_MESSAGE_HAS(r.err, "interrupted");
  const auto image = renderer::read_exr(output);
  CHECK(image.width == 32);
  CHECK(*std::max_element(image.data.begin(), image.data.end()) > 0);
  const auto json = nlohmann::json::parse(content(stats));
  CHECK(json["interrupted"] == true);
  CHECK(json["samples"].get<double>() > 0);
  CHECK(json["seconds"].get<double>() < 30);
}
