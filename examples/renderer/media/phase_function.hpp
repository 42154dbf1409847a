// SPDX-License-Identifier: MIT
// Any phase function. It is a medium's BSDF and speaks of directions as those do
// (bsdfs/sample.hpp): `incident` to where light comes from, `exitant` to where it goes. What is
// scattered depends on the angle between the directions of propagation alone, so that both tracings
// draw by the same density.
#pragma once

#include <malus/optics/scattering_matrix.hpp>
#include <memory>
#include <variant>

#include "../bsdfs/sample.hpp"
#include "henyey_greenstein_phase.hpp"
#include "isotropic_phase.hpp"
#include "linear_polarization.hpp"
#include "rayleigh_phase.hpp"
#include "tabulated_phase.hpp"

namespace renderer {

class PhaseFunction {
 public:
  using Kind = std::variant<IsotropicPhase, HenyeyGreensteinPhase, RayleighPhase,
                            std::shared_ptr<const TabulatedPhase>>;

 private:
  template <class F>
  decltype(auto) visit(F&& f) const {
    return std::visit(
        [&]<class P>(const P& p) -> decltype(auto) {
          if constexpr (std::is_same_v<P, std::shared_ptr<const TabulatedPhase>>)
            return f(*p);
          else
            return f(p);
        },
        kind_);
  }

 public:
  PhaseFunction(Kind kind = IsotropicPhase{}) : kind_(std::move(kind)) {  // NOLINT: any kind is one
    visit([this]<class P>(const P&) { polarizes_ = P::polarizes; });
  }

  /// Can make polarised light of unpolarised light.
  bool polarizes() const { return polarizes_; }
  /// The same for unpolarised light, of which nothing but the intensity counts afterwards.
  PhaseFunction as_depolarizer() const {
    PhaseFunction result(*this);
    result.polarizes_ = false;
    return result;
  }

  /// p(cos Θ), by solid angle: its mean over the sphere is 1/4π. The densities are sample()'s.
  BsdfValue value(const Vec3& incident, const Vec3& exitant) const {
    const float cosine = deflection(incident, exitant);
    BsdfValue result;
    visit([&](const auto& p) {
      result.m00 = p.value(cosine);
      result.pdf_incident = result.pdf_exitant = p.pdf(cosine);
    });
    return result;
  }

  /// Draws the direction that isn't known: the angle by m00, and the plane of scattering by how
  /// what is scattered is polarised.
  void sample(const Vec3& known, const LinearPolarization& polarization, Sampler& sampler,
              BsdfSample& result) const {
    const Vec2 u = sampler.next_2d();
    const Basis basis(known);
    const float azimuth = 2 * pi * u.y, c = std::cos(azimuth), s = std::sin(azimuth);
    Vec3 across = c * basis.s + s * basis.t;
    result.likelihood = 1;
    visit([&]<class P>(const P& p) {
      const float cosine = p.sample(u.x), sine = std::sqrt(std::max(0.0f, 1 - cosine * cosine));
      result.pdf = result.reverse_pdf = p.pdf(cosine);
      result.weight = p.value(cosine) * (1 / result.pdf);
      if constexpr (P::polarizes) {
        // S0 after scattering is a1 + b1 S1/S0. Planes at right angles share their chance as they
        // share that: of the two, one is drawn.
        if (!polarization.is_none) {
          const auto e = p.elements(cosine);
          const float excess =
              polarization.along(across) *
              std::clamp((e.b1[0] + e.b1[1] + e.b1[2]) / (e.a1[0] + e.a1[1] + e.a1[2]), -1.0f,
                         1.0f);
          const bool stays = sampler.next_1d() < 0.5f * (1 + excess);
          if (!stays) across = c * basis.t - s * basis.s;
          result.likelihood = stays ? 1 + excess : 1 - excess;
        }
      }
      result.direction = normalized(cosine * -known + sine * across);
    });
    result.is_delta = false;
    result.eta = 1;
  }

  /// The phase matrix, of a kind that polarises, times a scale, as the type that it has.
  template <class R, class Use>
  MALUS_INLINE decltype(auto) with_matrix(const Vec3& incident, const Vec3& exitant,
                                          const Rgb& scale, Use&& use) const {
    return visit([&]<class P>(const P& p) {
      if constexpr (P::polarizes)
        return use(
            malus::scattering_matrix(p.elements(deflection(incident, exitant)),
                                     malus::frames_of_scattering<float>(-incident, exitant)) *
            scale);
      else
        return use(R::depolarizer(p.value(deflection(incident, exitant)) * scale));
    });
  }

 private:
  /// The cosine between the directions of propagation before and after.
  static float deflection(const Vec3& incident, const Vec3& exitant) {
    return std::clamp(-glm::dot(incident, exitant), -1.0f, 1.0f);
  }

  Kind kind_;
  bool polarizes_ = false;
};

}  // namespace renderer
