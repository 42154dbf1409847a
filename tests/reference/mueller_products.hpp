// SPDX-License-Identifier: MIT
// Printed Mueller matrices and Stokes vectors with their products, from public-domain polarimetry
// data of the US National Institute of Standards and Technology (NIST). Matrices have eight digits.
#pragma once

namespace reference {

inline constexpr double product_m1[4][4] = {{0.94335668, -0.16250793, 0.46915549, -0.14212114},
                                            {-0.23542067, 0.62314123, -0.18648852, -0.05825565},
                                            {-0.01326436, -0.06702373, 0.02740091, -0.4182326},
                                            {0.37937625, -0.06489837, 0.54109253, 0.07621696}};
inline constexpr double product_m2[4][4] = {{0.90393586, 0.42883859, 0.05893816, -0.0398583},
                                            {-0.03255312, -0.05484299, 0.28021642, 0.20824843},
                                            {0.17437584, 0.3752689, -0.03803409, 0.08744445},
                                            {0.35288836, 0.34723155, 0.26526746, -0.43082467}};
inline constexpr double product_s1[4] = {1.2205852882966242, -0.07508395251618234,
                                         0.8002605801487375, -0.2529729329906206};
inline constexpr double product_s2[4] = {1.5964694635032322, -0.2407997868272278,
                                         0.5994372371241194, -0.8510075390636394};

inline constexpr double m1_times_s1[4] = {1.5750484699343372, -0.46864121761363126,
                                          0.11657152710872415, 0.8816680960253582};
inline constexpr double s1_transposed_times_m1[4] = {1.062536738150666, -0.2823616179668839,
                                                     0.4716926877767631, -0.5230727916610801};
inline constexpr double s1_dot_s2 = 2.661695204424655;
inline constexpr double m1_times_m2[4][4] = {{0.88968056, 0.54017069, -0.0454817, 0.03081172},
                                             {-0.28616721, -0.22534394, 0.15237873, 0.14794223},
                                             {-0.15261965, -0.13695333, -0.13154859, 0.16915209},
                                             {0.46629398, 0.39577053, 0.00381207, -0.01415688}};

}  // namespace reference
