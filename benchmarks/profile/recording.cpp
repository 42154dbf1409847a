// SPDX-License-Identifier: MIT
#include "recording.hpp"

#include <algorithm>
#include <ctime>

namespace {

/// Null while nothing is recorded.
std::vector<profile::RecordedRay>* recording = nullptr;

void add(RTCScene scene, const RTCRay& ray, bool is_shadow) {
  if (recording) recording->push_back({scene, ray, is_shadow});
}

/// What keeps the compiler from leaving rays out.
volatile unsigned hits = 0;

}  // namespace

extern "C" void __wrap_rtcIntersect1 PROFILE_CALL(RTCScene scene, profile::IntersectContext* c,
                                                  RTCRayHit* query) {
  add(scene, query->ray, false);
  __real_rtcIntersect1 PROFILE_CALL(scene, c, query);
}
extern "C" void __wrap_rtcOccluded1 PROFILE_CALL(RTCScene scene, profile::OccludedContext* c,
                                                 RTCRay* query) {
  add(scene, *query, true);
  __real_rtcOccluded1 PROFILE_CALL(scene, c, query);
}

namespace profile {

Recording record(renderer::Passes& passes) {
  const auto iteration = [&] { passes.run(0, 1, [] { return false; }); };
  Recording result;
  iteration();  // takes memory
  const std::uint64_t before = passes.counters().samples;
  recording = &result.rays;
  iteration();
  recording = nullptr;
  result.paths = passes.counters().samples - before;
  return result;
}

double processor_seconds() {
  return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

double nanoseconds_of_each(std::vector<double> seconds, std::size_t count) {
  if (count == 0) return 0;
  const auto middle = seconds.begin() + static_cast<std::ptrdiff_t>(seconds.size() / 2);
  std::nth_element(seconds.begin(), middle, seconds.end());
  return 1e9 * *middle / static_cast<double>(count);
}

void trace(RTCScene scene, const RTCRay& ray, bool is_shadow) {
  if (is_shadow) {
    RTCRay query = ray;
    occluded(scene, query);
    if (query.tfar < 0) hits = hits + 1;
  } else {
    RTCRayHit query;
    query.ray = ray;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    intersect(scene, query);
    if (query.hit.geomID != RTC_INVALID_GEOMETRY_ID) hits = hits + 1;
  }
}

}  // namespace profile
