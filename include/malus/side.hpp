// SPDX-License-Identifier: MIT
// The side of a vertex that light is on, in Veach's words. Scattering maps incident to exitant
// light, propagation maps exitant to incident; two tags therefore keep the types of a path-tracing
// loop stable.
//
// A side always speaks of the light, whichever way a path is traced: Importance<V, incident>
// measures incident light.
#pragma once

#include <concepts>

namespace malus {

struct incident;  ///< Light that arrives at a vertex.
struct exitant;   ///< Light that leaves a vertex.

template <class S>
concept SideTag = std::same_as<S, incident> || std::same_as<S, exitant>;

}  // namespace malus
