// SPDX-License-Identifier: MIT
// What is compared: the families that the renderer's integrators can be instantiated with.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "render/passes.hpp"

namespace variants {

enum class Variant { unpolarized, naive, optimized, automatic };

inline constexpr Variant all_variants[] = {Variant::unpolarized, Variant::naive, Variant::optimized,
                                           Variant::automatic};

const char* name_of(Variant variant);

/// A variant as it is called on a command line and in tables: one of these names.
Variant variant_of(std::string_view name);

/// Whether it follows polarisation, in this scene.
bool is_polarized(Variant variant, const renderer::Scene& scene);

/// A rendering of the scene's algorithm that can go on for as long as one likes. The mode of the
/// options, and what they say of stored light, are the variant's to say.
std::unique_ptr<renderer::Passes> make_passes(Variant variant, const renderer::Scene& scene,
                                              renderer::RenderOptions options,
                                              renderer::Film& film);

}  // namespace variants
