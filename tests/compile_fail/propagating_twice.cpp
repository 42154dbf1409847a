// SPDX-License-Identifier: MIT
// Light that has arrived is not under way any more.
// expect: already_propagated
#include <malus/malus.hpp>

using Leaving = malus::Stokes<malus::Rgb, malus::exitant>;

auto combine(const Leaving& light) {
#ifdef MALUS_FAIL
  return propagate(propagate(light));
#else
  return propagate(light);
#endif
}
