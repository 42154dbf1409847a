// SPDX-License-Identifier: MIT
// Elements compose right to left, (C<-B)(B<-A): the other order does not meet.
// expect: frames_differ
#include <malus/malus.hpp>

struct Laboratory;
struct Tilted;
using Laboratory_frame = malus::StaticFrame<Laboratory>;
using Tilted_frame = malus::StaticFrame<Tilted>;
using Tilting =
    malus::Mueller<float, malus::exitant, malus::exitant, Laboratory_frame, Tilted_frame>;
using Element = malus::Mueller<float, malus::exitant, malus::exitant, Tilted_frame>;

auto combine(const Tilting& tilting, const Element& element) {
#ifdef MALUS_FAIL
  return tilting * element;
#else
  return element * tilting;
#endif
}
