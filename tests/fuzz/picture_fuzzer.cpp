// SPDX-License-Identifier: MIT
// Pictures: as a texture, whatever the format; and OpenEXR as malus-image reads it.
#include "io/exr.hpp"
#include "scratch.hpp"
#include "textures/read_texels.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Scratch scratch;
  const auto bytes = fuzz::text_of(data, size);
  const auto path = scratch.write("a.picture", bytes);
  fuzz::expect_read_or_refused(path, [&] {
    const renderer::Texels texels = renderer::read_texels(path, false);
    if (texels.values.empty()) std::abort();
    for (const auto& value : texels.values)
      for (std::size_t c = 0; c < 3; ++c)
        if (!std::isfinite(value[c])) std::abort();
  });
  if (bytes.starts_with("\x76\x2f\x31\x01"))
    fuzz::expect_read_or_refused(path, [&] { renderer::read_exr(path.string()); });
  return 0;
}
