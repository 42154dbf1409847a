// SPDX-License-Identifier: MIT
// Between two scattering events light travels.
// expect: call_propagate_first
#include <malus/malus.hpp>

using Bsdf = malus::Mueller<malus::Rgb, malus::incident, malus::exitant>;

auto combine(const Bsdf& first, const Bsdf& second) {
#ifdef MALUS_FAIL
  return second * first;
#else
  return second * propagate(first);
#endif
}
