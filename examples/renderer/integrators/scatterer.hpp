// SPDX-License-Identifier: MIT
// What a path is scattered by at a vertex: a surface's BSDF or, where there are media, what a
// medium scatters, σ_s times its phase function. Integrators are templated on which of the two
// there can be: without media all of this is the BSDF alone.
//
// A point in a medium is a SurfacePoint without a surface: its normals are zero.
#pragma once

#include "../bsdfs/bsdf.hpp"
#include "../media/medium.hpp"

namespace renderer {

/// A scene of surfaces alone.
struct NoMedia {
  static constexpr bool present = false;
  /// Surfaces draw directions whatever the polarisation.
  struct Polarization {};
};
/// A scene with participating media.
struct WithMedia {
  static constexpr bool present = true;
  using Polarization = LinearPolarization;
};

template <class M>
class Scatterer;

template <>
class Scatterer<NoMedia> {
 public:
  Scatterer() = default;
  explicit Scatterer(const Bsdf& bsdf) : bsdf_(&bsdf) {}

  static constexpr bool is_medium() { return false; }
  bool is_delta() const { return bsdf_->is_delta(); }

  MALUS_INLINE static bool sides_agree(const SurfacePoint& p, const Vec3& w) {
    return p.sides_agree(w);
  }
  /// |cos| of a direction with the normal that the BSDF sees: what it is weighted by.
  MALUS_INLINE static float cosine(const SurfacePoint& p, const Vec3& w) {
    return std::abs(glm::dot(p.normal, w));
  }
  /// |cos| with the real surface's normal: what turns solid angle into area.
  MALUS_INLINE static float geometric_cosine(const SurfacePoint& p, const Vec3& w) {
    return std::abs(glm::dot(p.geometric_normal, w));
  }

  bool sample(const SurfacePoint& p, const Vec3& known, Tracing tracing, NoMedia::Polarization,
              Sampler& sampler, BsdfSample& result) const {
    return bsdf_->sample(p, known, tracing, sampler, result);
  }
  BsdfValue value(const SurfacePoint& p, const Vec3& incident, const Vec3& exitant) const {
    return bsdf_->value(p, incident, exitant);
  }
  template <class R>
  typename R::Scattering weight(const SurfacePoint& p, const Vec3& known, Tracing tracing,
                                const BsdfSample& sample) const {
    return bsdf_->template weight<R>(p, known, tracing, sample);
  }
  template <class R>
  typename R::Scattering scattering(const SurfacePoint& p, const Vec3& incident,
                                    const Vec3& exitant, const BsdfValue& value) const {
    return bsdf_->template scattering<R>(p, incident, exitant, value);
  }

 private:
  const Bsdf* bsdf_ = nullptr;
};

template <>
class Scatterer<WithMedia> {
 public:
  Scatterer() = default;
  explicit Scatterer(const Bsdf& bsdf) : bsdf_(&bsdf) {}
  explicit Scatterer(const Medium& medium) : medium_(&medium) {}

  /// Else it is a surface.
  bool is_medium() const { return medium_ != nullptr; }
  const Medium& medium() const { return *medium_; }
  bool is_delta() const { return bsdf_ && bsdf_->is_delta(); }

  bool sides_agree(const SurfacePoint& p, const Vec3& w) const {
    return is_medium() || p.sides_agree(w);
  }
  float cosine(const SurfacePoint& p, const Vec3& w) const {
    return is_medium() ? 1 : std::abs(glm::dot(p.normal, w));
  }
  float geometric_cosine(const SurfacePoint& p, const Vec3& w) const {
    return is_medium() ? 1 : std::abs(glm::dot(p.geometric_normal, w));
  }

  /// `polarization` is that of what the path carries.
  bool sample(const SurfacePoint& p, const Vec3& known, Tracing tracing,
              const LinearPolarization& polarization, Sampler& sampler, BsdfSample& result) const {
    if (!is_medium()) return bsdf_->sample(p, known, tracing, sampler, result);
    medium_->phase().sample(known, polarization, sampler, result);
    result.weight *= medium_->scattering(p.position);
    return true;
  }
  BsdfValue value(const SurfacePoint& p, const Vec3& incident, const Vec3& exitant) const {
    if (!is_medium()) return bsdf_->value(p, incident, exitant);
    BsdfValue result = medium_->phase().value(incident, exitant);
    result.lobe = medium_->scattering(p.position);
    result.m00 *= result.lobe;
    return result;
  }
  template <class R>
  typename R::Scattering weight(const SurfacePoint& p, const Vec3& known, Tracing tracing,
                                const BsdfSample& sample) const {
    if (!is_medium()) return bsdf_->template weight<R>(p, known, tracing, sample);
    if constexpr (!R::polarized) {
      return sample.weight;
    } else {
      const PhaseFunction& phase = medium_->phase();
      if (!phase.polarizes()) return R::depolarizer(sample.weight);
      const Flow flow(known, sample.direction, tracing);
      return phase.template scattering<R>(flow.incident, flow.exitant, {}) *
             (medium_->scattering(p.position) * (1 / (sample.pdf * sample.likelihood)));
    }
  }
  template <class R>
  typename R::Scattering scattering(const SurfacePoint& p, const Vec3& incident,
                                    const Vec3& exitant, const BsdfValue& value) const {
    if (!is_medium()) return bsdf_->template scattering<R>(p, incident, exitant, value);
    if constexpr (!R::polarized) {
      return value.m00;
    } else {
      const PhaseFunction& phase = medium_->phase();
      if (!phase.polarizes()) return R::depolarizer(value.m00);
      return phase.template scattering<R>(incident, exitant, value) * value.lobe;
    }
  }

 private:
  const Bsdf* bsdf_ = nullptr;
  const Medium* medium_ = nullptr;
};

}  // namespace renderer
