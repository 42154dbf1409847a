// SPDX-License-Identifier: MIT AND CC-BY-SA-3.0
// Radiance and polarisation of sunlight that a conservative layer of air scatters, published by
// people who solved the equation of radiative transfer otherwise. Direct sunlight is left out, all
// orders of scattering are in. MIT but for `iprt_rows`.
#pragma once

namespace reference {

/// V. Natraj, K.-F. Li & Y. L. Yung 2009, "Rayleigh scattering in planetary atmospheres: corrected
/// tables through accurate computation of X and Y functions", ApJ 691, 1909 (tables for an optical
/// thickness of 0.25): no depolarisation, a Lambertian ground. The sun's irradiance across its
/// beam is π. Cosines of the angles with the vertical, above 0; the azimuth, in degrees, is that of
/// the light's propagation against the sun's. With x = ∂k/∂θ of the direction of propagation k(θ,
/// φ), and y = ∂k/∂φ / sin θ, Q is −S1 and U is S2; V = 0.
struct NatrajRow {
  double albedo, sun_cosine, cosine, azimuth;
  bool leaves_top;  ///< up from the top, or else down from the bottom
  double i, q, u;
};

/// IPRT, the intercomparison of polarised radiative transfer models, phase A, case A1: an optical
/// thickness of 0.5 over black ground; the sun's irradiance is 1. Degrees: zenith angle of the sun,
/// its azimuth, and where the sensor looks. `altitude` is 0 below the layer, 1 above it. The
/// azimuth of the light's propagation against the sun's is vaa − saa; with x and y as above Q is S1
/// and U is S2; V = 0.
struct IprtRow {
  double depolarization;
  int altitude;
  double sza, saa, vza, vaa, i, q, u;
};

// clang-format off
inline constexpr double natraj_depth = 0.25;
inline constexpr NatrajRow natraj_rows[] = {
    {0, 0.2, 0.2, 60, false, 0.1347695, -0.07343681, 0.01576027},
    {0, 0.2, 0.2, 60, true, 0.15356195, -0.08048702, 0.0528878},
    {0, 0.6, 0.52, 60, false, 0.11830017, -0.03326974, 0.03285844},
    {0, 0.6, 0.52, 90, true, 0.09679276, -0.03227178, 0.06258521},
    {0, 0.92, 0.2, 60, true, 0.17128896, 0.11229159, 0.09806705},
    {0, 0.92, 0.52, 180, false, 0.08935652, 0.07497321, 0},
    {0.25, 0.2, 0.52, 60, true, 0.09722041, -0.03369408, 0.03783366},
    {0.25, 0.2, 0.92, 60, false, 0.0441608, -0.01827019, -0.01845375},
    {0.25, 0.2, 0.92, 60, true, 0.06602099, -0.01440369, 0.02827744},
    {0.25, 0.6, 0.2, 60, true, 0.26445545, -0.01688936, 0.13361969},
    {0.25, 0.6, 0.2, 90, false, 0.21434816, -0.05059237, 0.12764487},
    {0.25, 0.6, 0.52, 180, true, 0.26705008, -0.00708466, 0},
    {0.25, 0.6, 0.92, 0, true, 0.16863446, 0.04189594, 0},
    {0.25, 0.92, 0.2, 0, false, 0.29003023, 0.09168353, 0},
    {0.25, 0.92, 0.52, 90, true, 0.27909531, 0.03566483, 0.05010049},
    {0.25, 0.92, 0.92, 60, false, 0.12184754, -0.00424377, 0.00655545},
};

inline constexpr double iprt_depth = 0.5;
// Selected rows, reformatted, of the results of the model PSTAR: C. Emde et al. 2015, "IPRT
// polarized radiative transfer model intercomparison project - Phase A", J. Quant. Spectrosc.
// Radiat. Transfer 164, 8-36, DOI 10.1016/j.jqsrt.2015.05.007, from
// https://www.libradtran.org/iprt/lib/exe/fetch.php?media=intercomparisons:phase_a:a1:iprt_case_a1_pstar.dat
// Licensed under CC BY-SA 3.0 (https://creativecommons.org/licenses/by-sa/3.0/), as the IPRT
// wiki's content is; so is this table, which is adapted from it.
inline constexpr IprtRow iprt_rows[] = {
    {0, 0, 0, 65, 20, 65, 0.05794367, -0.003124366, 0},
    {0, 1, 0, 65, 120, 300, 0.0655145, -0.03225251, 0},
    {0.03, 0, 30, 0, 0, 0, 0.04944388, -0.005539456, 0},
    {0.03, 0, 30, 0, 20, 245, 0.04700209, -0.001061304, -0.01103045},
    {0.03, 0, 30, 0, 60, 120, 0.05409492, -0.01959279, 0.02873062},
    {0.03, 1, 30, 0, 160, 65, 0.04868928, -0.001105297, 0.0114826},
    {0.03, 1, 30, 0, 120, 245, 0.07130041, -0.006066814, -0.02449647},
    {0.1, 0, 30, 65, 20, 180, 0.04651855, -0.0008504898, 0.009488619},
    {0.1, 0, 30, 65, 60, 0, 0.06688533, -0.004511488, -0.01944172},
    {0.1, 0, 30, 65, 60, 300, 0.05546117, -0.01821086, -0.02374512},
    {0.1, 1, 30, 65, 180, 90, 0.04996065, -0.003213488, 0.003829686},
    {0.1, 1, 30, 65, 160, 120, 0.0473198, -0.003331056, 0.01015832},
    {0.1, 1, 30, 65, 120, 0, 0.06002072, -0.01622151, -0.02723473},
};
// clang-format on

}  // namespace reference
