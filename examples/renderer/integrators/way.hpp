// SPDX-License-Identifier: MIT
// A path's way from one vertex to the next: it ends at a surface, is scattered in a medium on the
// way, or leads out of the scene. Surfaces that light passes straight through are no ends of it.
// Without media all of this is a ray to the next surface.
#pragma once

#include "../scene/scene.hpp"
#include "camera_path.hpp"

namespace renderer {

enum class End { nothing, surface, medium };

/// Where a path is among the media, and what they have let through since its last vertex.
template <class M>
class Way;

template <>
class Way<NoMedia> {
 public:
  struct Place {};
  struct Transmittance {};

  explicit Way(const Scene& scene) : scene_(scene) {}
  static Place of_sensor(const Scene&) { return {}; }
  static Place of(const EmissionSample&) { return {}; }

  void begin(Place) {}
  template <class Path>
  MALUS_INLINE End advance(const Ray& ray, Hit& hit, const Path&, Sampler&) {
    return scene_.intersect(ray, hit) ? End::surface : End::nothing;
  }
  static void meet(const Hit&) {}
  static Place towards(const Vec3&) { return {}; }
  static void pass(const Vec3&) {}
  static void scatter(const Vec3&) {}
  static Scatterer<NoMedia> scatterer(End) { return {}; }
  static Transmittance transmittance() { return {}; }
  static Transmittance clear() { return {}; }

 private:
  const Scene& scene_;
};

template <>
class Way<WithMedia> {
 public:
  using Place = const Medium*;  ///< null in vacuum
  using Transmittance = Rgb;

  explicit Way(const Scene& scene) : scene_(scene) {}
  static Place of_sensor(const Scene& scene) { return scene.sensor_medium; }
  static Place of(const EmissionSample& e) { return e.medium; }

  void begin(Place medium) {
    medium_ = medium;
    surface_ = nullptr;
    lead_ = 0;
    transmittance_ = Rgb(1.0f);
  }

  /// Along a ray to the next surface, unless the path is scattered before: then the hit is a point
  /// in the medium. `path` loses what the medium takes from it.
  template <class Path>
  MALUS_INLINE End advance(const Ray& ray, Hit& hit, const Path& path, Sampler& sampler) {
    const bool found = scene_.intersect(ray, hit);
    surface_ = nullptr;
    const End end = found ? End::surface : End::nothing;
    if (!medium_) return end;
    // The medium begins at the surface that the ray starts off.
    const float lead = found ? std::min(lead_, hit.distance) : lead_;
    const Ray way{ray.origin - lead * ray.direction, ray.direction};
    const float length = lead + (found ? hit.distance : ray.length);
    if (medium_->emits()) path.find_emission(*medium_, way, length, sampler);
    const Flight flight = medium_->fly(way, length, path.throughput(), sampler);
    transmittance_ *= flight.transmittance;
    path.fly(*medium_, ray.direction, flight);
    if (!flight.is_scattered) return end;
    static_cast<SurfacePoint&>(hit) = point_in_medium(way.origin + flight.distance * ray.direction);
    lead_ = 0;
    return End::medium;
  }

  /// A hit as Scene::intersect() found it, before its material flips it.
  void meet(const Hit& hit) {
    surface_ = &scene_.shapes[hit.shape];
    outwards_ = hit.geometric_normal;
    reach_ = hit.reach;
  }
  /// The medium that a ray from here starts in.
  Place towards(const Vec3& direction) const {
    return surface_ ? surface_->beyond(glm::dot(outwards_, direction) > 0, medium_) : medium_;
  }
  /// Straight on through a surface that is no vertex.
  void pass(const Vec3& direction) {
    medium_ = towards(direction);
    if (surface_) lead_ = reach_ / std::abs(glm::dot(outwards_, direction));
  }
  /// On from a vertex.
  void scatter(const Vec3& direction) {
    pass(direction);
    transmittance_ = Rgb(1.0f);
  }
  /// What scatters the path at the end of its way; a surface's BSDF is still to be found.
  Scatterer<WithMedia> scatterer(End end) const {
    return end == End::medium ? Scatterer<WithMedia>(*medium_) : Scatterer<WithMedia>();
  }
  /// Of unpolarised light since the last vertex, as MIS weights know it.
  const Rgb& transmittance() const { return transmittance_; }
  /// As though there were no medium: the most that is left.
  static Transmittance clear() { return Rgb(1.0f); }

