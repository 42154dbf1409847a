// SPDX-License-Identifier: MIT
// Light that arrives is no part of the light that leaves: what scatters it is missing.
// expect: sides_differ
#include <malus/malus.hpp>

using Arriving = malus::Stokes<malus::Rgb, malus::incident>;
using Leaving = malus::Stokes<malus::Rgb, malus::exitant>;
using Bsdf = malus::Mueller<malus::Rgb, malus::incident, malus::exitant>;

void accumulate(Leaving& radiance, const Bsdf& bsdf, const Arriving& light) {
#ifdef MALUS_FAIL
  radiance += light;
#else
  radiance += bsdf * light;
#endif
}
