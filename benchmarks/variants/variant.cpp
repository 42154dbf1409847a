// SPDX-License-Identifier: MIT
#include "variant.hpp"

#include "naive_passes.hpp"
#include "scene/needs.hpp"

namespace variants {

const char* name_of(Variant variant) {
  switch (variant) {
    case Variant::unpolarized:
      return "unpolarized";
    case Variant::naive:
      return "naive";
    case Variant::optimized:
      return "optimized";
    default:
      return "auto";
  }
}

std::unique_ptr<renderer::Passes> make_passes(Variant variant, const renderer::Scene& scene,
                                              std::uint64_t seed, renderer::Film& film) {
  renderer::RenderOptions options;
  options.seed = seed;
  if (variant == Variant::naive)
    return scene.has_media() ? make_naive_media_passes(scene, options, film)
                             : make_naive_surface_passes(scene, options, film);
  const renderer::Needs needs = renderer::find_needs(scene);
  const bool polarized =
      variant == Variant::optimized || (variant == Variant::automatic && needs.polarization());
  options.stores_polarization = variant == Variant::optimized || needs.stored_polarization();
  options.mode = polarized ? renderer::Mode::optimized : renderer::Mode::unpolarized;
  return renderer::make_passes(scene, options, film);
}

}  // namespace variants
