// SPDX-License-Identifier: MIT
// Between two propagations something scatters; stretches of one ray are concatenated.
// expect: already_propagated
#include <malus/malus.hpp>

using Transmittance = malus::Mueller<malus::Rgb, malus::exitant, malus::incident>;

auto combine(const Transmittance& first, const Transmittance& second) {
#ifdef MALUS_FAIL
  return second * first;
#else
  return concatenate(first, second);
#endif
}
