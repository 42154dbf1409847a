// SPDX-License-Identifier: MIT
// What an integrator counts on its way, for --stats.
#pragma once

#include <array>
#include <cstdint>
#include <malus/form.hpp>
#include <malus/measurement.hpp>

namespace renderer {

/// False where a sample is to be dropped, and counted.
template <class V>
bool is_finite(const malus::Measurement<V>& m) {
  for (std::size_t i = 0; i < 4; ++i)
    if (!malus::is_finite(m[i])) return false;
  return true;
}

struct Counters {
  std::uint64_t rays = 0, shadow_rays = 0;
  std::uint64_t samples = 0;
  std::uint64_t light_vertices = 0, merges = 0;
  std::uint64_t non_finite = 0;  ///< readings that were NaN or infinite, and dropped
  std::array<std::uint64_t, malus::mueller_forms> forms{};  ///< of scatterings along camera paths

  template <class Scattering>
  MALUS_INLINE void count(const Scattering& f) {
    ++forms[static_cast<std::size_t>(f.form())];
  }

  Counters& operator+=(const Counters& c) {
    rays += c.rays;
    shadow_rays += c.shadow_rays;
    samples += c.samples;
    light_vertices += c.light_vertices;
    merges += c.merges;
    non_finite += c.non_finite;
    for (std::size_t i = 0; i < forms.size(); ++i) forms[i] += c.forms[i];
    return *this;
  }
};

}  // namespace renderer
