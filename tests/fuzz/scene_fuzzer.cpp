// SPDX-License-Identifier: MIT
// Scenes: read, built, analysed and, of a few pixels, rendered. The files that the corpus's scenes
// refer to lie beside the scene.
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>

#include "render/render.hpp"
#include "scene/build.hpp"
#include "scene/needs.hpp"
#include "scene/requirements.hpp"
#include "scene/xml_reader.hpp"
#include "scratch.hpp"

namespace {

/// A few pixels of the film, in its middle, so that every scene is quick.
void crop(renderer::FilmSettings& film) {
  const int width = std::min(film.crop_width, 3), height = std::min(film.crop_height, 2);
  film.crop_x += (film.crop_width - width) / 2;
  film.crop_y += (film.crop_height - height) / 2;
  film.crop_width = width;
  film.crop_height = height;
}

void render_a_little(renderer::Scene& scene) {
  crop(scene.film);
  renderer::RenderOptions options;
  options.samples_per_pixel = 2;
  options.threads = 1;
  options.batches = 1;
  static const std::atomic<bool> stop{false};
  const renderer::Rendering rendering = renderer::render(scene, options, stop, {});
  const renderer::Image image = rendering.film.image(renderer::StokesFrame::horizontal);
  for (const float value : image.data)
    if (std::isnan(value)) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Scratch scratch;
  static const bool has_companions = (scratch.copy_from(MALUS_FUZZ_COMPANIONS), true);
  if (!has_companions) return 0;
  const auto path = scratch.write("scene.xml", fuzz::text_of(data, size));
  try {
    renderer::Scene scene = renderer::build_scene(*renderer::read_scene(path, {}));
    renderer::check_requirements(scene, path.string());
    const renderer::Needs needs = renderer::find_needs(scene);
    if (size % 2 == 0) renderer::skip_what_is_not_needed(needs, scene);
    render_a_little(scene);
  } catch (const renderer::InputError& refusal) {
    // A file that the scene names may be the one that is wrong.
    if (std::string_view(refusal.what()).find(scratch.folder().string()) == std::string_view::npos)
      std::abort();
  }
  return 0;
}
