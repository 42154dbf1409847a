// SPDX-License-Identifier: MIT
// A filter before a sensor reads what arrives there; a BSDF gives what leaves the vertex before.
// expect: call_propagate_first
#include <malus/malus.hpp>

using Analyzer = malus::Analyzer<malus::Rgb, malus::incident>;
using Bsdf = malus::Mueller<malus::Rgb, malus::incident, malus::exitant>;

auto combine(const Analyzer& filter, const Bsdf& bsdf) {
#ifdef MALUS_FAIL
  return filter * bsdf;
#else
  return propagate(filter) * bsdf;
#endif
}
