// SPDX-License-Identifier: MIT
// Whether two points see each other, and what the sheets, masks and media between them do to light
// on its way from the one to the other.
#pragma once

#include <algorithm>
#include <limits>
#include <malus/radiometry.hpp>

#include "counters.hpp"
#include "way.hpp"

namespace renderer {

/// Keep one a thread.
template <class R, class M>
class Visibility {
 public:
  using Place = typename Way<M>::Place;

  Visibility(const Scene& scene, Counters& counters) : scene_(scene), counters_(counters) {}

  /// True if light gets through from the end of a ray, short of `target`, to its start, off `from`,
  /// which is in the medium of `place`. Sheets and masks let it pass, though not more of them than
  /// `most`.
  bool open(const Ray& ray, const Vec3& from, const Vec3& target, int most, Place place,
            Sampler& sampler) {
    ++counters_.connections;
    begin(from, target);
    ++counters_.shadow_rays;
    if (scene_.geometry.occluded(ray)) return shadow();
    if (scene_.has_passages())
      return open_through_passages(ray, target, most, place, sampler) || shadow();
    fly_to(target, place, sampler);
    return true;
  }

  /// What is left of light, sent from the end of the ray that open() was asked about, at its start.
  /// A ray that is traced against the light meets last what acts first.
  typename R::Light through(const typename R::Light& light) {
    if constexpr (M::present) {
      if (!has_acted_) return light * attenuation_;
      passages_.deposit(light * attenuation_);
    } else {
      if (!scene_.has_passages() || passed_ == 0) return light;
      passages_.deposit(light);
    }
    return passages_.result();
  }
  /// The same, times a factor.
  typename R::Light through(const typename R::Light& light, float factor) {
    if constexpr (M::present) {
      if (!has_acted_) return light * (attenuation_ * factor);
    } else {
      if (!scene_.has_passages() || passed_ == 0) return light * factor;
    }
    return through(light) * factor;
  }

  /// What is left of light that a light sends, for `use`: unpolarised, for all that a compiler
  /// sees, where nothing on the way can have changed that.
  template <class Use>
  MALUS_INLINE void emitted(const Rgb& radiance, Use&& use) {
    if constexpr (M::present) {
      if (!has_acted_) return use(R::unpolarized(radiance * attenuation_));
    } else {
      if (!scene_.has_passages() || passed_ == 0) return use(R::unpolarized(radiance));
    }
    use(through(R::unpolarized(radiance)));
  }

  /// Whether something on the way makes intensity of polarisation, or the other way round.
  bool may_polarize() const {
    if constexpr (M::present) return has_acted_;
    return passed() > 0;
  }
  /// How many sheets and masks open() has let light through.
  int passed() const { return scene_.has_passages() ? passed_ : 0; }
  /// Of the media on the way, for unpolarised light, as MIS weights know it.
  typename Way<M>::Transmittance transmittance() const { return transmittance_; }

 private:
  /// Of one way: more than any scene has, but a ray that gets nowhere comes to its end.
  static constexpr int most_passages = 1 << 16;

  bool shadow() {
    ++counters_.shadowed;
    return false;
  }

  void begin(const Vec3& from, const Vec3& target) {
    if constexpr (M::present) {
      way_ = {from, normalized(target - from), 0};
      attenuation_ = transmittance_ = Rgb(1.0f);
      has_acted_ = false;
      passages_.begin();
    }
  }

  bool open_through_passages(Ray ray, const Vec3& target, int most, Place place, Sampler& sampler) {
    if constexpr (!M::present) passages_.begin();
    const Vec3 to_end = normalized(ray.direction);
    for (passed_ = 0;; ++passed_) {
      Hit hit;
      ++counters_.shadow_rays;
      if (!scene_.intersect_passages(ray, hit)) {
        fly_to(target, place, sampler);
        return true;
      }
      if (passed_ == std::min(most, most_passages)) return false;
      fly_to(hit.position, place, sampler);
      if constexpr (M::present)
        place = scene_.shapes[hit.shape].beyond(glm::dot(hit.geometric_normal, to_end) > 0, place);
      if (!pass(hit, -to_end)) return false;
      ray = hit.leave_for(target, to_end);
      // What is nearer to a surface than rays start off it has been reached. In the surface's own
      // plane, a ray there may meet the surface again and again.
      if (!(glm::dot(ray.direction, to_end) > 0) || hit.touches(target)) {
        fly_to(target, place, sampler);
        ++passed_;
        return true;
      }
    }
  }

  bool pass(Hit& hit, const Vec3& light) {
    const Material& material = scene_.shapes[hit.shape].material;
    const float opacity = material.is_masked() ? material.opacity(hit) : 1;
    const Bsdf& bsdf = material.facing(hit, light);
    if (bsdf.is_nothing()) return true;
    if (!bsdf.is_sheet()) {
      act(R::plain(Rgb(1 - opacity)));
      return opacity < 1;
    }
    const auto sheet = bsdf.template transmit<R>(hit, light);
    act(opacity < 1 ? sheet * opacity + R::plain(Rgb(1 - opacity)) : sheet);
    return true;
  }

  void act(const typename R::Scattering& passage) {
    passages_.scatter(passage);
    if constexpr (M::present) has_acted_ = true;
  }

  /// Through the medium on to a point of the way. What counts is where the points are, not how far
  /// off their surfaces the rays between them start.
  void fly_to(const Vec3& point, Place place, Sampler& sampler) {
    if constexpr (M::present) {
      const float flown = glm::dot(point - way_.from, way_.direction);
      const float length = std::max(flown - way_.flown, 0.0f);
      const Ray way{way_.from + way_.flown * way_.direction, way_.direction};
      way_.flown = flown;
      if (!place) return;
      const Rgb expected = place->expected_transmittance(way, length);
      transmittance_ *= expected;
      if (place->extinguishes_by_polarization()) {
        passages_.transmit(place->template polarized_transmittance<R>(-way.direction, length));
        has_acted_ = true;
      } else {
        attenuation_ *=
            place->is_homogeneous() ? expected : place->transmittance(way, length, sampler);
      }
    }
  }

  struct OnTheWay {
    Vec3 from, direction;
    float flown;
  };

  const Scene& scene_;
  Counters& counters_;
  typename R::CameraPath passages_;  // in the order in which the ray meets them
  int passed_ = 0;
  OnTheWay way_{};  // of media
  // Of the media: what every frame and order leaves alone.
  Rgb attenuation_{1.0f};
  bool has_acted_ = false;
  MALUS_NO_UNIQUE_ADDRESS typename Way<M>::Transmittance transmittance_{};
};

}  // namespace renderer
