// SPDX-License-Identifier: MIT
// Nothing acts on the polarisation of what has been read.
// expect: measurement_has_no_frame
#include <malus/malus.hpp>

using Bsdf = malus::Mueller<malus::Rgb, malus::incident, malus::exitant>;
using Importance = malus::Importance<malus::Rgb, malus::exitant>;
using Arriving = malus::Stokes<malus::Rgb, malus::incident>;

auto combine(const Bsdf& bsdf, const Importance& importance, const Arriving& light) {
#ifdef MALUS_FAIL
  return importance * (bsdf * light) * bsdf;
#else
  return importance * (bsdf * light);
#endif
}
