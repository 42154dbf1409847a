// SPDX-License-Identifier: MIT
// A sensor measures light that arrives; scattering gives light that leaves.
// expect: call_propagate_first
#include <malus/malus.hpp>

using Bsdf = malus::Mueller<malus::Rgb, malus::incident, malus::exitant>;
using Sensor = malus::Importance<malus::Rgb, malus::incident>;

auto combine(const Sensor& sensor, const Bsdf& bsdf) {
#ifdef MALUS_FAIL
  return sensor * bsdf;
#else
  return propagate(sensor) * bsdf;
#endif
}
