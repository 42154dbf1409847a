// SPDX-License-Identifier: MIT
// Importance stands to the left of the light it measures.
// expect: importance_goes_on_the_left
#include <malus/malus.hpp>

using Leaving = malus::Stokes<malus::Rgb, malus::exitant>;
using Importance = malus::Importance<malus::Rgb, malus::exitant>;

auto combine(const Leaving& light, const Importance& importance) {
#ifdef MALUS_FAIL
  return light * importance;
#else
  return importance * light;
#endif
}
