// SPDX-License-Identifier: MIT
// A Mueller matrix adds to Mueller matrices.
// expect: kinds_differ
#include <malus/malus.hpp>

using Bsdf = malus::Mueller<malus::Rgb, malus::incident, malus::exitant>;
using Arriving = malus::Stokes<malus::Rgb, malus::incident>;
using Leaving = malus::Stokes<malus::Rgb, malus::exitant>;

auto combine(const Leaving& emitted, const Bsdf& bsdf, const Arriving& light) {
#ifdef MALUS_FAIL
  return emitted + bsdf;
#else
  return emitted + bsdf * light;
#endif
}
