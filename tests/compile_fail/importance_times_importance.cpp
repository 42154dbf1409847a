// SPDX-License-Identifier: MIT
// Two importances have no product; both measure light.
// expect: importance_measures_light_only
#include <malus/malus.hpp>

using Importance = malus::Importance<malus::Rgb, malus::exitant>;
using Leaving = malus::Stokes<malus::Rgb, malus::exitant>;

auto combine(const Importance& importance, const Importance& other, const Leaving& light) {
#ifdef MALUS_FAIL
  return importance * other * light;
#else
  return importance * light + other * light;
#endif
}
