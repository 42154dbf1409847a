// SPDX-License-Identifier: MIT
// Readings are summed with readings.
// expect: measurement_has_no_frame
#include <malus/malus.hpp>

using Measurement = malus::Measurement<malus::Rgb>;
using Importance = malus::Importance<malus::Rgb, malus::exitant>;
using Leaving = malus::Stokes<malus::Rgb, malus::exitant>;

auto combine(const Measurement& readings, const Importance& importance, const Leaving& light) {
#ifdef MALUS_FAIL
  return readings + light;
#else
  return readings + importance * light;
#endif
}
