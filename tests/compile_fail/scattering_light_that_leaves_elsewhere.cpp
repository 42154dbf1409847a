// SPDX-License-Identifier: MIT
// Light that leaves a vertex has to travel to the one that scatters it.
// expect: call_propagate_first
#include <malus/malus.hpp>

using Bsdf = malus::Mueller<malus::Rgb, malus::incident, malus::exitant>;
using Leaving = malus::Stokes<malus::Rgb, malus::exitant>;

auto combine(const Bsdf& bsdf, const Leaving& light) {
#ifdef MALUS_FAIL
  return bsdf * light;
#else
  return bsdf * propagate(light);
#endif
}
