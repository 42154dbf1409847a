// SPDX-License-Identifier: MIT
#include "png.hpp"

#include <png.h>

#include <string>
#include <string_view>

#include "atomic_file.hpp"
#include "input_error.hpp"

namespace renderer {

void write_png(const std::string& path, const Picture& picture) {
  png_image description = {};
  description.version = PNG_IMAGE_VERSION;
  description.width = static_cast<png_uint_32>(picture.width());
  description.height = static_cast<png_uint_32>(picture.height());
  description.format = PNG_FORMAT_RGB;
  const auto encode = [&](void* target, png_alloc_size_t& size) {
    if (png_image_write_to_memory(&description, target, &size, 0, picture.bytes().data(), 0,
                                  nullptr) == 0) {
      throw WorkError("cannot write \"" + path + "\": " + description.message);
    }
  };
  // The largest it can get; asking libpng for the exact size would compress the picture twice.
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(description);
  std::string encoded(size, '\0');
  encode(encoded.data(), size);
  write_file(path, std::string_view(encoded).substr(0, size));
}

}  // namespace renderer
