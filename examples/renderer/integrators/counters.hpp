// SPDX-License-Identifier: MIT
// What an integrator counts on its way, for --stats.
#pragma once

#include <array>
#include <cstdint>
#include <malus/form.hpp>
#include <malus/measurement.hpp>

#include "physical_reading.hpp"

namespace renderer {

/// False where a sample is to be dropped, and counted: what is not finite leaves its mark on the
/// sum, as does what could not be added up.
template <class V>
bool is_finite(const malus::Measurement<V>& m) {
  return malus::is_finite(m[0] + m[1] + (m[2] + m[3]));
}

struct Counters {
  std::uint64_t rays = 0, shadow_rays = 0;
  std::uint64_t samples = 0;
  std::uint64_t light_vertices = 0, merges = 0;
  std::uint64_t non_finite = 0;  ///< readings that were NaN or infinite, and dropped
  std::uint64_t unphysical = 0;  ///< that were no light, by rounding, and made it
  std::array<std::uint64_t, malus::mueller_forms> forms{};  ///< of scatterings along camera paths
  std::uint64_t connections = 0, shadowed = 0;  ///< asked for light's way; found that it is barred
  std::uint64_t left_to_chance = 0;             ///< connections that chance did not make
  // Of polarised light alone:
  std::uint64_t dark_paths = 0;  ///< from the camera, that no light was deposited on
  std::uint64_t scatterings = 0, evaluated = 0;  ///< on camera paths; before the last deposit
  std::uint64_t stored_stokes = 0;               ///< light vertices whose light is polarised
  std::uint64_t merged_stokes = 0;  ///< merges for which a photon's polarisation was read

  /// Whether a reading may be added up.
  template <class V>
  bool admit(const malus::Measurement<V>& reading) {
    const bool finite = is_finite(reading);
    if (!finite) ++non_finite;
    return finite;
  }
  /// A reading of polarised light, made light if by rounding it was none.
  template <class V>
  malus::Measurement<V> made_light(const malus::Measurement<V>& reading) {
    if (is_physical(reading) || !is_finite(reading)) return reading;
    ++unphysical;
    return made_physical(reading);
  }

  /// A path from the camera whose result has been read.
  template <class Path>
  void count_path(const Path& path) {
    if constexpr (requires { path.evaluated(); }) {
      scatterings += path.scatterings();
      evaluated += path.evaluated();
      if (path.is_dark()) ++dark_paths;
    }
  }
  /// The light of a photon that is merged.
  template <class Light>
  void count_merged(const Light& light) {
    ++merges;
    if constexpr (requires { light.form(); })
      if (light.form() == malus::StokesForm::full) ++merged_stokes;
  }
  /// The light of a vertex that is stored.
  template <class Light>
  void count_stored(const Light& light) {
    if constexpr (requires { light.form(); })
      if (light.form() == malus::StokesForm::full) ++stored_stokes;
  }

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
    unphysical += c.unphysical;
    for (std::size_t i = 0; i < forms.size(); ++i) forms[i] += c.forms[i];
    connections += c.connections;
    shadowed += c.shadowed;
    left_to_chance += c.left_to_chance;
    dark_paths += c.dark_paths;
    scatterings += c.scatterings;
    evaluated += c.evaluated;
    stored_stokes += c.stored_stokes;
    merged_stokes += c.merged_stokes;
    return *this;
  }
};

}  // namespace renderer
