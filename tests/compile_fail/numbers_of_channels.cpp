// SPDX-License-Identifier: MIT
// Four wavelengths are not three colours.
// expect: value_types_differ
#include <malus/malus.hpp>

using Color = malus::Stokes<malus::Rgb>;
using Wavelengths = malus::Stokes<malus::Spectrum<float, 4>>;

auto combine(const Color& light, const Color& other, const Wavelengths& wavelengths) {
#ifdef MALUS_FAIL
  return light + wavelengths;
#else
  return light + other;
#endif
}
