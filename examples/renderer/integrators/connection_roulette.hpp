// SPDX-License-Identifier: MIT
// Russian roulette for connections (Veach 1997, chapter 10): one that would bring little, if
// nothing were in its way, is made by chance alone, and then counts for all that were not. It saves
// the shadow ray and, of polarised light, what becomes of it at both ends.
//
// Little is less than a part t of the indirect light L that the camera path has been brought so
// far. A connection that would bring c is made with the chance p = c / (t L), which adds
//
//   c² (1/p − 1) = c (t L − c)  <=  t c L
//
// to the variance: for all that are left to chance no more than a part t of the mean of L², little
// of which is not noise already. Direct light, also by way of mirrors, is no measure: it may be
// free of noise, and what is small beside it must not become the picture's noise.
#pragma once

#include "../core/vector.hpp"

namespace renderer {

/// Of one camera path at a time.
class ConnectionRoulette {
 public:
  void begin() { found_ = Rgb(0.0f); }

  /// The chance with which a connection is made that would bring `expected`: 1 unless that is
  /// little in every channel, as with a threshold of 0.
  MALUS_INLINE float chance(const Rgb& expected, float threshold) const {
    const Rgb enough = found_ * threshold;
    if (malus::max_channel(expected - enough) >= 0) return 1;
    return malus::max_channel(expected / enough);
  }
  /// Something has been brought, and will count as so much.
  void find(const Rgb& light) { found_ += light; }

 private:
  Rgb found_{0.0f};
};

}  // namespace renderer
