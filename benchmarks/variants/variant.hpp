// SPDX-License-Identifier: MIT
// What is compared: the families that the renderer's integrators can be instantiated with.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "render/passes.hpp"

namespace variants {

enum class Variant { unpolarized, naive, optimized, automatic };

inline constexpr Variant all_variants[] = {Variant::unpolarized, Variant::naive, Variant::optimized,
                                           Variant::automatic};

const char* name_of(Variant variant);

/// A rendering of the scene's algorithm that can go on for as long as one likes.
std::unique_ptr<renderer::Passes> make_passes(Variant variant, const renderer::Scene& scene,
                                              std::uint64_t seed, renderer::Film& film);

}  // namespace variants
