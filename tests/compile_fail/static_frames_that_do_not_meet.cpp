// SPDX-License-Identifier: MIT
// An element expects light in its own enter frame.
// expect: frames_differ
#include <malus/malus.hpp>

struct Laboratory;
struct Tilted;
template <class Tag>
using Light = malus::Stokes<float, malus::exitant, malus::StaticFrame<Tag>>;
template <class Tag>
using Element = malus::Mueller<float, malus::exitant, malus::exitant, malus::StaticFrame<Tag>>;

auto combine(const Element<Laboratory>& element, const Light<Tilted>& tilted,
             const Light<Laboratory>& light) {
#ifdef MALUS_FAIL
  return element * tilted;
#else
  return element * light;
#endif
}
