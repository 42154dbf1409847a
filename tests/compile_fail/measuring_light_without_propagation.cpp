// SPDX-License-Identifier: MIT
// A sensor measures light that arrives.
// expect: call_propagate_first
#include <malus/malus.hpp>

using Sensor = malus::Importance<malus::Rgb, malus::incident>;
using Leaving = malus::Stokes<malus::Rgb, malus::exitant>;

auto combine(const Sensor& sensor, const Leaving& light) {
#ifdef MALUS_FAIL
  return sensor * light;
#else
  return sensor * propagate(light);
#endif
}
