// SPDX-License-Identifier: MIT
#include "exr.hpp"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfTestFile.h>
#include <unistd.h>

#include <cstdint>
#include <exception>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <system_error>

#include "atomic_file.hpp"
#include "exr_header.hpp"
#include "input_error.hpp"

namespace renderer {
namespace {

namespace fs = std::filesystem;

/// OpenEXR's view of an AtomicFile: it goes back once, to fill in the table of line offsets.
class AtomicStream : public Imf::OStream {
 public:
  AtomicStream(const std::string& path, AtomicFile& file) : OStream(path.c_str()), file_(file) {}
  void write(const char bytes[], int count) override {
    file_.write(bytes, static_cast<std::size_t>(count));
  }
  std::uint64_t tellp() override { return file_.position(); }
  void seekp(std::uint64_t position) override { file_.seek(position); }

 private:
  AtomicFile& file_;
};

Imf::Header header_of(const Image& image) {
  Imf::Header header(image.width, image.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const std::string& channel : image.channels) {
    header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
  }
  for (const auto& [name, text] : image.metadata) {
    header.insert(name, Imf::StringAttribute(text));
  }
  return header;
}

constexpr int max_side = 1 << 16;
constexpr std::uint64_t max_values = std::uint64_t{1} << 31;

/// A header of a few bytes can claim any size. Small claims are believed; a large one must be borne
/// out by the file, which the compressions in use shrink about a thousandfold at the very most.
void check_size(std::uint64_t width, std::uint64_t height, std::uint64_t channels,
                std::uint64_t file_size) {
  constexpr std::uint64_t believed = std::uint64_t{1} << 22;
  constexpr std::uint64_t values_per_byte = 1024;
  const std::uint64_t values = width * height * channels;
  const std::string claim = std::to_string(width) + " x " + std::to_string(height) + " pixels of " +
                            std::to_string(channels) + " channels";
  if (values > max_values) throw std::runtime_error("too large: " + claim);
  if (values > believed && values > values_per_byte * file_size) {
    throw std::runtime_error("damaged: the header claims " + claim + ", but the file has only " +
                             std::to_string(file_size) + " bytes");
  }
}

void read_header(const Imf::Header& header, std::uint64_t file_size, const ExrSizeCheck& check,
                 Image& image) {
  if (header.hasType() && Imf::isDeepData(header.type())) {
    throw std::runtime_error("deep images are not supported, only flat ones");
  }
  for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
    if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1) {
      throw std::runtime_error("channel " + std::string(channel.name()) +
                               " is subsampled, which is not supported");
    }
    image.channels.emplace_back(channel.name());
  }
  const auto& window = header.dataWindow();
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
  const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
  if (width < 1 || height < 1 || width > max_side || height > max_side) {
    throw std::runtime_error("the image is " + std::to_string(width) + " x " +
                             std::to_string(height) + " pixels; each side may be 1 to " +
                             std::to_string(max_side));
  }
  if (image.channels.empty()) throw std::runtime_error("the image has no channels");
  check_size(static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height),
             image.channels.size(), file_size);
  if (check) check(static_cast<int>(width), static_cast<int>(height), image.channels.size());
  image.width = static_cast<int>(width);
  image.height = static_cast<int>(height);
  for (auto attribute = header.begin(); attribute != header.end(); ++attribute) {
    const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute());
    const std::string name = attribute.name();
    // These two describe the part in its file, not the picture, and would be wrong in a copy.
    if (text != nullptr && name != "type" && name != "name") image.metadata[name] = text->value();
  }
}

Image read_first_part(const std::string& path, std::uint64_t file_size, const ExrSizeCheck& check) {
  // Before the file is opened: opening allocates a table as long as the image is high.
  Imf::Header::setMaxImageSize(max_side, max_side);
  Imf::Header::setMaxTileSize(max_side, max_side);
  Imf::MultiPartInputFile file(path.c_str());
  const Imf::Header& header = file.header(0);
  Image image;
  read_header(header, file_size, check, image);
  image.data.resize(image.pixels() * image.channels.size());
  const auto& window = header.dataWindow();
  Imf::FrameBuffer target;
  for (const std::string& channel : image.channels) {
    target.insert(channel, Imf::Slice::Make(Imf::FLOAT, image.plane(channel).data(), window));
  }
  Imf::InputPart part(file, 0);
  part.setFrameBuffer(target);
  part.readPixels(window.min.y, window.max.y);
  return image;
}

}  // namespace

void write_exr(const std::string& path, const Image& image) {
  if (image.width < 1 || image.height < 1 || image.channels.empty() ||
      image.data.size() != image.pixels() * image.channels.size()) {
    throw std::invalid_argument("write_exr: the image's size and data disagree");
  }
  AtomicFile file(path);
  try {
    AtomicStream stream(path, file);
    Imf::FrameBuffer source;
    const Imf::Header header = header_of(image);
    for (const std::string& channel : image.channels) {
      const float* plane = image.plane(channel).data();
      source.insert(channel, Imf::Slice::Make(Imf::FLOAT, plane, header.dataWindow()));
    }
    Imf::OutputFile output(stream, header);
    output.setFrameBuffer(source);
    output.writePixels(image.height);
  } catch (const WorkError&) {
    throw;
  } catch (const std::exception& error) {
    throw WorkError("cannot write \"" + path + "\": " + error.what());
  }
  file.commit();
}

Image read_exr(const std::string& path, const ExrSizeCheck& check) {
  const Location where{path, 0};
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) throw InputError(where, "no such file");
  if (error) throw InputError(where, error.message());
  if (fs::is_directory(status)) throw InputError(where, "is a folder, not an OpenEXR file");
  const std::uint64_t size = fs::file_size(path, error);
  if (error) throw InputError(where, error.message());
  try {
    if (!Imf::isOpenExrFile(path.c_str())) {
      // False for an unreadable file, too: the two need different remedies.
      if (::access(path.c_str(), R_OK) != 0) throw InputError(where, "cannot be read");
      throw InputError(where, "is not an OpenEXR file");
    }
    check_attribute_sizes(path);
    return read_first_part(path, size, check);
  } catch (const InputError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw InputError(where, "the image does not fit into memory");
  } catch (const std::exception& failure) {
    throw InputError(where, std::string("cannot be read as OpenEXR: ") + failure.what());
  }
}

}  // namespace renderer
