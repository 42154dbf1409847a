// SPDX-License-Identifier: MIT
// Importance stands to the left of what it measures.
// expect: importance_goes_on_the_left
#include <malus/malus.hpp>

using Bsdf = malus::Mueller<malus::Rgb, malus::incident, malus::exitant>;
using Importance = malus::Importance<malus::Rgb, malus::exitant>;

auto combine(const Bsdf& bsdf, const Importance& importance) {
#ifdef MALUS_FAIL
  return bsdf * importance;
#else
  return importance * bsdf;
#endif
}
