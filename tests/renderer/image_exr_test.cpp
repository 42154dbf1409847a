// SPDX-License-Identifier: MIT
// EXR and PNG files: what is written is read back, what is damaged is refused, what fails changes
// nothing.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfTileDescription.h>
#include <OpenEXR/ImfTiledOutputFile.h>
#include <doctest/doctest.h>
#include <png.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "io/atomic_file.hpp"
#include "io/exr.hpp"
#include "io/input_error.hpp"
#include "io/png.hpp"

namespace {

namespace fs = std::filesystem;
using renderer::Image;
using renderer::InputError;
using renderer::WorkError;

/// A folder of its own for each test, gone afterwards.
class Folder {
 public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "malus-exr-XXXXXX").string();
    REQUIRE(::mkdtemp(name.data()) != nullptr);
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    fs::permissions(path_, fs::perms::owner_all, ignored);
    fs::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string operator/(const std::string& name) const { return path_ + "/" + name; }
  std::size_t files() const {
    const auto count = std::distance(fs::directory_iterator(path_), fs::directory_iterator());
    return static_cast<std::size_t>(count);
  }

 private:
  std::string path_;
};

/// Files may not grow beyond this size while it lives: a disk that is full.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    ::getrlimit(RLIMIT_FSIZE, &previous_);
    const rlimit limited{bytes, previous_.rlim_max};
    REQUIRE(::setrlimit(RLIMIT_FSIZE, &limited) == 0);
  }
  ~FileSizeLimit() { ::setrlimit(RLIMIT_FSIZE, &previous_); }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit previous_{};
};

