// SPDX-License-Identifier: MIT
// A transmittance stands for the whole way: it acts on light that leaves.
// expect: already_propagated
#include <malus/malus.hpp>

using Transmittance = malus::Mueller<malus::Rgb, malus::exitant, malus::incident>;
using Leaving = malus::Stokes<malus::Rgb, malus::exitant>;

auto combine(const Transmittance& transmittance, const Leaving& light) {
#ifdef MALUS_FAIL
  return transmittance * propagate(light);
#else
  return transmittance * light;
#endif
}
