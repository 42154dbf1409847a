// SPDX-License-Identifier: MIT
// Matrices add within one space.
// expect: sides_differ
#include <malus/malus.hpp>

using Bsdf = malus::Mueller<malus::Rgb, malus::incident, malus::exitant>;
using Transmittance = malus::Mueller<malus::Rgb, malus::exitant, malus::incident>;

auto combine(const Bsdf& bsdf, const Bsdf& other, const Transmittance& transmittance) {
#ifdef MALUS_FAIL
  return bsdf + transmittance;
#else
  return bsdf + other;
#endif
}
