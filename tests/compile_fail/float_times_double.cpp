// SPDX-License-Identifier: MIT
// Precision is changed by name, not by accident.
// expect: value_types_differ
#include <malus/malus.hpp>

using Bsdf = malus::Mueller<float, malus::incident, malus::exitant>;
template <class T>
using Arriving = malus::Stokes<T, malus::incident>;

auto combine(const Bsdf& bsdf, const Arriving<float>& light, const Arriving<double>& precise) {
#ifdef MALUS_FAIL
  return bsdf * precise;
#else
  return bsdf * light;
#endif
}
