// SPDX-License-Identifier: MIT
// What is said of scenes in which an integrator has nothing to find.
#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "render/command_line.hpp"
#include "render_scenes.hpp"

using namespace render_test;
using scene_test::Folder;

namespace {

/// The exit status, and what was said.
std::pair<int, std::string> run(const std::string& content, std::vector<std::string> more) {
  const Folder folder;
  std::vector<std::string> arguments{
      "malus-render", folder.write("scene.xml", scene_test::in_scene(content)).string(),
      "-o",           (folder.path() / "out.exr").string(),
      "--spp",        "1"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  std::vector<const char*> argv;
  for (const auto& a : arguments) argv.push_back(a.c_str());
  std::ostringstream out, err;
  const int status = renderer::malus_render(static_cast<int>(argv.size()), argv.data(), out, err);
  CHECK(std::filesystem::exists(folder.path() / "out.exr") == (status == 0));
  return {status, err.str()};
}

void check_refused(const std::string& content, const std::vector<std::string>& more,
                   std::initializer_list<std::string> parts) {
  const auto [status, said] = run(content, more);
  CAPTURE(said);
  CHECK(status == 2);
  CHECK(std::count(said.begin(), said.end(), '\n') == 1);
  for (const auto& part : parts) {
    CAPTURE(part);
    CHECK(scene_test::contains(said, part));
  }
}

}  // namespace

TEST_CASE("requirements: what a scene lacks for an integrator is said, with exit status 2") {
  const std::string camera =
      "<sensor type=\"perspective\"><film type=\"hdrfilm\"><integer name=\"width\" "
      "value=\"4\"/><integer name=\"height\" value=\"4\"/></film></sensor>";
  const std::string single = meter({0, 0, -9}, {0, 0, 0}, {1, 0, 0});
  const std::string floor = square({0, 0, 5}, {0, 0, 0}, 2, "");
  const std::string around = "<shape type=\"sphere\">" + bsdf("dielectric") + "</shape>";
  const std::string beside = "<shape type=\"sphere\"><point name=\"center\" value=\"0, 0, 3\"/>" +
                             bsdf("dielectric") + "</shape>";
  for (const char* name : {"ptracer", "bdpt", "ppm", "bpm", "vcm"})
    check_refused(camera + floor, {"--integrator", name},
                  {"scene.xml", "no light", "<emitter>", std::string("\"") + name + "\""});
  const auto [black, warning] = run(camera + floor, {"--integrator", "path"});
  CHECK(black == 0);
  CHECK(scene_test::contains(warning, "no light"));

  check_refused(single + floor + sky, {"--integrator", "ptracer"},
                {"scene.xml", "radiancemeter", "\"ptracer\"", "\"bdpt\""});
  check_refused(camera + floor + around + sky, {"--integrator", "ptracer"},
                {"scene.xml", "inside glass", "\"vcm\""});
  for (const char* name : {"bdpt", "vcm", "ppm", "path"}) {
    CHECK(run(camera + floor + around + sky, {"--integrator", name}).first == 0);
    CHECK(run(single + floor + sky, {"--integrator", name}).first == 0);
  }
  CHECK(run(camera + floor + beside + sky, {"--integrator", "ptracer"}).first == 0);

  for (const char* name : {"path", "ptracer", "ppm", "bpm", "vcm"})
    check_refused(camera + floor + sky, {"--integrator", name, "--strategy", "1,2"},
                  {"--strategy", "\"bdpt\"", std::string("\"") + name + "\""});
  CHECK(run(camera + floor + sky, {"--integrator", "bdpt", "--strategy", "1,2"}).first == 0);
  check_refused(camera + floor + sky, {"--integrator", "metropolis"}, {"metropolis", "vcm"});
}
