// SPDX-License-Identifier: MIT
#include "variant.hpp"

#include <stdexcept>
#include <string>

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

Variant variant_of(std::string_view name) {
  for (const Variant v : all_variants)
    if (name == name_of(v)) return v;
  throw std::invalid_argument("no variant is called " + std::string(name));
}

bool is_polarized(Variant variant, const renderer::Scene& scene) {
  if (variant == Variant::automatic) return renderer::find_needs(scene).polarization();
  return variant != Variant::unpolarized;
}

std::unique_ptr<renderer::Passes> make_passes(Variant variant, const renderer::Scene& scene,
                                              renderer::RenderOptions options,
                                              renderer::Film& film) {
  if (variant == Variant::naive)
    return scene.has_media() ? make_naive_media_passes(scene, options, film)
                             : make_naive_surface_passes(scene, options, film);
  options.stores_polarization =
      variant != Variant::automatic || renderer::find_needs(scene).stored_polarization();
  options.mode =
      is_polarized(variant, scene) ? renderer::Mode::optimized : renderer::Mode::unpolarized;
  return renderer::make_passes(scene, options, film);
}

}  // namespace variants