 private:
  const Scene& scene_;
  Place medium_ = nullptr;
  const Shape* surface_ = nullptr;  // that the path is at
  Vec3 outwards_{};                 // its normal
  float reach_ = 0;                 // how far off it the next ray starts
  float lead_ = 0;                  // how far behind that the ray would have left it
  Rgb transmittance_{1.0f};
};

/// How likely a path is to arrive at a surface by a way of this transmittance. MIS weights compare
/// techniques by it: that paths draw distances by what they carry matters less than that this is a
/// function of the way alone, the same for all techniques.
inline float arrival_chance(const Rgb& transmittance) {
  // Above zero, however thick the medium: where density varies, more may get through than is
  // expected. Its inverse leaves single precision room.
  return std::max((transmittance[0] + transmittance[1] + transmittance[2]) * (1.0f / 3), 1e-12f);
}
constexpr float arrival_chance(Way<NoMedia>::Transmittance) { return 1; }

/// The same of any vertex: in a medium, the density by length of being scattered there.
inline float arrival_density(const Scatterer<WithMedia>& end, const Vec3& position,
                             const Rgb& transmittance) {
  return arrival_chance(end.is_medium() ? end.medium().extinction(position) * transmittance
                                        : transmittance);
}
constexpr float arrival_density(const Scatterer<NoMedia>&, const Vec3&,
                                Way<NoMedia>::Transmittance) {
  return 1;
}

/// How a light path's light is polarised, if that is asked for.
template <class R, class M>
typename M::Polarization carried_polarization(const typename R::Light& light, const Scene& scene) {
  if constexpr (M::present && R::polarized)
    return scene.draws_by_polarization ? LinearPolarization(light) : LinearPolarization();
  else
    return {};
}

/// A path from the camera in media: light comes against its rays.
template <class R, class M>
struct CameraSide {
  CameraPath<R, M>& path;
  bool finds_emission = true;  ///< of the media

  Rgb throughput() const { return path.throughput(); }
  void find_emission(const Medium& medium, const Ray& ray, float length, Sampler& sampler) const {
    if (finds_emission) path.deposit(medium.template emitted<R>(ray, length, sampler));
  }
  void fly(const Medium& medium, const Vec3& ray_direction, const Flight& flight) const {
    if (medium.extinguishes_by_polarization())
      path.transmit(
          medium.template polarized_transmittance<Matrices>(-ray_direction, flight.distance));
    path.attenuate(flight.weight);
  }

 private:
  /// Whose matrices media make, if R has any.
  using Matrices = std::conditional_t<R::polarized, malus::Polarized<Rgb>, R>;
};

/// A path from a light in media.
template <class R>
struct LightSide {
  typename R::Light& light;
  Rgb& share;  ///< of its power, that unpolarised light would have kept

  const Rgb& throughput() const { return share; }
  void find_emission(const Medium&, const Ray&, float, Sampler&) const {}
  void fly(const Medium& medium, const Vec3& ray_direction, const Flight& flight) const {
    if (medium.extinguishes_by_polarization()) {
      const auto t = medium.template polarized_transmittance<R>(ray_direction, flight.distance);
      light = R::transmit(t, light);
      share *= m00(t);
    }
    light *= flight.weight;
    share *= flight.weight;
  }

 private:
  static Rgb m00(const Rgb& t) { return t; }
  template <class T>
  static Rgb m00(const T& t) {
    return t.m00();
  }
};

}  // namespace renderer
