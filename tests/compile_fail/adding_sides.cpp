// SPDX-License-Identifier: MIT
// Light that arrives and light that leaves are different light.
// expect: sides_differ
#include <malus/malus.hpp>

using Bsdf = malus::Mueller<malus::Rgb, malus::incident, malus::exitant>;
using Arriving = malus::Stokes<malus::Rgb, malus::incident>;
using Leaving = malus::Stokes<malus::Rgb, malus::exitant>;

auto combine(const Leaving& emitted, const Bsdf& bsdf, const Arriving& light) {
#ifdef MALUS_FAIL
  return emitted + light;
#else
  return emitted + bsdf * light;
#endif
}
