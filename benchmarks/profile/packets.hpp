// SPDX-License-Identifier: MIT
// What a renderer would gain by tracing many rays at a time: the rays of a picture by path tracing,
// one at a time and in packets, in the order of paths, of a wavefront (the first rays of all paths,
// then the second ones, …), and of a wavefront that is sorted by direction and place.
#pragma once

#include <string>

#include "scene/scene.hpp"

namespace profile {

/// Nanoseconds a ray. In packets: by the faster of the ways that Embree has for coherent rays and
/// for others.
struct PacketTimes {
  std::string rays;  ///< nearest hits, or shadow rays
  std::size_t count = 0;
  double path = 0;                             ///< one at a time, path by path
  double wavefront = 0;                        ///< one at a time, in the order of a wavefront
  double packets_of_8 = 0, packets_of_16 = 0;  ///< of a wavefront
  double sorting = 0;                          ///< and moving the rays
  double sorted = 0;                           ///< one at a time
  double sorted_packets_of_8 = 0, sorted_packets_of_16 = 0;
};

/// Of the nearest hits and the shadow rays of one sample a pixel. Spheres are left out of what the
/// rays are traced through, all alike: the renderer's own take one ray at a time.
struct BothPacketTimes {
  PacketTimes nearest, shadow;
};
BothPacketTimes time_packets(const renderer::Scene& scene, double seconds);

}  // namespace profile
