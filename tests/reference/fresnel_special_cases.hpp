// SPDX-License-Identifier: MIT
// Published special cases of Fresnel's equations at dielectrics and silicon. Amplitudes are those
// of {s, p, k} right-handed frames; Mueller matrices have Q = |Es|^2 - |Ep|^2.
#pragma once

namespace reference {

/// Amplitudes of light at `theta_degrees` in the medium n1 before the medium n2.
struct DielectricAmplitudes {
  const char* source;
  double theta_degrees, n1, n2, refracted_degrees, rs, rp;
};
inline constexpr DielectricAmplitudes dielectric_amplitudes[] = {
    {"Mitsuba 3, test_fresnel.py, after HyperPhysics", 45, 1, 1.5, 28.1255057020557,
     -0.3033370452904235, 0.09201336304552442},
    {"Mitsuba 3, test_fresnel.py, after HyperPhysics", 10, 1.5, 1, 15.098086605159006,
     0.20949431963852014, -0.19046797197779405},
    {"Brewster's angle, atan 1.5", 56.309932474020215, 1, 1.5, 33.690067525979785,
     -0.3846153846153846, 0},
};

/// Reflection at Brewster's angle atan 1.5: all four components of the upper block.
inline constexpr double brewster_reflection = 0.07396449704142012;

/// Normal incidence on n = 1.5: diagonals.
inline constexpr double normal_reflection[4] = {0.04, 0.04, -0.04, -0.04};
inline constexpr double normal_transmission[4] = {0.96, 0.96, 0.96, 0.96};

/// Mitsuba 3, test_mueller.py, test06: transmission out of n = 1.5 at the internal Brewster angle,
/// in single precision.
inline constexpr double brewster_transmission_degrees = 33.690067525979785;
inline constexpr double brewster_transmission[4][4] = {{0.9260355, -0.07396451, 0, 0},
                                                       {-0.07396451, 0.9260355, 0, 0},
                                                       {0, 0, 0.92307705, 0},
                                                       {0, 0, 0, 0.92307705}};

/// |arg r_p - arg r_s| of one total internal reflection.
struct TotalReflectionPhase {
  const char* source;
  double n, theta_degrees, phase_degrees, tolerance_degrees;
};
inline constexpr TotalReflectionPhase total_reflection_phases[] = {
    {"R. M. A. Azzam 2004, J. Opt. Soc. Am. A 21, the maximum at n = 1.5", 1.5, 51.67118189854412,
     0.7895822393995231 * 57.29577951308232, 1e-7},
    {"Fresnel's rhomb, pypolar's documentation", 1.5151, 48.044, 45, 1e-3},
    {"Fresnel's rhomb, pypolar's documentation", 1.5151, 55.0822, 45, 1e-3},
    {"Fresnel's rhomb, the textbooks' 48 deg 37.5'", 1.51, 48.6243591603269, 45, 1e-8},
    {"Fresnel's rhomb, the textbooks' 54 deg 37.4'", 1.51, 54.62310544118644, 45, 1e-8},
    {"Azzam's maximum at n = 1.51", 1.51, 51.33910001978324, 45.94166680703442, 1e-7},
};

/// Silicon at 60 degrees by pySCATMECH (T. A. Germer, NIST): amplitudes, and the matrix in
/// SCATMECH's signs, V = 2 Im(Es* Ep), exp(-i omega t): left circular positive, so that M23 and M32
/// change sign in Malus.
inline constexpr double silicon_rs[2] = {-0.7875336574103252, -0.001629630653451164};
inline constexpr double silicon_rp[2] = {0.37351472018980436, 0.003391942682930761};
inline constexpr double silicon_power[2] = {0.6202119172501502, 0.13952475147363208};
inline constexpr double silicon[4][4] = {{0.37986833, 0.24034358, 0, 0},
                                         {0.24034358, 0.37986833, 0, 0},
                                         {0, 0, -0.29416094, 0.00206258},
                                         {0, 0, -0.00206258, -0.29416094}};

}  // namespace reference
