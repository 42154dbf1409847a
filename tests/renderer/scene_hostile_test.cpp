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

TEST_CASE("scene hostile: a file included so often that its elements are too many is stopped") {
  const Folder folder;
  std::string defaults, includes;  // the elements that leave least
  for (int i = 0; i < 20000; ++i) defaults += "<default name=\"a\" value=\"\"/>";
  folder.write("part.xml", in_scene(defaults));
  for (int i = 0; i < 150; ++i) includes += "<include filename=\"part.xml\"/>\n";
  const auto path = folder.write("scene.xml", in_scene(includes));
  CHECK_MESSAGE_HAS(error_of([&] { renderer::read_scene(path, {}); }),
                    "part.xml:2: ", "more than 2000000 elements", "allowed: 2000000");
}

TEST_CASE("scene hostile: a file included so often that its bytes are too many is stopped") {
  const Folder folder;
  std::string includes;
  folder.write("part.xml", in_scene("<!--" + std::string(16 << 20, '-') + "->"));
  for (int i = 0; i < 20; ++i) includes += "<include filename=\"part.xml\"/>\n";
  const auto path = folder.write("scene.xml", in_scene(includes));
  CHECK_MESSAGE_HAS(error_of([&] { renderer::read_scene(path, {}); }),
                    "scene.xml:17: ", "part.xml\" the included files have 268",
                    "allowed: 268435456 in all");
}

TEST_CASE("scene hostile: parameters that multiply are stopped") {
  std::string doubled = "<default name=\"a0\" value=\"0123456789\"/>";
  for (int i = 1; i <= 20; ++i) {
    const std::string before = "$a" + std::to_string(i - 1);
    doubled += "\n<default name=\"a" + std::to_string(i) + "\" value=\"" + before + before + "\"/>";
  }
  CHECK_MESSAGE_HAS(scene_test::read_error(doubled), "scene.xml:19: ", "\"$a16\"", "\"0123456789",
                    "has 1310720 bytes", "put in: 1048576");

  const std::string large = "<default name=\"a\" value=\"" + std::string(1 << 20, 'x') + "\"/>\n";
  const auto used = [&](int times) {
    std::string text = large;
    for (int i = 0; i < times; ++i)
      text += "<string name=\"s" + std::to_string(i) + "\" value=\"$a\"/>\n";
    return scene_test::read_error(text);
  };
  CHECK(used(64) == "no error");
  CHECK_MESSAGE_HAS(used(65), "scene.xml:67: ", "\"$a\"", "allowed: 67108864 in all");
}

TEST_CASE("scene hostile: long values without parameters in them stay as they are") {
  const std::string value(3 << 20, 'x');
  const auto scene = scene_test::read("<string name=\"s\" value=\"" + value + "\"/>");
  CHECK(scene->string("s") == value);
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

TEST_CASE("scene hostile: meshes that the memory doesn't hold together are refused") {
  const auto scene = scene_test::read("\n<shape type=\"ply\"/>");
  const renderer::Object& mesh = *scene->children("shape")[0];
  renderer::check_triangles_fit(mesh, 1e6);
  CHECK_MESSAGE_HAS(error_of([&] { renderer::check_triangles_fit(mesh, 1e13); }),
                    "scene.xml:", "<shape type=\"ply\">", "take 1600000 GB", "allowed: 4/5");
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

TEST_CASE("scene hostile: a picture of more pixels than anybody means is refused unread") {
  const Folder folder;
  const std::string zeros(6 << 20, '\0');  // which bear out the claims
  const auto png = folder.write(
      "large.png",
      std::string(
          "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x46\x50\0\0\x46\x50\x08\x02\0\0\0....\0\1\0\0IDAT",
          41) +
          zeros);
  const auto hdr = folder.write(
      "large.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 18000 +X 18000\n" + zeros);
  renderer::write_exr(folder.path() / "whole.exr", renderer::Image(2, 2, {"R", "G", "B"}));
  std::string bytes = renderer::read_bytes(folder.path() / "whole.exr", 1 << 20);
  const std::size_t window = bytes.find("dataWindow");
  REQUIRE(window != std::string::npos);
  bytes.replace(window + 29, 8, std::string("\x4f\x46\0\0\x4f\x46\0\0", 8));
  const auto exr = folder.write("large.exr", bytes + zeros);
  for (const auto& path : {png, hdr, exr})
    CHECK_MESSAGE_HAS(error_of([&] { renderer::read_texels(path, false); }), path.string() + ": ",
                      "18000 x 18000 pixels", "allowed: 268435456 in all");
}

TEST_CASE("scene hostile: pictures that the memory doesn't hold together are refused") {
  const Folder folder;
  const auto path = (folder.path() / "small.exr").string();
  renderer::write_exr(path, renderer::Image(2, 2, {"R", "G", "B"}));
  CHECK(renderer::read_texels(path, false, {}, 1 << 20).width == 2);
  const std::uint64_t petabyte = std::uint64_t{1} << 50;
  CHECK_MESSAGE_HAS(error_of([&] {
                      renderer::read_texels(path, false, {"scene.xml", 3}, petabyte);
                    }),
                    "scene.xml:3: ", "small.exr", "2 x 2 pixels", "1125899 GB of the textures",
                    "allowed: 4/5");
}

TEST_CASE("scene hostile: a picture without pixels is refused") {
  const Folder folder;
  std::string bitmap("BM\x1a\0\0\0\0\0\0\0\x1a\0\0\0\x0c\0\0\0\0\0\1\0\1\0\x18\0", 26);
  const auto path = folder.write("empty.bmp", bitmap);
  CHECK(contains(error_of([&] { renderer::read_texels(path, false); }), "empty.bmp: "));
  const auto filled = folder.write("filled.jpg", "\xff\xff\xd8\xff\xc4");
  CHECK(contains(error_of([&] { renderer::read_texels(filled, false); }), "begins with"));
}
