// SPDX-License-Identifier: MIT
// The product of two Stokes vectors that means something is the inner one.
// expect: use_inner_product
#include <malus/malus.hpp>

using Leaving = malus::Stokes<malus::Rgb, malus::exitant>;

auto combine(const Leaving& light, const Leaving& other) {
#ifdef MALUS_FAIL
  return light * other;
#else
  return inner_product(light, other);
#endif
}
