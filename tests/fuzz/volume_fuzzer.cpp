// SPDX-License-Identifier: MIT
// What media read: grid volumes ("VOL"), and all else as a table of phase functions.
#include "media/read_grid_volume.hpp"
#include "media/tabulated_phase.hpp"
#include "scratch.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Scratch scratch;
  const auto bytes = fuzz::text_of(data, size);
  const auto path = scratch.write("a.volume", bytes);
  fuzz::expect_read_or_refused(path, [&] {
    if (bytes.starts_with("VOL")) {
      renderer::read_grid_volume(path);
      return;
    }
    const renderer::TabulatedPhase phase = renderer::read_tabulated_phase(path);
    for (const float u : {0.0F, 0.3F, 0.9999999F}) {
      const float cosine = phase.sample(u);
      if (!(cosine >= -1 && cosine <= 1) || !std::isfinite(phase.pdf(cosine))) std::abort();
    }
  });
  return 0;
}
