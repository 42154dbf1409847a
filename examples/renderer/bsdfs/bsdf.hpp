// SPDX-License-Identifier: MIT
// Any BSDF, and the material of a shape: which BSDF each of its sides has.
#pragma once

#include <concepts>
#include <variant>

#include "conductor.hpp"
#include "dielectric.hpp"
#include "diffuse.hpp"
#include "flat_elements.hpp"

namespace renderer {

template <class B>
inline constexpr bool is_sheet_kind = std::derived_from<B, StraightThrough<B>>;

class Bsdf {
 public:
  using Kind = std::variant<Diffuse, Conductor, Dielectric, LinearPolarizer, LinearRetarder,
                            CircularPolarizer, NullSurface>;

  Bsdf(Kind kind) : kind_(std::move(kind)) {  // NOLINT: any kind is a BSDF
    std::visit(
        [this]<class B>(const B&) {
          is_delta_ = B::is_delta;
          polarizes_ = B::polarizes;
          is_sheet_ = is_sheet_kind<B>;
        },
        kind_);
  }

  const Kind& kind() const { return kind_; }
  /// Scatters into discrete directions alone: nothing connects to it.
  bool is_delta() const { return is_delta_; }
  /// Light passes straight on: shadow rays go through.
  bool is_sheet() const { return is_sheet_; }
  /// Can make polarised light of unpolarised light, or change polarised light but by a factor.
  bool polarizes() const { return polarizes_; }

  /// Draws an incident direction by m00; false where no light is scattered to `exitant`.
  bool sample(const Hit& hit, const Vec3& exitant, Sampler& sampler, BsdfSample& result) const {
    return std::visit([&](const auto& b) { return b.sample(hit, exitant, sampler, result); },
                      kind_);
  }

  /// The scattering of a sample, times |cos|/pdf. Its m00 is the sample's weight.
  template <class R>
  typename R::Scattering weight(const Hit& hit, const Vec3& exitant,
                                const BsdfSample& sample) const {
    return std::visit([&](const auto& b) { return b.template weight<R>(hit, exitant, sample); },
                      kind_);
  }

  /// The value for unpolarised light, without the cosine; 0 of delta distributions.
  Rgb m00(const Hit& hit, const Vec3& incident, const Vec3& exitant) const {
    return std::visit(
        [&]<class B>(const B& b) {
          if constexpr (B::is_delta)
            return Rgb(0.0f);
          else
            return b.m00(hit, incident, exitant);
        },
        kind_);
  }

  /// The BSDF, without the cosine; nothing of delta distributions.
  template <class R>
  typename R::Scattering evaluate(const Hit& hit, const Vec3& incident, const Vec3& exitant) const {
    return std::visit(
        [&]<class B>(const B& b) -> typename R::Scattering {
          if constexpr (B::is_delta)
            return R::depolarizer(Rgb(0.0f));
          else
            return b.template evaluate<R>(hit, incident, exitant);
        },
        kind_);
  }

  /// The density of sample(), by solid angle; 0 of delta distributions.
  float pdf(const Hit& hit, const Vec3& incident, const Vec3& exitant) const {
    return std::visit(
        [&]<class B>(const B& b) {
          if constexpr (B::is_delta)
            return 0.0f;
          else
            return b.pdf(hit, incident, exitant);
        },
        kind_);
  }

  /// What a sheet does to light that passes along a direction.
  template <class R>
  typename R::Scattering transmit(const Hit& hit, const Vec3& light) const {
    return std::visit(
        [&]<class B>(const B& b) -> typename R::Scattering {
          if constexpr (is_sheet_kind<B>)
            return b.template transmit<R>(hit, light);
          else
            return R::depolarizer(Rgb(0.0f));
        },
        kind_);
  }

 private:
  Kind kind_;
  bool is_delta_ = false, is_sheet_ = false, polarizes_ = false;
};

/// The BSDFs of a shape's sides. `back` is none for one BSDF that knows both sides itself; else it
/// sees the surface flipped, as its own front.
struct Material {
  const Bsdf* front = nullptr;
  const Bsdf* back = nullptr;

  /// The BSDF that light leaving to `exitant` has met; flips the hit where that is the back.
  const Bsdf& facing(Hit& hit, const Vec3& exitant) const {
    if (!back || glm::dot(hit.normal, exitant) >= 0) return *front;
    hit.flip();
    return *back;
  }
};

}  // namespace renderer
