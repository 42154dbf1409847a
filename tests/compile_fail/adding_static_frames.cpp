// SPDX-License-Identifier: MIT
// Light expressed in two static frames does not add as it stands.
// expect: frames_differ
#include <malus/malus.hpp>

struct Laboratory;
struct Tilted;
template <class Tag>
using Light = malus::Stokes<float, malus::exitant, malus::StaticFrame<Tag>>;

auto combine(const Light<Laboratory>& light, const Light<Laboratory>& same,
             const Light<Tilted>& tilted) {
#ifdef MALUS_FAIL
  return light + tilted;
#else
  return light + same;
#endif
}
