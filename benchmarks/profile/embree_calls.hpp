// SPDX-License-Identifier: MIT
// Embree's two calls for one ray under the names that the linker gives what it wraps
// (--wrap=rtcIntersect1): the renderer calls __wrap_…, Embree's own are __real_….
#pragma once

// What else a ray's call takes stands in front of the ray in Embree 3 and behind it in 4.
#if MALUS_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#define PROFILE_CALL(scene, context, query) (scene, query, context)
namespace profile {
using IntersectContext = RTCIntersectArguments;
using OccludedContext = RTCOccludedArguments;
}  // namespace profile
#else
#include <embree3/rtcore.h>
#define PROFILE_CALL(scene, context, query) (scene, context, query)
namespace profile {
using IntersectContext = RTCIntersectContext;
using OccludedContext = RTCIntersectContext;
}  // namespace profile
#endif

extern "C" {
void __real_rtcIntersect1 PROFILE_CALL(RTCScene, profile::IntersectContext*, RTCRayHit*);
void __real_rtcOccluded1 PROFILE_CALL(RTCScene, profile::OccludedContext*, RTCRay*);
void __wrap_rtcIntersect1 PROFILE_CALL(RTCScene, profile::IntersectContext*, RTCRayHit*);
void __wrap_rtcOccluded1 PROFILE_CALL(RTCScene, profile::OccludedContext*, RTCRay*);
}

namespace profile {

inline void intersect(RTCScene scene, RTCRayHit& query) {
#if MALUS_EMBREE_MAJOR >= 4
  __real_rtcIntersect1(scene, &query, nullptr);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  __real_rtcIntersect1(scene, &context, &query);
#endif
}

inline void occluded(RTCScene scene, RTCRay& query) {
#if MALUS_EMBREE_MAJOR >= 4
  __real_rtcOccluded1(scene, &query, nullptr);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  __real_rtcOccluded1(scene, &context, &query);
#endif
}

}  // namespace profile
