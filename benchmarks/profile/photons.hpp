// SPDX-License-Identifier: MIT
// What queries of the photon map take, beside what memory allows: reading as much memory from one
// end to the other, and reading cache lines of it at random.
#pragma once

#include <cstddef>
#include <string>

#include "scene/scene.hpp"

namespace profile {

struct PhotonTimes {
  std::string mode;
  std::size_t photons = 0, bytes_per_photon = 0, bytes = 0;  ///< the latter of the map
  double build = 0;                                          ///< ns a photon
  double query = 0;             ///< ns, at the first vertices of camera paths, row by row
  double found_per_query = 0;   ///< photons within the radius
  double found_bandwidth = 0;   ///< their bytes, in GB/s
  double stream_bandwidth = 0;  ///< reading the map's size from end to end, GB/s
  double random_line = 0;       ///< ns of a cache line at random in the map's size
};

/// Of light paths as many as the picture has pixels, with the first iteration's radius, on one
/// thread.
PhotonTimes time_photons(const renderer::Scene& scene, bool polarized, double seconds);

}  // namespace profile
