// SPDX-License-Identifier: MIT
// The phase matrix of homogeneous spheres, by Lorenz and Mie (malus/optics/mie_sizes.hpp),
// tabulated for the three channels.
#pragma once

#include <array>
#include <complex>

#include "tabulated_phase.hpp"

namespace renderer {

/// Spheres, log-normally distributed by number. Lengths are in micrometres.
struct MieParticles {
  double radius = 1;                  ///< the median
  double geometric_deviation = 1;     ///< σ_g; 1: all of one size
  std::complex<double> index = 1.33;  ///< n + ik, k ≥ 0 absorbs
  double surrounding_index = 1;
};

/// Red, green and blue where a picture has no other meaning: in vacuum, in micrometres.
inline constexpr std::array<double, 3> rgb_wavelengths{0.61, 0.55, 0.465};

/// Angles are as many as the largest spheres' fringes ask for, sizes as many as can be computed in
/// about a second on one core. Where particles can't be had an InputError at `where`: size
/// parameters 2πrn/λ are 1e-3 to 5000, of the median and of the largest spheres that count; σ_g is
/// 1 to 3; the index over the surrounding's is 0.05 to 20 in n and 0 to 20 in k, and is not 1.
TabulatedPhase make_mie_phase(const MieParticles& particles,
                              const std::array<double, 3>& wavelengths = rgb_wavelengths,
                              const Location& where = {});

/// The mean cross-sections of a particle a channel, over the extinction cross-section in green:
/// what a medium's extinction and scattering coefficients go by.
struct MieCrossSections {
  std::array<double, 3> extinction, scattering;
};
MieCrossSections mie_cross_sections(const MieParticles& particles,
                                    const std::array<double, 3>& wavelengths = rgb_wavelengths,
                                    const Location& where = {});

}  // namespace renderer
