// SPDX-License-Identifier: MIT
// Any BSDF.
#pragma once

#include <concepts>
#include <variant>

#include "conductor.hpp"
#include "dielectric.hpp"
#include "diffuse.hpp"
#include "flat_elements.hpp"
#include "plastic.hpp"
#include "polarized_plastic.hpp"
#include "rough_conductor.hpp"
#include "rough_dielectric.hpp"

namespace renderer {

template <class B>
inline constexpr bool is_sheet_kind = std::derived_from<B, StraightThrough<B>>;

class Bsdf {
 public:
  using Kind = std::variant<Diffuse, Conductor, Dielectric, RoughConductor, RoughDielectric,
                            Plastic, PolarizedPlastic, LinearPolarizer, LinearRetarder,
                            CircularPolarizer, NullSurface>;

  Bsdf(Kind kind) : kind_(std::move(kind)) {  // NOLINT: any kind is a BSDF
    std::visit(
        [this]<class B>(const B&) {
          is_delta_ = B::is_delta;
          polarizes_ = B::polarizes;
          is_sheet_ = is_sheet_kind<B>;
          is_nothing_ = is_sheet_kind<B> && !B::polarizes;
        },
        kind_);
  }

  const Kind& kind() const { return kind_; }
  /// Scatters into discrete directions alone: nothing connects to it.
  bool is_delta() const { return is_delta_; }
  /// Light passes straight on: shadow rays go through.
  bool is_sheet() const { return is_sheet_; }
  /// An invisible surface.
  bool is_nothing() const { return is_nothing_; }
  /// Can make polarised light of unpolarised light, or change polarised light but by a factor.
  bool polarizes() const { return polarizes_; }
  /// The same for unpolarised light, of which nothing but the intensity counts afterwards: the
  /// scattering's m00 alone.
  Bsdf as_depolarizer() const {
    Bsdf result(*this);
    result.polarizes_ = false;
    return result;
  }

  /// Draws the direction that isn't known, by m00; false where no light is scattered. The result
  /// is a BsdfSampleOf<R> for the weight<R>() that it is drawn for.
  template <std::derived_from<BsdfSample> Sample>
  bool sample(const SurfacePoint& point, const Vec3& known, Tracing tracing, Sampler& sampler,
              Sample& result) const {
    return std::visit(
        [&](const auto& b) { return b.sample(point, known, tracing, sampler, result); }, kind_);
  }

  /// The scattering of a sample, times |cos|/pdf and a factor, as the type that its kind has. Its
  /// m00 is the sample's weight, times the factor.
  template <class R, class Use>
  MALUS_INLINE decltype(auto) with_weight(const SurfacePoint& point, const Vec3& known,
                                          Tracing tracing, const BsdfSampleOf<R>& sample,
                                          float factor, Use&& use) const {
    if constexpr (!R::polarized) {
      return use(sample.weight * factor);
    } else {
      if (!polarizes_ && !is_sheet_) return use(R::depolarizer(sample.weight * factor));
      return std::visit(
          [&](const auto& b) {
            return use(b.template weight<R>(point, known, tracing, sample, factor));
          },
          kind_);
    }
  }

  /// The BSDF for unpolarised light, without the cosine, and the densities of sample(); all 0 of
  /// delta distributions. Of a family of radiometry, for its scattering<R>().
  template <class R>
  RENDERER_FLATTEN BsdfValueOf<R> value(const SurfacePoint& point, const Vec3& incident,
                                        const Vec3& exitant) const {
    using Value = BsdfValueOf<R>;
    return std::visit(
        [&]<class B>(const B& b) -> Value {
          if constexpr (B::is_delta)
            return Value();
          else if constexpr (requires { b.template value<Value>(point, incident, exitant); })
            return b.template value<Value>(point, incident, exitant);
          else
            return Value(b.value(point, incident, exitant));
        },
        kind_);
  }

  /// The BSDF, without the cosine, of directions whose value() is known, as the type that its kind
  /// has; nothing of delta distributions. Its m00 is the value's.
  template <class R, class Use>
  MALUS_INLINE decltype(auto) with_scattering(const SurfacePoint& point, const Vec3& incident,
                                              const Vec3& exitant, const BsdfValueOf<R>& value,
                                              Use&& use) const {
    if constexpr (!R::polarized) {
      return use(value.m00);
    } else {
      if (!polarizes_) return use(R::depolarizer(value.m00));
      return std::visit(
          [&]<class B>(const B& b) {
            if constexpr (B::is_delta)
              return use(R::depolarizer(Rgb(0.0f)));
            else
              return use(b.template scattering<R>(point, incident, exitant, value));
          },
          kind_);
    }
  }

  // The same as flagged matrices.

  template <class R>
  typename R::Scattering weight(const SurfacePoint& point, const Vec3& known, Tracing tracing,
                                const BsdfSampleOf<R>& sample) const {
    return with_weight<R>(point, known, tracing, sample, 1,
                          [](const auto& f) -> typename R::Scattering { return as_matrix(f); });
  }
  template <class R>
  typename R::Scattering scattering(const SurfacePoint& point, const Vec3& incident,
                                    const Vec3& exitant, const BsdfValueOf<R>& value) const {
    return with_scattering<R>(point, incident, exitant, value,
                              [](const auto& f) -> typename R::Scattering { return as_matrix(f); });
  }

  /// What a sheet does to light that passes along a direction.
  template <class R>
  typename R::Scattering transmit(const SurfacePoint& point, const Vec3& light) const {
    return std::visit(
        [&]<class B>(const B& b) -> typename R::Scattering {
          if constexpr (is_sheet_kind<B>) {
            if constexpr (R::polarized && B::polarizes)
              if (!polarizes_)
                return R::depolarizer(b.template transmit<malus::Unpolarized<Rgb>>(point, light));
            return b.template transmit<R>(point, light);
          } else
            return R::depolarizer(Rgb(0.0f));
        },
        kind_);
  }

 private:
  Kind kind_;
  bool is_delta_ = false, is_sheet_ = false, is_nothing_ = false, polarizes_ = false;
};

}  // namespace renderer
