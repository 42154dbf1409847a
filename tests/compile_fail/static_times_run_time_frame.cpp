// SPDX-License-Identifier: MIT
// How a frame that is a name lies to one that is known at run time is not known.
// expect: frames_differ
#include <malus/malus.hpp>

struct Laboratory;
using Named = malus::StaticFrame<Laboratory>;
using Element = malus::Mueller<float, malus::exitant, malus::exitant, Named>;

auto combine(const Element& element, const malus::Stokes<float, malus::exitant>& rendered,
             const malus::Stokes<float, malus::exitant, Named>& light) {
#ifdef MALUS_FAIL
  return element * rendered;
#else
  return element * light;
#endif
}
