// SPDX-License-Identifier: MIT
// A static frame says nothing of how it lies to a run-time one.
// expect: frames_differ
#include <malus/malus.hpp>

struct Laboratory;
struct Tilted;
template <class Tag>
using Light = malus::Stokes<float, malus::exitant, malus::StaticFrame<Tag>>;
using Rendered = malus::Stokes<float, malus::exitant>;

auto combine(const Light<Laboratory>& light, const Light<Laboratory>& same,
             const Rendered& rendered) {
#ifdef MALUS_FAIL
  return light + rendered;
#else
  return light + same;
#endif
}
