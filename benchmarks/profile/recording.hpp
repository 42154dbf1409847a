// SPDX-License-Identifier: MIT
// The rays that a rendering asks Embree for.
#pragma once

#include <cstdint>
#include <vector>

#include "embree_calls.hpp"
#include "render/passes.hpp"

namespace profile {

struct RecordedRay {
  RTCScene scene;
  RTCRay ray;
  bool is_shadow;
};

/// Everything that one sample a pixel asks for, on one thread, in order; and how many paths there
/// are.
struct Recording {
  std::vector<RecordedRay> rays;
  std::uint64_t paths = 0;
};
Recording record(renderer::Passes& passes);

/// Of this thread.
double processor_seconds();

/// Nanoseconds of one of so many, by the median of measurements; 0 of none.
double nanoseconds_of_each(std::vector<double> seconds, std::size_t count);

/// Asks Embree about one ray.
void trace(RTCScene scene, const RTCRay& ray, bool is_shadow);

}  // namespace profile
