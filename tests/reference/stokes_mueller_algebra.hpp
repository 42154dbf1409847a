// SPDX-License-Identifier: MIT
// Printed vectors and matrices of public polarisation packages: light of a given ellipse, an
// analysing row, the retarders of pypolar (S. Prahl), the rotator of Mitsuba 3. Their signs are
// those of Malus: S3 = S0 sin 2 chi, angles counter-clockwise, the fast axis ahead.
#pragma once

namespace reference {

struct Ellipse {
  double intensity, degree, orientation_degrees, ellipticity_degrees;
  double stokes[4];
};
inline constexpr Ellipse ellipses[] = {
    {1, 1, 34, 20, {1.0, 0.2869652992419897, 0.7102640395405222, 0.6427876096865393}},
    {3, 0.7, 34, 20, {3.0, 0.6026271284081782, 1.4915544830350964, 1.3498539803417322}},
};

/// pypolar: retarders of a phase (degrees) with the fast axis at an angle (degrees).
struct Retarder {
  double phase_degrees, axis_degrees;
  double m[4][4];
};
inline constexpr Retarder retarders[] = {
    {90, 0, {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}, {0, 0, -1, 0}}},
    {90, 90, {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 0, -1}, {0, 0, 1, 0}}},
    {90, 45, {{1, 0, 0, 0}, {0, 0, 0, -1}, {0, 0, 1, 0}, {0, 1, 0, 0}}},
    {90, -45, {{1, 0, 0, 0}, {0, 0, 0, 1}, {0, 0, 1, 0}, {0, -1, 0, 0}}},
    {180, 0, {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, -1, 0}, {0, 0, 0, -1}}},
    {180, 45, {{1, 0, 0, 0}, {0, -1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, -1}}},
};

/// The fraction that a polarizer passes of light polarised at 30 degrees to it.
inline constexpr double malus_30_degrees = 0.75;

/// Mitsuba 3: R(45 deg), which turns the *frame*, takes (1, 1, 0, 0) to (1, 0, -1, 0).
inline constexpr double frame_turned_45_degrees[4] = {1, 0, -1, 0};

/// A p-pass analyser of degree of polarisation 0.8, a row that stands on the left: what it reads of
/// p light (1, -1, 0, 0) and of s light (1, 1, 0, 0).
inline constexpr double analyzer_row[4] = {0.6, -0.4, 0, 0};
inline constexpr double analyzer_on_p = 1.0, analyzer_on_s = 0.2;

}  // namespace reference
