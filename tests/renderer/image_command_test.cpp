// SPDX-License-Identifier: MIT
// malus-image as its user meets it: command lines, exit statuses, files written and files left
// alone.
#include <doctest/doctest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <system_error>
#include <vector>

#include "image/command_line.hpp"
#include "io/exr.hpp"
#include "io/image.hpp"

namespace {

namespace fs = std::filesystem;
using renderer::Image;

class Folder {
 public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "malus-image-XXXXXX").string();
    REQUIRE(::mkdtemp(name.data()) != nullptr);
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string operator/(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

struct Outcome {
  int status = 0;
  std::string out;
  std::string err;
};

Outcome run(std::vector<std::string> arguments) {
  std::vector<const char*> argv = {"malus-image"};
  for (const std::string& argument : arguments) argv.push_back(argument.c_str());
  std::ostringstream out;
  std::ostringstream err;
  const int status = renderer::malus_image(static_cast<int>(argv.size()), argv.data(), out, err);
  return {status, out.str(), err.str()};
}

/// Two pixels: 45 degree light, then 135 degree light.
Image two_pixels() {
  Image image(2, 1, {"S0", "S1", "S2", "S3"});
  image.data = {1, 1, 0, 0, 1, -1, 0, 0};
  return image;
}

}  // namespace

TEST_CASE("--compare prints JSON that other programs can read, and writes its picture") {
  const Folder folder;
  Image b = two_pixels();
  b.plane("S2")[0] = 0.5F;
  renderer::write_exr(folder / "a.exr", two_pixels());
  renderer::write_exr(folder / "b.exr", b);
  const Outcome outcome =
      run({"--compare", folder / "a.exr", folder / "b.exr", "-o", folder / "d.png", "--json"});
  CHECK(outcome.status == 0);
  const auto json = nlohmann::json::parse(outcome.out);
  CHECK(json["S2"]["Y"]["mean_difference"] == doctest::Approx(-0.25));
  CHECK(fs::exists(folder / "d.png"));
}

TEST_CASE("a picture through a filter is written as EXR or PNG by the name's ending") {
  const Folder folder;
  renderer::write_exr(folder / "a.exr", two_pixels());
  CHECK(run({"--filter", "linear:45", folder / "a.exr", "-o", folder / "f.EXR"}).status == 0);
  const Image filtered = renderer::read_exr(folder / "f.EXR");
  CHECK(filtered.plane("S0")[0] == 1);
  CHECK(filtered.plane("S0")[1] == 0);
  CHECK(run({folder / "a.exr", "--filter", "linear:45", "-o", folder / "f.png"}).status == 0);
  CHECK(bytes_of(folder / "f.png").substr(1, 3) == "PNG");
}

TEST_CASE("filters are passed in the order they are given") {
  const Folder folder;
  renderer::write_exr(folder / "a.exr", two_pixels());
  const auto behind = [&](const char* first, const char* second) {
    REQUIRE(run({folder / "a.exr", "--filter", first, "--filter", second, "-o", folder / "f.exr"})
                .status == 0);
    return renderer::read_exr(folder / "f.exr").plane("S0")[0];
  };
  CHECK(behind("linear:-45", "linear:0") == 0);
  CHECK(behind("linear:0", "linear:-45") == doctest::Approx(0.25));
  CHECK(behind("retarder:0,90", "circular:left") == doctest::Approx(1));
}

TEST_CASE("a filter and --show together show the light behind the filter") {
  const Folder folder;
  renderer::write_exr(folder / "a.exr", two_pixels());
  CHECK(run({folder / "a.exr", "--filter", "linear:0", "--show", "aolp", "-o", folder / "x.png"})
            .status == 0);
  CHECK(fs::exists(folder / "x.png"));
}

TEST_CASE("one colour can be looked at alone") {
  const Folder folder;
  Image image(1, 1,
              {"S0.R", "S0.G", "S0.B", "S1.R", "S1.G", "S1.B", "S2.R", "S2.G", "S2.B", "S3.R",
               "S3.G", "S3.B"});
  image.plane("S0.G")[0] = 1;
  image.plane("S1.G")[0] = 0.5F;
  renderer::write_exr(folder / "a.exr", image);
  const Outcome green = run({folder / "a.exr", "--info", "--json", "--channel", "G"});
  const auto json = nlohmann::json::parse(green.out);
  CHECK(json["mean"]["S1"].size() == 1);
  CHECK(json["mean"]["S1"]["G"] == 0.5);
  CHECK(run({folder / "a.exr", "--info", "--channel", "X"}).status == 2);
}

TEST_CASE("help and version succeed, on standard output") {
  CHECK(run({"--help"}).status == 0);
  CHECK(run({"--help"}).out.find("--filter") != std::string::npos);
  CHECK(run({"--version"}).status == 0);
  CHECK(run({"--version"}).out.find("malus-image ") == 0);
}

TEST_CASE(
    "what is missing, unknown or contradicts itself exits with 2, one message and no output") {
  const Folder folder;
  renderer::write_exr(folder / "a.exr", two_pixels());
  renderer::write_exr(folder / "large.exr", Image(3, 1, {"S0", "S1", "S2", "S3"}));
  renderer::write_exr(folder / "plain.exr", Image(2, 1, {"R", "G", "B"}));
  const std::string a = folder / "a.exr";
  const std::string png = folder / "out.png";
  const std::vector<std::vector<std::string>> wrong = {
      {},
      {a},
      {"--nonsense"},
      {a, "--show", "dop"},
      {"--show", "dop", "-o", png},
      {a, "--show", "nothing", "-o", png},
      {a, "--show", "dop", "-o", folder / "out.jpg"},
      {a, "--show", "dop", "-o", folder / "out.exr"},
      {a, "--show", "dop", "-o", folder / "none/out.png"},
      {a, "--filter", "linear:x", "-o", png},
      {a, "--show", "dop", "--info", "-o", png},
      {a, "--compare", a, a, "-o", png},
      {"--compare", a, "-o", png},
      {"--compare", a, folder / "large.exr", "-o", png},
      {"--compare", a, folder / "plain.exr", "-o", png},
      {a, "--show", "dop", "--scale", "-1", "-o", png},
      {a, "--show", "dop", "--exposure", "much", "-o", png},
      {a, "--show", "dop", "--json", "-o", png},
      {folder / "plain.exr", "--show", "dop", "-o", png},
      {folder / "missing.exr", "--show", "dop", "-o", png}};
  for (const auto& arguments : wrong) {
    std::string line;
    for (const std::string& argument : arguments) line += argument + ' ';
    CAPTURE(line);
    const Outcome outcome = run(arguments);
    CHECK(outcome.status == 2);
    CHECK(outcome.out.empty());
    CHECK_FALSE(outcome.err.empty());
    CHECK_FALSE(fs::exists(png));
  }
}

TEST_CASE("an input is never overwritten by the output") {
  const Folder folder;
  const std::string a = folder / "a.exr";
  renderer::write_exr(a, two_pixels());
  const std::string before = bytes_of(a);
  fs::create_hard_link(a, folder / "same.exr");
  CHECK(run({a, "--filter", "linear:0", "-o", a}).status == 2);
  CHECK(run({a, "--filter", "linear:0", "-o", folder / "same.exr"}).status == 2);
  CHECK(bytes_of(a) == before);
}

TEST_CASE("image command: --physical fails where a pixel is no light, and where one is no number") {
  const Folder folder;
  Image image(1, 1, {"S0", "S1", "S2", "S3"});
  const std::string file = folder / "pixel.exr";
  const auto status_of = [&](float s1) {
    image.data = {1, s1, 0, 0};
    renderer::write_exr(file, image);
    return run({file, "--physical"}).status;
  };
  CHECK(status_of(1) == 0);
  CHECK(status_of(1.1F) == 1);
  CHECK(status_of(std::numeric_limits<float>::quiet_NaN()) == 1);
}
