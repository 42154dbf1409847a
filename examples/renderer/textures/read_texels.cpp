// SPDX-License-Identifier: MIT
#include "read_texels.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>

#include "../image/finite.hpp"
#include "../io/exr.hpp"
#include "../io/memory.hpp"
#include "../scene/text.hpp"
#include "../scene/xml_file.hpp"
#include "read_radiance.hpp"

// stb_image is a header with its functions' bodies in it; they are this file's own.
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_NO_PSD
#define STBI_NO_GIF
#define STBI_NO_PIC
#define STBI_NO_PNM
#define STBI_NO_HDR
#define STBI_MAX_DIMENSIONS 65536
// Of a PNG whose first IDAT chunk is empty, it copies no bytes to a null pointer: that is
// undefined, and whatever is made of it, a stream of no bytes is refused next.
#ifdef __clang__
#pragma clang attribute push(__attribute__((no_sanitize("nonnull-attribute"))), apply_to = function)
#endif
#if __has_include(<stb/stb_image.h>)
#include <stb/stb_image.h>
#else
#include <stb_image.h>
#endif
#ifdef __clang__
#pragma clang attribute pop
#endif

namespace renderer {

namespace {

constexpr std::uint64_t most_pixels = std::uint64_t{1} << 28;
constexpr std::uintmax_t largest_file = std::numeric_limits<int>::max();  // stb counts in int

float decode_srgb(float v) {
  return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

/// What stb_image 2.27 doesn't check, and writes beyond its tables for. Up to the first scan a JPEG
/// is read segment by segment; from there on every pair of bytes that may be the marker is taken
/// for it, as stb may.
bool has_sound_huffman_tables(std::string_view jpeg) {
  constexpr std::uint8_t huffman_tables = 0xc4, start_of_scan = 0xda;
  const auto byte = [&](std::size_t i) {
    return i < jpeg.size() ? static_cast<std::uint8_t>(jpeg[i]) : std::uint8_t{0};
  };
  const auto is_sound = [&](std::size_t at) {
    const std::size_t end = at + byte(at) * 256u + byte(at + 1);
    for (at += 2; at < end;) {
      std::size_t codes = 0;
      for (std::size_t i = 1; i <= 16; ++i) codes += byte(at + i);
      if (codes > 256) return false;
      at += 17 + codes;
    }
    return true;
  };
  bool in_scan = false;
  for (std::size_t at = 2; at < jpeg.size();) {
    if (byte(at++) != 0xff) continue;
    while (byte(at) == 0xff) ++at;
    const std::uint8_t marker = byte(at++);
    if (marker == huffman_tables && !is_sound(at)) return false;
    in_scan |= marker == start_of_scan;
    if (!in_scan && marker != 0) at += byte(at) * 256u + byte(at + 1);
  }
  return true;
}

/// Of one file that is being read.
class TexelReader {
 public:
  TexelReader(const std::filesystem::path& path, bool raw, const Location& asker,
              std::uint64_t held)
      : path_(path), raw_(raw), asker_(asker), held_(held) {}

  Texels read() {
    const std::string bytes = read_bytes(path_, largest_file, asker_);
    Texels texels = bytes.starts_with("\x76\x2f\x31\x01") ? from_exr()
                    : is_radiance(bytes)                  ? from_radiance(bytes)
                                                          : from_stb(bytes);
    for (std::size_t i = 0; i < texels.values.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c)
        if (!is_finite(texels.values[i][c])) {
          const auto width = static_cast<std::size_t>(texels.width);
          fail("the pixel in column " + std::to_string(i % width) + ", row " +
               std::to_string(i / width) + " is not finite");
        }
    return texels;
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const {
    if (asker_.file.empty()) throw InputError({path_.string(), 0}, problem);
    throw InputError(asker_, "the file " + in_quotes(path_.string()) + ": " + problem);
  }

  /// Of a picture of which there are so many bytes a pixel besides its texels while it is read.
  void check_memory(int width, int height, std::size_t bytes) const {
    const auto pixels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
    const std::string size = std::to_string(width) + " x " + std::to_string(height) + " pixels";
    if (pixels > most_pixels)
      fail("it is " + size + "; allowed: " + std::to_string(most_pixels) +
           " in all, as of 16384 x 16384");
    const double needed = static_cast<double>(pixels) * static_cast<double>(sizeof(Rgb) + bytes);
    const auto held = static_cast<double>(held_);
    if (!fits_into_memory(needed + held))
      fail("reading its " + size + " takes " + in_gigabytes(needed) + " of memory, besides the " +
           in_gigabytes(held) + " of the textures before it" + allowed_memory());
  }

  Texels from_exr() const {
    const Image image =
        read_exr(path_.string(), [this](int width, int height, std::size_t channels) {
          check_memory(width, height, channels * sizeof(float));
        });
    const bool colored = image.has("R") && image.has("G") && image.has("B");
    if (!colored && !image.has("Y"))
      fail("has the channels " + joined(image.channels) + "; needed: R, G and B, or Y");
    const auto r = image.plane(colored ? "R" : "Y"), g = image.plane(colored ? "G" : "Y"),
               b = image.plane(colored ? "B" : "Y");
    Texels texels{image.width, image.height, {}};
    texels.values.reserve(image.pixels());
    for (std::size_t i = 0; i < image.pixels(); ++i) texels.values.emplace_back(r[i], g[i], b[i]);
    return texels;
  }

  Texels from_radiance(const std::string& bytes) const {
    try {
      return read_radiance(bytes,
                           [this](int width, int height) { check_memory(width, height, 0); });
    } catch (const InputError&) {
      throw;
    } catch (const std::runtime_error& error) {
      fail(std::string("cannot be read as Radiance HDR: ") + error.what());
    }
  }

  /// As of OpenEXR files, a large claim must be borne out by the file.
  void check_size(const Texels& texels, std::size_t file_size) const {
    constexpr std::uint64_t believed = std::uint64_t{1} << 20, pixels_per_byte = 8256;
    const auto pixels =
        static_cast<std::uint64_t>(texels.width) * static_cast<std::uint64_t>(texels.height);
    if (texels.width < 1 || texels.height < 1)
      fail("it is " + std::to_string(texels.width) + " x " + std::to_string(texels.height) +
           " pixels; allowed: 1 or more each way");
    if (pixels > believed && pixels > pixels_per_byte * file_size)
      fail("damaged: it claims " + std::to_string(texels.width) + " x " +
           std::to_string(texels.height) + " pixels, but has only " + std::to_string(file_size) +
           " bytes");
  }

  /// Three channels of 16 bits: of what it has besides before it has those, there are no texels
  /// yet.
  static constexpr std::size_t most_bytes_in_stb = 3 * sizeof(stbi_us);

  Texels from_stb(const std::string& bytes) const {
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int size = static_cast<int>(bytes.size());
    Texels texels;
    int channels = 0;
    // stb passes over any number of bytes ff before a JPEG's first marker.
    if (bytes.starts_with("\xff\xff")) fail("damaged: a JPEG begins with the bytes ff d8");
    if (bytes.starts_with("\xff\xd8") && !has_sound_huffman_tables(bytes))
      fail("damaged: a JPEG's Huffman table has more than 256 codes");
    if (!stbi_info_from_memory(data, size, &texels.width, &texels.height, &channels))
      fail_in_header(bytes);
    check_size(texels, bytes.size());
    check_memory(texels.width, texels.height, most_bytes_in_stb);
    const auto load = [&]<class Value>(Value* loaded) {
      const std::unique_ptr<Value, void (*)(void*)> values(loaded, stbi_image_free);
      if (!values) fail_in_stb(bytes);
      decode(values.get(), texels);
    };
    int* const w = &texels.width;
    int* const h = &texels.height;
    if (stbi_is_16_bit_from_memory(data, size))
      load(stbi_load_16_from_memory(data, size, w, h, &channels, 3));
    else
      load(stbi_load_from_memory(data, size, w, h, &channels, 3));
    return texels;
  }

  /// By what it begins with, which TGA has nothing for.
  static std::string format_of(const std::string& bytes) {
    if (bytes.starts_with("\x89PNG")) return "PNG";
    if (bytes.starts_with("\xff\xd8")) return "JPEG";
    return bytes.starts_with("BM") ? "BMP" : "";
  }

  /// stb tries one format after the other, and keeps the last one's reason.
  [[noreturn]] void fail_in_header(const std::string& bytes) const {
    const std::string format = format_of(bytes);
    if (format.empty())
      fail("cannot be read as a picture; allowed: OpenEXR, HDR, PNG, JPEG, BMP, TGA");
    fail("begins as a " + format + ", but is truncated or damaged, or too large; allowed: " +
         std::to_string(STBI_MAX_DIMENSIONS) + " pixels a side, " + std::to_string(most_pixels) +
         " in all");
  }

  /// Of a file that ends too early stb often gives no reason.
  [[noreturn]] void fail_in_stb(const std::string& bytes) const {
    const std::string format = format_of(bytes), reason = stbi_failure_reason();
    fail("is truncated or damaged" + (reason.empty() ? "" : " (" + reason + ")") +
         "; allowed: a whole " + (format.empty() ? "TGA" : format) + " file");
  }

  template <class Value>
  void decode(const Value* v, Texels& texels) const {
    const auto pixels =
        static_cast<std::size_t>(texels.width) * static_cast<std::size_t>(texels.height);
    texels.values.reserve(pixels);
    constexpr std::size_t levels = std::size_t{std::numeric_limits<Value>::max()} + 1;
    std::vector<float> linear(levels);
    for (std::size_t i = 0; i < levels; ++i) {
      const float share = static_cast<float>(i) / static_cast<float>(levels - 1);
      linear[i] = raw_ ? share : decode_srgb(share);
    }
    for (std::size_t i = 0; i < pixels; ++i, v += 3)
      texels.values.emplace_back(linear[v[0]], linear[v[1]], linear[v[2]]);
  }

  const std::filesystem::path& path_;
  bool raw_;
  const Location& asker_;
  std::uint64_t held_;
};

}  // namespace

Texels read_texels(const std::filesystem::path& path, bool raw, const Location& asker,
                   std::uint64_t held) {
  return TexelReader(path, raw, asker, held).read();
}

}  // namespace renderer
