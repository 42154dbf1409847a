// SPDX-License-Identifier: MIT
// Embree's two calls for one ray under the names that the linker gives what it wraps
// (--wrap=rtcIntersect1): the renderer calls __wrap_…, Embree's own are __real_….
#pragma once

#if MALUS_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>

extern "C" void __real_rtcIntersect1(RTCScene, RTCRayHit*, RTCIntersectArguments*);
extern "C" void __real_rtcOccluded1(RTCScene, RTCRay*, RTCOccludedArguments*);
extern "C" void __wrap_rtcIntersect1(RTCScene, RTCRayHit*, RTCIntersectArguments*);
extern "C" void __wrap_rtcOccluded1(RTCScene, RTCRay*, RTCOccludedArguments*);
#else
#include <embree3/rtcore.h>

extern "C" void __real_rtcIntersect1(RTCScene, RTCIntersectContext*, RTCRayHit*);
extern "C" void __real_rtcOccluded1(RTCScene, RTCIntersectContext*, RTCRay*);
extern "C" void __wrap_rtcIntersect1(RTCScene, RTCIntersectContext*, RTCRayHit*);
extern "C" void __wrap_rtcOccluded1(RTCScene, RTCIntersectContext*, RTCRay*);
#endif

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
