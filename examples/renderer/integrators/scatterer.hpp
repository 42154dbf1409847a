// SPDX-License-Identifier: MIT
// What a path is scattered by at a vertex: a surface's BSDF or, where there are media, what a
// medium scatters, σ_s times its phase function. Integrators are templated on which of the two
// there can be: without media all of this is the BSDF alone.
//
// A point in a medium is a SurfacePoint without a surface: its normals are zero.
#pragma once

#include "../bsdfs/bsdf.hpp"
#include "../media/medium.hpp"
#include "counters.hpp"

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
  /// Else it depolarises.
  bool polarizes() const { return bsdf_->polarizes() || bsdf_->is_sheet(); }

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

  template <class Sample>
  bool sample(const SurfacePoint& p, const Vec3& known, Tracing tracing, NoMedia::Polarization,
              Sampler& sampler, Sample& result) const {
    return bsdf_->sample(p, known, tracing, sampler, result);
  }
  template <class R>
  BsdfValueOf<R> value(const SurfacePoint& p, const Vec3& incident, const Vec3& exitant) const {
    return bsdf_->value<R>(p, incident, exitant);
  }
  template <class R, class Use>
  MALUS_INLINE decltype(auto) with_weight(const SurfacePoint& p, const Vec3& known, Tracing tracing,
                                          const BsdfSampleOf<R>& sample, float factor,
                                          Use&& use) const {
    return bsdf_->with_weight<R>(p, known, tracing, sample, factor, use);
  }
  template <class R, class Use>
  MALUS_INLINE decltype(auto) with_scattering(const SurfacePoint& p, const Vec3& incident,
                                              const Vec3& exitant, const BsdfValueOf<R>& value,
                                              Use&& use) const {
    return bsdf_->with_scattering<R>(p, incident, exitant, value, use);
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
  /// Else it depolarises.
  bool polarizes() const {
    return is_medium() ? medium_->phase().polarizes() : bsdf_->polarizes() || bsdf_->is_sheet();
  }

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
  template <class Sample>
  bool sample(const SurfacePoint& p, const Vec3& known, Tracing tracing,
              const LinearPolarization& polarization, Sampler& sampler, Sample& result) const {
    if (!is_medium()) return bsdf_->sample(p, known, tracing, sampler, result);
    medium_->phase().sample(known, polarization, sampler, result);
    result.weight *= medium_->scattering(p.position);
    return true;
  }
  template <class R>
  BsdfValueOf<R> value(const SurfacePoint& p, const Vec3& incident, const Vec3& exitant) const {
    if (!is_medium()) return bsdf_->value<R>(p, incident, exitant);
    BsdfValueOf<R> result(medium_->phase().value(incident, exitant));
    result.lobe = medium_->scattering(p.position);
    result.m00 *= result.lobe;
    return result;
  }
  template <class R, class Use>
  MALUS_INLINE decltype(auto) with_weight(const SurfacePoint& p, const Vec3& known, Tracing tracing,
                                          const BsdfSampleOf<R>& sample, float factor,
                                          Use&& use) const {
    if constexpr (!R::polarized) {
      return use(sample.weight * factor);
    } else {
      if (!is_medium()) return bsdf_->with_weight<R>(p, known, tracing, sample, factor, use);
      if (!polarizes()) return use(R::depolarizer(sample.weight * factor));
      return with_phase_weight<R>(p, known, tracing, sample, factor, use);
    }
  }
  /// The same in a medium that polarises.
  template <class R, class Use>
  MALUS_INLINE decltype(auto) with_phase_weight(const SurfacePoint& p, const Vec3& known,
                                                Tracing tracing, const BsdfSampleOf<R>& sample,
                                                float factor, Use&& use) const {
    const Flow flow(known, sample.direction, tracing);
    return medium_->phase().with_matrix<R>(
        flow.incident, flow.exitant,
        medium_->scattering(p.position) * (factor / (sample.pdf * sample.likelihood)), use);
  }
  template <class R, class Use>
  MALUS_INLINE decltype(auto) with_scattering(const SurfacePoint& p, const Vec3& incident,
                                              const Vec3& exitant, const BsdfValueOf<R>& value,
                                              Use&& use) const {
    if constexpr (!R::polarized) {
      return use(value.m00);
    } else {
      if (!is_medium()) return bsdf_->with_scattering<R>(p, incident, exitant, value, use);
      const PhaseFunction& phase = medium_->phase();
      if (!phase.polarizes()) return use(R::depolarizer(value.m00));
      return phase.with_matrix<R>(incident, exitant, value.lobe, use);
    }
  }

 private:
  const Bsdf* bsdf_ = nullptr;
  const Medium* medium_ = nullptr;
};

/// What a BSDF has for its matrix, or, for families that multiply with matrices alone, the matrix.
template <class R, class F>
MALUS_INLINE decltype(auto) as_taken_by(const F& f) {
  if constexpr (requires(typename R::Light light) { R::scatter(f, light); })
    return (f);
  else
    return as_matrix(f);
}

/// Light that arrives at a point, after scattering in directions whose value() is known. Where it
/// is depolarised next, no more is made of it than its intensity.
template <class R, class M>
RENDERER_FLATTEN typename R::Light scatter(const Scatterer<M>& scatterer, const SurfacePoint& p,
                                           const Vec3& incident, const Vec3& exitant,
                                           const BsdfValueOf<R>& value,
                                           const typename R::Light& light,
                                           bool reads_polarization = true) {
  if constexpr (!R::polarized) {
    return value.m00 * light;
  } else {
    if (!reads_polarization && R::is_unpolarized(light))
      return R::unpolarized(value.m00 * R::intensity(light));
    return scatterer.template with_scattering<R>(p, incident, exitant, value, [&](const auto& f) {
      return R::scatter(as_taken_by<R>(f), light, reads_polarization);
    });
  }
}

/// The same, deposited at a camera path's current vertex. Of unpolarised light no more than the
/// matrix's first column is made, and where the vertex before depolarises no more than m00.
template <class R, class M, class Sum>
MALUS_INLINE void deposit_scattered(Sum& sum, const SurfacePoint& p, const Vec3& incident,
                                    const Vec3& exitant, const Scatterer<M>& scatterer,
                                    const BsdfValueOf<R>& value, const typename R::Light& light) {
  if constexpr (R::defers) {
    if (R::is_unpolarized(light)) {
      const Rgb intensity = R::intensity(light);
      if (!sum.reads_polarization() || !scatterer.polarizes())
        return sum.deposit(R::unpolarized(value.m00 * intensity));
      return scatterer.template with_scattering<R>(
          p, incident, exitant, value, [&](const auto& f) MALUS_INLINE_LAMBDA {
            sum.deposit(R::scatter_unpolarized(f, intensity));
          });
    }
  }
  sum.deposit(scatter<R>(scatterer, p, incident, exitant, value, light, sum.reads_polarization()));
}

/// Light that arrives at a point, after scattering to a drawn direction, times a factor.
template <class R, class M>
typename R::Light scatter(const Scatterer<M>& scatterer, const SurfacePoint& p, const Vec3& known,
                          Tracing tracing, const BsdfSampleOf<R>& sample, float factor,
                          const typename R::Light& light) {
  return scatterer.template with_weight<R>(p, known, tracing, sample, factor, [&](const auto& f) {
    return R::scatter(as_taken_by<R>(f), light);
  });
}

}  // namespace renderer
