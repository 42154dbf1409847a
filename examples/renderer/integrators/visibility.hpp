// SPDX-License-Identifier: MIT
// Whether two points see each other, and what the sheets and masks between them do to light on its
// way from the one to the other.
#pragma once

#include <limits>
#include <malus/radiometry.hpp>

#include "../scene/scene.hpp"
#include "counters.hpp"

namespace renderer {

/// Keep one a thread.
template <class R>
class Visibility {
 public:
  Visibility(const Scene& scene, Counters& counters) : scene_(scene), counters_(counters) {}

  /// True if light gets through from the end of a ray, short of `target`, to its start. Sheets and
  /// masks let it pass, though not more of them than `most`.
  bool open(const Ray& ray, const Vec3& target, int most = std::numeric_limits<int>::max()) {
    if (scene_.has_passages()) return open_through_passages(ray, target, most);
    ++counters_.shadow_rays;
    return !scene_.geometry.occluded(ray);
  }

  /// What is left of light, sent from the end of the ray that open() was asked about, at its start.
  /// A ray that is traced against the light meets last what acts first.
  typename R::Light through(const typename R::Light& light) {
    if (!scene_.has_passages() || passed_ == 0) return light;
    passages_.deposit(light);
    return passages_.result();
  }

  /// How many sheets and masks open() has let light through.
  int passed() const { return scene_.has_passages() ? passed_ : 0; }

 private:
  bool open_through_passages(Ray ray, const Vec3& target, int most) {
    passages_.begin();
    const Vec3 to_end = normalized(ray.direction);
    for (passed_ = 0;; ++passed_) {
      Hit hit;
      ++counters_.shadow_rays;
      if (!scene_.intersect(ray, hit)) return true;
      if (passed_ == most || !pass(hit, -to_end)) return false;
      ray = hit.leave_for(target, to_end);
    }
  }

  bool pass(Hit& hit, const Vec3& light) {
    const Material& material = scene_.shapes[hit.shape].material;
    const float opacity = material.is_masked() ? material.opacity(hit) : 1;
    const Bsdf& bsdf = material.facing(hit, light);
    if (!bsdf.is_sheet()) {
      passages_.scatter(R::plain(Rgb(1 - opacity)));
      return opacity < 1;
    }
    const auto sheet = bsdf.template transmit<R>(hit, light);
    passages_.scatter(opacity < 1 ? sheet * opacity + R::plain(Rgb(1 - opacity)) : sheet);
    return true;
  }

  const Scene& scene_;
  Counters& counters_;
  typename R::CameraPath passages_;
  int passed_ = 0;
};

}  // namespace renderer
