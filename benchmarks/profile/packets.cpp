// SPDX-License-Identifier: MIT
#include "packets.hpp"

#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <vector>

#include "recording.hpp"

namespace profile {

namespace {

using Rays = std::vector<RTCRay>;

/// The first rays of all paths, then the second ones, …
struct Wavefront {
  std::vector<Rays> fronts;
  Rays in_order_of_paths;
  std::size_t count() const { return in_order_of_paths.size(); }
};

/// A ray that comes straight from the camera, from wherever its near plane is.
bool leaves(const renderer::Vec3& camera, const RTCRay& ray) {
  const renderer::Vec3 direction(ray.dir_x, ray.dir_y, ray.dir_z);
  const renderer::Vec3 way = renderer::Vec3(ray.org_x, ray.org_y, ray.org_z) - camera;
  const renderer::Vec3 aside = glm::cross(direction, way);
  return glm::dot(direction, way) >= 0 && glm::dot(aside, aside) <= 1e-9f * glm::dot(way, way);
}

/// A path begins with the ray that leaves the camera.
std::pair<Wavefront, Wavefront> fronts_of(const Recording& recording,
                                          const renderer::Vec3& camera) {
  Wavefront nearest, shadow;
  std::size_t edge = 0;
  for (const RecordedRay& r : recording.rays) {
    if (!r.is_shadow) edge = leaves(camera, r.ray) ? 0 : edge + 1;
    Wavefront& w = r.is_shadow ? shadow : nearest;
    if (w.fronts.size() <= edge) w.fronts.resize(edge + 1);
    w.fronts[edge].push_back(r.ray);
    w.in_order_of_paths.push_back(r.ray);
  }
  return {nearest, shadow};
}

// tracing

struct Packet8 {
  using Hits = RTCRayHit8;
  using Shadows = RTCRay8;
  static constexpr std::size_t size = 8;
};
struct Packet16 {
  using Hits = RTCRayHit16;
  using Shadows = RTCRay16;
  static constexpr std::size_t size = 16;
};

#if MALUS_EMBREE_MAJOR >= 4
constexpr auto coherent = RTC_RAY_QUERY_FLAG_COHERENT, incoherent = RTC_RAY_QUERY_FLAG_INCOHERENT;
using Flags = RTCRayQueryFlags;
#else
constexpr auto coherent = RTC_INTERSECT_CONTEXT_FLAG_COHERENT,
               incoherent = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
using Flags = RTCIntersectContextFlags;
#endif

template <class Queries>
void ask(RTCScene scene, const int* valid, Queries& q, Flags flags) {
  constexpr bool by_8 = std::is_same_v<Queries, RTCRayHit8> || std::is_same_v<Queries, RTCRay8>;
  constexpr bool is_shadow = std::is_same_v<Queries, RTCRay8> || std::is_same_v<Queries, RTCRay16>;
#if MALUS_EMBREE_MAJOR >= 4
  std::conditional_t<is_shadow, RTCOccludedArguments, RTCIntersectArguments> how;
  if constexpr (is_shadow)
    rtcInitOccludedArguments(&how);
  else
    rtcInitIntersectArguments(&how);
  how.flags = flags;
  if constexpr (is_shadow && by_8) rtcOccluded8(valid, scene, &q, &how);
  if constexpr (is_shadow && !by_8) rtcOccluded16(valid, scene, &q, &how);
  if constexpr (!is_shadow && by_8) rtcIntersect8(valid, scene, &q, &how);
  if constexpr (!is_shadow && !by_8) rtcIntersect16(valid, scene, &q, &how);
#else
  RTCIntersectContext how;
  rtcInitIntersectContext(&how);
  how.flags = flags;
  if constexpr (is_shadow && by_8) rtcOccluded8(valid, scene, &how, &q);
  if constexpr (is_shadow && !by_8) rtcOccluded16(valid, scene, &how, &q);
  if constexpr (!is_shadow && by_8) rtcIntersect8(valid, scene, &how, &q);
  if constexpr (!is_shadow && !by_8) rtcIntersect16(valid, scene, &how, &q);
#endif
}

template <class PacketRays>
void put(const RTCRay& ray, PacketRays& to, std::size_t i) {
  to.org_x[i] = ray.org_x, to.org_y[i] = ray.org_y, to.org_z[i] = ray.org_z;
  to.dir_x[i] = ray.dir_x, to.dir_y[i] = ray.dir_y, to.dir_z[i] = ray.dir_z;
  to.tnear[i] = ray.tnear, to.tfar[i] = ray.tfar;
  to.time[i] = 0, to.mask[i] = ray.mask, to.id[i] = to.flags[i] = 0;
}

template <class Packet, bool IsShadow>
double seconds_in_packets(RTCScene scene, const Rays& rays, Flags flags) {
  constexpr std::size_t size = Packet::size;
  const double start = processor_seconds();
  for (std::size_t first = 0; first < rays.size(); first += size) {
    const std::size_t count = std::min(size, rays.size() - first);
    alignas(64) int valid[size];
    for (std::size_t i = 0; i < size; ++i) valid[i] = i < count ? -1 : 0;
    if constexpr (IsShadow) {
      typename Packet::Shadows q;
      for (std::size_t i = 0; i < count; ++i) put(rays[first + i], q, i);
      ask(scene, valid, q, flags);
    } else {
      typename Packet::Hits q;
      for (std::size_t i = 0; i < count; ++i) {
        put(rays[first + i], q.ray, i);
        q.hit.geomID[i] = q.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
      }
      ask(scene, valid, q, flags);
    }
  }
  return processor_seconds() - start;
}

double seconds_alone(RTCScene scene, const Rays& rays, bool is_shadow) {
  const double start = processor_seconds();
  for (const RTCRay& r : rays) trace(scene, r, is_shadow);
  return processor_seconds() - start;
}

// sorting

/// Of 9 bits each, in turns.
std::uint32_t interleaved(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  std::uint32_t bits = 0;
  for (std::uint32_t i = 0; i < 9; ++i)
    bits |= (x >> i & 1) << 3 * i | (y >> i & 1) << (3 * i + 1) | (z >> i & 1) << (3 * i + 2);
  return bits;
}

/// By the octant of directions, and along a curve through space.
Rays sorted(const Rays& rays, const renderer::Vec3& low, const renderer::Vec3& extent) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> keys(rays.size());
  const auto cell = [](float x, float from, float width) {
    return static_cast<std::uint32_t>(std::clamp((x - from) / width, 0.0f, 0.999f) * 512);
  };
  for (std::uint32_t i = 0; i < rays.size(); ++i) {
    const RTCRay& r = rays[i];
    const std::uint32_t octant =
        (r.dir_x < 0 ? 1u : 0u) | (r.dir_y < 0 ? 2u : 0u) | (r.dir_z < 0 ? 4u : 0u);
    keys[i] = {
        octant << 27 | interleaved(cell(r.org_x, low.x, extent.x), cell(r.org_y, low.y, extent.y),
                                   cell(r.org_z, low.z, extent.z)),
        i};
  }
  std::sort(keys.begin(), keys.end());
  Rays result(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) result[i] = rays[keys[i].second];
  return result;
}

/// The triangles of a scene.
RTCScene meshes_of(const renderer::Scene& scene, RTCScene all) {
  RTCScene meshes = rtcNewScene(rtcGetSceneDevice(all));
  rtcSetSceneFlags(meshes, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(meshes, RTC_BUILD_QUALITY_HIGH);
  for (std::uint32_t shape = 0; shape < scene.geometry.shape_count(); ++shape)
    if (!scene.geometry.is_sphere(shape))
      rtcAttachGeometryByID(meshes, rtcGetGeometry(all, shape), shape);
  rtcCommitScene(meshes);
  return meshes;
}

template <bool IsShadow>
PacketTimes time_fronts(const Wavefront& w, RTCScene scene, const renderer::Scene& of,
                        double seconds) {
  const renderer::Vec3 low = of.geometry.center() - renderer::Vec3(of.geometry.radius());
  const renderer::Vec3 extent(2 * of.geometry.radius());
  std::vector<double> path, wave, by_8[2], by_16[2], sorting, sorted_alone, sorted_8[2],
      sorted_16[2];
  const double start = processor_seconds();
  while (path.size() < 3 || processor_seconds() - start < seconds) {
    path.push_back(seconds_alone(scene, w.in_order_of_paths, IsShadow));
    for (auto* list : {&wave, &by_8[0], &by_8[1], &by_16[0], &by_16[1], &sorting, &sorted_alone,
                       &sorted_8[0], &sorted_8[1], &sorted_16[0], &sorted_16[1]})
      list->push_back(0);
    for (const Rays& front : w.fronts) {
      const double begin = processor_seconds();
      const Rays in_order = sorted(front, low, extent);
      sorting.back() += processor_seconds() - begin;
      wave.back() += seconds_alone(scene, front, IsShadow);
      sorted_alone.back() += seconds_alone(scene, in_order, IsShadow);
      for (const int way : {0, 1}) {
        const Flags flags = way ? coherent : incoherent;
        by_8[way].back() += seconds_in_packets<Packet8, IsShadow>(scene, front, flags);
        by_16[way].back() += seconds_in_packets<Packet16, IsShadow>(scene, front, flags);
        sorted_8[way].back() += seconds_in_packets<Packet8, IsShadow>(scene, in_order, flags);
        sorted_16[way].back() += seconds_in_packets<Packet16, IsShadow>(scene, in_order, flags);
      }
    }
  }
  const auto each = [&](const std::vector<double>& s) { return nanoseconds_of_each(s, w.count()); };
  const auto better = [&](const std::vector<double>(&s)[2]) {
    return std::min(each(s[0]), each(s[1]));
  };
  return {IsShadow ? "shadow" : "nearest",
          w.count(),
          each(path),
          each(wave),
          better(by_8),
          better(by_16),
          each(sorting),
          each(sorted_alone),
          better(sorted_8),
          better(sorted_16)};
}

}  // namespace

BothPacketTimes time_packets(const renderer::Scene& scene, double seconds) {
  renderer::RenderOptions options;
  options.mode = renderer::Mode::unpolarized;
  options.seed = 1;
  renderer::Film film(scene.film.crop_width, scene.film.crop_height, 1);
  const auto passes = renderer::make_passes(scene, options, film);
  const Recording recording = record(*passes);
  const auto [nearest, shadow] = fronts_of(recording, scene.sensor->origin());
  RTCScene meshes = meshes_of(scene, recording.rays.front().scene);
  const BothPacketTimes times{time_fronts<false>(nearest, meshes, scene, seconds / 2),
                              time_fronts<true>(shadow, meshes, scene, seconds / 2)};
  rtcReleaseScene(meshes);
  return times;
}

}  // namespace profile
