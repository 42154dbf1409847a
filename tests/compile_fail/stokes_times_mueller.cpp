// SPDX-License-Identifier: MIT
// Light traced from its source is multiplied from the left, too.
// expect: mueller_goes_on_the_left
#include <malus/malus.hpp>

using Bsdf = malus::Mueller<malus::Rgb, malus::incident, malus::exitant>;
using Arriving = malus::Stokes<malus::Rgb, malus::incident>;

auto combine(const Arriving& light, const Bsdf& bsdf) {
#ifdef MALUS_FAIL
  return light * bsdf;
#else
  return bsdf * light;
#endif
}