Image noise(int width, int height) {
  Image image(width, height, {"R", "G", "B", "S0.R", "S1.R", "S2.R", "S3.R"});
  std::mt19937 random(7);
  std::uniform_real_distribution<float> values(-4, 4);
  for (float& value : image.data) value = values(random);
  image.metadata = {{"malus:stokes_frame", "horizontal"},
                    {"a name beyond 31 characters, as allowed", "x\ny"}};
  return image;
}

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void put(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

std::string message_of_reading(const std::string& path) {
  try {
    renderer::read_exr(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

long peak_kilobytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

/// The smallest valid header, with any data window, and nothing after it.
std::string header_claiming(int max_x, int max_y) {
  std::string bytes = {0x76, 0x2f, 0x31, 0x01, 2, 0, 0, 0};
  const auto integer = [](int value) {
    std::string four;
    for (int shift = 0; shift < 32; shift += 8) four += static_cast<char>((value >> shift) & 0xff);
    return four;
  };
  const auto attribute = [&](const char* name, const char* type, const std::string& value) {
    bytes +=
        std::string(name) + '\0' + type + '\0' + integer(static_cast<int>(value.size())) + value;
  };
  const std::string box = integer(0) + integer(0) + integer(max_x) + integer(max_y);
  const std::string one = {0, 0, static_cast<char>(0x80), 0x3f};
  attribute("channels", "chlist",
            std::string("R") + '\0' + integer(2) + integer(0) + integer(1) + integer(1) + '\0');
  attribute("compression", "compression", std::string(1, 3));
  attribute("dataWindow", "box2i", box);
  attribute("displayWindow", "box2i", box);
  attribute("lineOrder", "lineOrder", std::string(1, 0));
  attribute("pixelAspectRatio", "float", one);
  attribute("screenWindowCenter", "v2f", std::string(8, 0));
  attribute("screenWindowWidth", "float", one);
  return bytes + '\0';
}

}  // namespace

TEST_CASE("an EXR is read back as it was written, at even and odd sizes, with its metadata") {
  const Folder folder;
  for (const auto& [width, height] : {std::pair{1, 1}, {17, 33}, {64, 16}, {3, 1}, {1, 41}}) {
    CAPTURE(width);
    CAPTURE(height);
    const Image written = noise(width, height);
    renderer::write_exr(folder / "a.exr", written);
    const Image read = renderer::read_exr(folder / "a.exr");
    CHECK(read.width == width);
    CHECK(read.height == height);
    CHECK(read.metadata == written.metadata);
    REQUIRE(read.channels.size() == written.channels.size());
    for (const std::string& channel : written.channels) {
      REQUIRE(read.has(channel));
      const auto expected = written.plane(channel);
      const auto found = read.plane(channel);
      CHECK(std::equal(expected.begin(), expected.end(), found.begin(), found.end()));
    }
  }
  CHECK(folder.files() == 1);
}

TEST_CASE("infinities and NaN survive an EXR") {
  const Folder folder;
  Image image(2, 1, {"R"});
  image.data = {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()};
  renderer::write_exr(folder / "a.exr", image);
  const Image read = renderer::read_exr(folder / "a.exr");
  CHECK(std::bit_cast<std::uint32_t>(read.data[0]) == 0x7f800000U);
  CHECK((std::bit_cast<std::uint32_t>(read.data[1]) & 0x7fc00000U) == 0x7fc00000U);
}

TEST_CASE("half and integer channels, tiles and an offset data window are read") {
  const Folder folder;
  const std::string path = folder / "tiles.exr";
  const Imath::Box2i display({0, 0}, {99, 99});
  const Imath::Box2i window({-3, 7}, {8, 13});
  Imf::Header header(display, window);
  header.channels().insert("H", Imf::Channel(Imf::HALF));
  header.channels().insert("U", Imf::Channel(Imf::UINT));
  header.setTileDescription(Imf::TileDescription(8, 8, Imf::ONE_LEVEL));
  std::vector<half> halves(12 * 7);
  std::vector<unsigned> integers(12 * 7);
  for (std::size_t i = 0; i < halves.size(); ++i) {
    halves[i] = static_cast<float>(i) / 4;
    integers[i] = static_cast<unsigned>(1000 * i);
  }
  Imf::FrameBuffer source;
  source.insert("H", Imf::Slice::Make(Imf::HALF, halves.data(), window));
  source.insert("U", Imf::Slice::Make(Imf::UINT, integers.data(), window));
  {
    Imf::TiledOutputFile file(path.c_str(), header);
    file.setFrameBuffer(source);
    file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
  }
  const Image read = renderer::read_exr(path);
  CHECK(read.width == 12);
  CHECK(read.height == 7);
  for (std::size_t i = 0; i < halves.size(); ++i) {
    CHECK(read.plane("H")[i] == static_cast<float>(i) / 4);
    CHECK(read.plane("U")[i] == static_cast<float>(1000 * i));
  }
}

TEST_CASE("a missing file, a folder and a file of another kind are refused by name") {
  const Folder folder;
  put(folder / "text.exr", "this is not a picture");
  put(folder / "empty.exr", "");
  CHECK(message_of_reading(folder / "none.exr") == (folder / "none.exr") + ": no such file");
  CHECK(contains(message_of_reading(folder / "."), "is a folder"));
  CHECK(message_of_reading(folder / "text.exr") ==
        (folder / "text.exr") + ": is not an OpenEXR file");
  CHECK(message_of_reading(folder / "empty.exr") ==
        (folder / "empty.exr") + ": is not an OpenEXR file");
}

TEST_CASE("an EXR cut short anywhere is refused by name") {
  const Folder folder;
  renderer::write_exr(folder / "whole.exr", noise(20, 40));
  const std::string whole = bytes_of(folder / "whole.exr");
  const std::string path = folder / "cut.exr";
  for (std::size_t size = 0; size < whole.size(); size += 1 + whole.size() / 97) {
    CAPTURE(size);
    put(path, whole.substr(0, size));
    CHECK(contains(message_of_reading(path), path));
  }
  put(path, whole.substr(0, whole.size() - 1));
  CHECK(contains(message_of_reading(path), path));
}

TEST_CASE("an EXR with damaged bytes is read or refused, never worse") {
  const Folder folder;
  renderer::write_exr(folder / "whole.exr", noise(9, 9));
  const std::string whole = bytes_of(folder / "whole.exr");
  const std::string path = folder / "damaged.exr";
  std::mt19937 random(1);
  int refused = 0;
  for (int round = 0; round < 400; ++round) {
    std::string bytes = whole;
    // The first 600 bytes are header and offsets, where damage hurts most.
    const std::size_t range =
        round % 2 == 0 ? std::min<std::size_t>(600, bytes.size()) : bytes.size();
    for (int i = 0; i < 1 + round % 3; ++i) bytes[random() % range] = static_cast<char>(random());
    put(path, bytes);
    if (!message_of_reading(path).empty()) ++refused;
  }
  CHECK(refused > 50);
}

TEST_CASE("a header that claims an absurd size is refused without the memory it asks for") {
  const Folder folder;
  const std::string path = folder / "huge.exr";
  const long before = peak_kilobytes();
  for (const auto& [x, y] : {std::pair{65535, 65535}, {2147483646, 2147483646}, {-5, 3}, {3, 3}}) {
    CAPTURE(x);
    put(path, header_claiming(x, y));
    CHECK(contains(message_of_reading(path), path));
  }
  // Sizes that pictures do have, with the table of offsets that belongs to them, but no pixels.
  for (const auto& [x, y] : {std::pair{20000, 20000}, {60000, 65000}}) {
    CAPTURE(x);
    const auto chunks = static_cast<std::size_t>(y / 16 + 1);
    put(path, header_claiming(x, y) + std::string(8 * chunks, 1));
    CHECK(contains(message_of_reading(path), std::to_string(x + 1) + " x "));
  }
  CHECK(peak_kilobytes() - before < 200000);
}

TEST_CASE("a write that fails half way leaves the old file untouched and nothing beside it") {
  const Folder folder;
  const std::string path = folder / "a.exr";
  put(path, "precious");
  {
    const FileSizeLimit full(2000);
    CHECK_THROWS_AS(renderer::write_exr(path, noise(64, 64)), WorkError);
    CHECK_THROWS_AS(renderer::write_file(path, std::string(5000, 'x')), WorkError);
  }
  CHECK(bytes_of(path) == "precious");
  CHECK(folder.files() == 1);
  renderer::write_exr(path, noise(64, 64));
  CHECK(renderer::read_exr(path).width == 64);
}

TEST_CASE("a write that fails names the file and the reason") {
  const Folder folder;
  const FileSizeLimit full(10);
  try {
    renderer::write_file(folder / "b.json", std::string(100, 'x'));
    FAIL("written beyond the limit");
  } catch (const WorkError& error) {
    CHECK(contains(error.what(), folder / "b.json"));
    CHECK(contains(error.what(), "File too large"));
  }
}

TEST_CASE("a failed write that somebody swallowed still keeps the file from being committed") {
  const Folder folder;
  const FileSizeLimit full(10);
  {
    renderer::AtomicFile file(folder / "a");
    CHECK_THROWS_AS(file.write(std::string(100, 'x').data(), 100), WorkError);
    file.seek(0);
    file.write("fits", 4);
    CHECK_THROWS_AS(file.commit(), WorkError);
  }
  CHECK(folder.files() == 0);
}

TEST_CASE("an AtomicFile that is not committed leaves nothing behind") {
  const Folder folder;
  {
    renderer::AtomicFile file(folder / "a");
    file.write("abc", 3);
    CHECK(folder.files() <= 1);  // none where the temporary has no name
  }
  CHECK(folder.files() == 0);
}

TEST_CASE("places where no file can be made are refused before the work") {
  const Folder folder;
  fs::create_directory(folder / "sub");
  put(folder / "file", "x");
  // Stands for every device: a rename would replace it by a plain file.
  REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
  for (const std::string& path : {folder / "none/a.exr", folder / "sub", folder / "sub/",
                                  folder / "file/a.exr", folder / "pipe", std::string()}) {
    CAPTURE(path);
    CHECK_THROWS_AS(renderer::check_writable(path), InputError);
    CHECK_THROWS_AS(renderer::write_exr(path, noise(2, 2)), InputError);
  }
  CHECK_NOTHROW(renderer::check_writable(folder / "sub/a.exr"));
  CHECK_NOTHROW(renderer::check_writable(folder / "file"));
  CHECK(fs::is_fifo(folder / "pipe"));
  CHECK(folder.files() == 3);
}

TEST_CASE("a folder or a file that is read-only is refused" * doctest::skip(::geteuid() == 0)) {
  const Folder folder;
  put(folder / "old.exr", "old");
  fs::permissions(folder / "old.exr", fs::perms::owner_read);
  CHECK_THROWS_AS(renderer::write_exr(folder / "old.exr", noise(2, 2)), InputError);
  fs::permissions(folder / ".", fs::perms::owner_read | fs::perms::owner_exec);
  CHECK_THROWS_AS(renderer::check_writable(folder / "new.exr"), InputError);
  CHECK(bytes_of(folder / "old.exr") == "old");
}

TEST_CASE("a new file has the user's usual permissions and a replaced one keeps its own") {
  const Folder folder;
  const mode_t previous = ::umask(027);
  renderer::write_file(folder / "new", "x");
  ::umask(previous);
  CHECK(fs::status(folder / "new").permissions() == fs::perms(0640));
  fs::permissions(folder / "new", fs::perms(0604));
  renderer::write_file(folder / "new", "y");
  CHECK(fs::status(folder / "new").permissions() == fs::perms(0604));
}

TEST_CASE("writing through a symbolic link replaces the file it points to") {
  const Folder folder;
  put(folder / "real", "old");
  fs::create_symlink(folder / "real", folder / "link");
  renderer::write_file(folder / "link", "new");
  CHECK(fs::is_symlink(folder / "link"));
  CHECK(bytes_of(folder / "real") == "new");
}

TEST_CASE("a PNG holds the picture's bytes and says that it is sRGB") {
  const Folder folder;
  renderer::Picture picture(5, 3, {0, 0.5F, 1});
  picture.set(4, 2, {1, 0, 0});
  renderer::write_png(folder / "a.png", picture);
  CHECK(contains(bytes_of(folder / "a.png"), "sRGB"));
  png_image description = {};
  description.version = PNG_IMAGE_VERSION;
  REQUIRE(png_image_begin_read_from_file(&description, (folder / "a.png").c_str()) != 0);
  description.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> read(PNG_IMAGE_SIZE(description));
  REQUIRE(png_image_finish_read(&description, nullptr, read.data(), 0, nullptr) != 0);
  CHECK(read == picture.bytes());
}
