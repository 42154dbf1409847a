// SPDX-License-Identifier: MIT
// What a scene from a stranger may not do: read what lies outside of its folder unnoticed, or make
// much of little.
#include <doctest/doctest.h>
#include <unistd.h>

#include "io/exr.hpp"
#include "scene/build.hpp"
#include "scene/requirements.hpp"
#include "scene/search_path.hpp"
#include "scene/xml_file.hpp"
#include "scene_files.hpp"
#include "textures/read_texels.hpp"

namespace {

using scene_test::contains;
using scene_test::error_of;
using scene_test::Folder;
using scene_test::in_scene;

/// A scene in a folder of its own, that asks for a file of that name from beside the folder.
struct Neighbours {
  explicit Neighbours(std::string_view content) {
    root.write("neighbour.xml", "<scene version=\"3.0.0\"/>");
    root.write("neighbour.obj", "v 0 0 0\n");
    std::filesystem::create_directory(root.path() / "scene");
    std::filesystem::create_symlink("../neighbour.obj", root.path() / "scene" / "link.obj");
    scene = root.write("scene/scene.xml", in_scene(content));
  }
  scene_test::Scene read(renderer::OutsideFiles outside) const {
    return renderer::read_scene(scene, {}, outside);
  }
  Folder root;
  std::filesystem::path scene;
};

}  // namespace

TEST_CASE("scene hostile: an include from outside of the scene's folder is warned of or refused") {
  const Neighbours files("<include filename=\"../neighbour.xml\"/>");
  const auto scene = files.read(renderer::OutsideFiles::warn);
  REQUIRE(scene->file_warnings().size() == 1);
  CHECK(contains(scene->file_warnings()[0], "scene.xml:2: the file"));
  CHECK(contains(scene->file_warnings()[0], "neighbour.xml\" is outside of the scene's folder"));
  const std::string refused = error_of([&] { files.read(renderer::OutsideFiles::refuse); });
  CHECK(contains(refused, "scene.xml:2: "));
  CHECK(contains(refused, "outside of the scene's folder"));
}

TEST_CASE("scene hostile: a link or an added folder that leads out is seen through") {
  for (const std::string name : {"link.obj", "../neighbour.obj", "neighbour.obj"}) {
    CAPTURE(name);
    const Neighbours files(
        "<path value=\"..\"/><shape type=\"obj\"><string name=\"filename\" value=\"" + name +
        "\"/></shape>");
    const auto scene = files.read(renderer::OutsideFiles::refuse);
    const std::string refused = error_of([&] { scene->children("shape")[0]->file("filename"); });
    CHECK(contains(refused, "outside of the scene's folder"));
  }
}

TEST_CASE("scene hostile: files within the scene's folder are read without a word") {
  const Folder folder;
  folder.write("parts/a.xml", "<scene version=\"3.0.0\"><include filename=\"b.xml\"/></scene>");
  folder.write("parts/b.xml", "<scene version=\"3.0.0\"/>");
  const auto path =
      folder.write("scene.xml", in_scene("<include filename=\"parts/../parts/a.xml\"/>"));
  CHECK(renderer::read_scene(path, {}, renderer::OutsideFiles::refuse)->file_warnings().empty());
}

TEST_CASE("scene hostile: includes that multiply are stopped") {
  const Folder folder;
  for (int level = 1; level <= 6; ++level) {
    std::string content;
    for (int i = 0; i < 10 && level < 6; ++i)
      content += "<include filename=\"" + std::to_string(level + 1) + ".xml\"/>";
    folder.write(std::to_string(level) + ".xml", in_scene(content));
  }
  const std::string error = error_of([&] { renderer::read_scene(folder.path() / "1.xml", {}); });
  CHECK(contains(error, "more than 10000 files are included"));
}

TEST_CASE("scene hostile: an exr's attribute isn't believed to be longer than the file") {
  const Folder folder;
  renderer::write_exr(folder.path() / "whole.exr", renderer::Image(2, 2, {"R", "G", "B"}));
  std::string bytes = renderer::read_bytes(folder.path() / "whole.exr", 1 << 20);
  const std::size_t type = bytes.find("chlist");
  REQUIRE(type != std::string::npos);
  bytes.replace(type + 7, 4, "\xff\xff\xff\x7f");
  const auto damaged = folder.write("damaged.exr", bytes);
  const std::string error = error_of([&] { renderer::read_exr(damaged); });
  CHECK(contains(error, "damaged.exr: "));
  CHECK(contains(error, "\"channels\" claims 2147483647 bytes"));
}

TEST_CASE("scene hostile: shapes and lights too small or too large for their numbers are refused") {
  const auto error = [](const std::string& shape, const std::string& scale) {
    const auto scene = scene_test::read("<sensor type=\"perspective\"/><shape type=\"" + shape +
                                        "\"><transform name=\"to_world\">" + "<scale value=\"" +
                                        scale + "\"/></transform><emitter type=\"area\"/></shape>");
    return error_of([&] { renderer::build_scene(*scene); });
  };
  CHECK(error("rectangle", "1") == "no error");
  CHECK(
      contains(error("rectangle", "1e-20"), "scene.xml:2: <emitter type=\"area\">: the shape has"));
  CHECK(contains(error("rectangle", "1e20"), "allowed: coordinates up to 1e+18"));
  CHECK(contains(error("sphere", "1e-20"), "allowed: a radius of 1e-18 or more"));
  CHECK(contains(error("sphere", "1e19"), "up to 1e+18 from the origin"));
}

TEST_CASE("scene hostile: triangles that a transform leaves without an area are warned of") {
  const auto scene = scene_test::read(
      "<sensor type=\"perspective\"/><emitter type=\"constant\"/>"
      "<shape type=\"cube\"><transform name=\"to_world\"><scale x=\"1e-38\"/></transform></shape>");
  const auto warnings = renderer::build_scene(*scene).warnings;
  REQUIRE(warnings.size() == 1);
  CHECK(contains(warnings[0], "scene.xml:2: <shape type=\"cube\">: 8 of its 12 triangles"));
}

TEST_CASE("scene hostile: a film that the memory doesn't hold is refused before it is begun") {
  const auto scene = scene_test::read(
      "<sensor type=\"perspective\"><film type=\"hdrfilm\"><integer name=\"width\" "
      "value=\"65536\"/>"
      "<integer name=\"height\" value=\"65536\"/></film></sensor><emitter type=\"constant\"/>");
  renderer::Scene built = renderer::build_scene(*scene);
  const std::string error = error_of([&] { renderer::check_requirements(built, "scene.xml"); });
  // A terabyte would hold it.
  if (static_cast<double>(::sysconf(_SC_PHYS_PAGES)) *
          static_cast<double>(::sysconf(_SC_PAGESIZE)) <
      8e11)
    CHECK(contains(error, "scene.xml:2: a film of 65536 x 65536 pixels takes 687 GB"));
}

TEST_CASE("scene hostile: a picture without pixels is refused") {
  const Folder folder;
  std::string bitmap("BM\x1a\0\0\0\0\0\0\0\x1a\0\0\0\x0c\0\0\0\0\0\1\0\1\0\x18\0", 26);
  const auto path = folder.write("empty.bmp", bitmap);
  CHECK(contains(error_of([&] { renderer::read_texels(path, false); }), "empty.bmp: "));
  const auto filled = folder.write("filled.jpg", "\xff\xff\xd8\xff\xc4");
  CHECK(contains(error_of([&] { renderer::read_texels(filled, false); }), "begins with"));
}
