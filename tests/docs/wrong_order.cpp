// SPDX-License-Identifier: MIT
// The README's example: light of a lamp, scattered at two surfaces on its way to a sensor.
// expect: mueller_goes_on_the_left
#include <malus/malus.hpp>

using namespace malus;
using Light = Stokes<Rgb, exitant>;            // leaves a vertex, in a frame of its own
using Bsdf = Mueller<Rgb, incident, exitant>;  // what a vertex makes of light that arrives there
using Sensor = Importance<Rgb, incident>;      // four readings of what arrives at the sensor

Measurement<Rgb> path(const Light& lamp, const Bsdf& first, const Bsdf& second,
                      const Sensor& sensor) {
#ifdef MALUS_FAIL
  return propagate(lamp) * first * second * sensor;
#else
  return sensor * propagate(second * propagate(first * propagate(lamp)));
#endif
}
