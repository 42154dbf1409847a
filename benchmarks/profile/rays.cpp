// SPDX-License-Identifier: MIT
#include "rays.hpp"

#include <algorithm>
#include <ctime>
#include <vector>

#include "embree_calls.hpp"

namespace {

struct Recorded {
  RTCScene scene;
  RTCRay ray;
  bool is_shadow;
};

/// Null while nothing is recorded.
std::vector<Recorded>* recording = nullptr;

void record(RTCScene scene, const RTCRay& ray, bool is_shadow) {
  if (recording) recording->push_back({scene, ray, is_shadow});
}

}  // namespace

extern "C" void __wrap_rtcIntersect1 PROFILE_CALL(RTCScene scene, profile::IntersectContext* c,
                                                  RTCRayHit* query) {
  record(scene, query->ray, false);
  __real_rtcIntersect1 PROFILE_CALL(scene, c, query);
}
extern "C" void __wrap_rtcOccluded1 PROFILE_CALL(RTCScene scene, profile::OccludedContext* c,
                                                 RTCRay* query) {
  record(scene, *query, true);
  __real_rtcOccluded1 PROFILE_CALL(scene, c, query);
}

namespace profile {

namespace {

double processor_seconds() {
  return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

/// What keeps the compiler from leaving rays out.
volatile unsigned hits = 0;

void trace(const Recorded& r) {
  if (r.is_shadow) {
    RTCRay query = r.ray;
    occluded(r.scene, query);
    if (query.tfar < 0) hits = hits + 1;
  } else {
    RTCRayHit query;
    query.ray = r.ray;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    intersect(r.scene, query);
    if (query.hit.geomID != RTC_INVALID_GEOMETRY_ID) hits = hits + 1;
  }
}

double seconds_of(const std::vector<Recorded>& rays) {
  const double start = processor_seconds();
  for (const Recorded& r : rays) trace(r);
  return processor_seconds() - start;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Nanoseconds of one of so many.
double each(const std::vector<double>& seconds, std::size_t count) {
  return count > 0 ? 1e9 * median(seconds) / static_cast<double>(count) : 0;
}

}  // namespace

RayTimes time_rays(const renderer::Scene& scene, renderer::Mode mode, double seconds) {
  renderer::RenderOptions options;
  options.mode = mode;
  options.seed = 1;
  renderer::Film film(scene.film.crop_width, scene.film.crop_height, 1);
  const auto passes = renderer::make_passes(scene, options, film);
  const auto iteration = [&] { passes->run(0, 1, [] { return false; }); };

  std::vector<Recorded> all;
  iteration();  // takes memory
  const std::uint64_t before = passes->counters().samples;
  recording = &all;
  iteration();
  recording = nullptr;
  const std::uint64_t paths = passes->counters().samples - before;
  std::vector<Recorded> nearest, shadow;
  for (const Recorded& r : all) (r.is_shadow ? shadow : nearest).push_back(r);

  std::vector<double> of_paths, of_all, of_nearest, of_shadow;
  const double start = processor_seconds();
  while (of_paths.size() < variants::least_pairs || processor_seconds() - start < seconds) {
    const double begin = processor_seconds();
    iteration();
    of_paths.push_back(processor_seconds() - begin);
    of_all.push_back(seconds_of(all));
    of_nearest.push_back(seconds_of(nearest));
    of_shadow.push_back(seconds_of(shadow));
  }
  RayTimes times;
  times.mode = mode == renderer::Mode::optimized ? "optimized" : "unpolarized";
  times.nearest_per_path = static_cast<double>(nearest.size()) / static_cast<double>(paths);
  times.shadow_per_path = static_cast<double>(shadow.size()) / static_cast<double>(paths);
  times.path = each(of_paths, paths);
  times.nearest = each(of_nearest, nearest.size());
  times.shadow = each(of_shadow, shadow.size());
  times.share = variants::ratio_of(of_all, of_paths);
  return times;
}

}  // namespace profile
