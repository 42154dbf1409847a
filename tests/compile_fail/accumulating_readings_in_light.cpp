// SPDX-License-Identifier: MIT
// What a sensor has read is no light any more.
// expect: measurement_has_no_frame
#include <malus/malus.hpp>

using Arriving = malus::Stokes<malus::Rgb, malus::incident>;
using Importance = malus::Importance<malus::Rgb, malus::incident>;

void accumulate(Arriving& radiance, malus::Measurement<malus::Rgb>& pixel, const Importance& sensor,
                const Arriving& light) {
#ifdef MALUS_FAIL
  radiance += sensor * light;
#else
  pixel += sensor * light;
#endif
}
