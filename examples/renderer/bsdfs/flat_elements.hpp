// SPDX-License-Identifier: MIT
// Thin sheets that light passes straight on through: linear polarizer, linear retarder, circular
// polarizer, and nothing at all. A sheet's axis is fixed in it, at an angle to the surface's own x
// axis, from whichever side it is seen.
#pragma once

#include "sample.hpp"

namespace renderer {

/// What all of them share: the light goes on in its direction, whatever the sheet makes of it.
template <class Sheet>
struct StraightThrough {
  static constexpr bool is_delta = true;

  bool sample(const SurfacePoint& point, const Vec3& known, Tracing, Sampler&,
              BsdfSample& result) const {
    result.direction = -known;
    result.is_delta = true;
    result.pdf = result.reverse_pdf = 1;
    result.weight = sheet().template transmit<malus::Unpolarized<Rgb>>(point, known);
    return true;
  }

  template <class R>
  typename R::Scattering weight(const SurfacePoint& point, const Vec3& known, Tracing tracing,
                                const BsdfSample& sample, float factor) const {
    return sheet().template transmit<R>(point, Flow(known, sample.direction, tracing).exitant) *
           factor;
  }

 private:
  const Sheet& sheet() const { return static_cast<const Sheet&>(*this); }
};

/// A direction in the sheet, at an angle from its tangent ∂p/∂u towards n × ∂p/∂u.
inline Vec3 axis_in_sheet(const SurfacePoint& point, float angle) {
  return std::cos(angle) * point.tangent +
         std::sin(angle) * glm::cross(point.normal, point.tangent);
}

struct LinearPolarizer : StraightThrough<LinearPolarizer> {
  /// Radians from ∂p/∂u; a positive angle turns clockwise as seen from the front, as Mitsuba's
  /// polarizer does (and its retarder doesn't).
  float theta = 0;
  Rgb transmittance{1.0f};
  bool polarizing = true;

  static constexpr bool polarizes = true;
  static constexpr bool needs_tangent() { return true; }

  template <class R>
  typename R::Scattering transmit(const SurfacePoint& point, const Vec3& light) const {
    if constexpr (R::polarized) {
      if (!polarizing) return R::plain(0.5f * transmittance);
      // A tilted sheet blocks the field along its projected absorption axis (Korger et al. 2013).
      const Vec3 absorbing = axis_in_sheet(point, pi / 2 - theta);
      const auto across = MuellerFrame::toward(light, absorbing);
      return malus::linear_polarizer(transmittance, MuellerFrame(-across.y(), across.x()));
    } else {
      return 0.5f * transmittance;
    }
  }
};

struct LinearRetarder : StraightThrough<LinearRetarder> {
  float theta = 0;  ///< radians from ∂p/∂u, counter-clockwise as seen from the front: the fast axis
  float delta = pi / 2;  ///< radians at normal incidence
  Rgb transmittance{1.0f};

  static constexpr bool polarizes = true;
  static constexpr bool needs_tangent() { return true; }

  template <class R>
  typename R::Scattering transmit(const SurfacePoint& point, const Vec3& light) const {
    if constexpr (R::polarized) {
      // Off the normal the retardance falls with the cosine, as Mitsuba has it; the fast axis is
      // projected, so that nothing jumps.
      const float phase = delta * std::abs(glm::dot(point.normal, light));
      return malus::linear_retarder(transmittance, Rgb(phase),
                                    MuellerFrame::toward(light, axis_in_sheet(point, theta)));
    } else {
      return transmittance;
    }
  }
};

struct CircularPolarizer : StraightThrough<CircularPolarizer> {
  Rgb transmittance{1.0f};
  malus::Handedness hand = malus::Handedness::right;

  static constexpr bool polarizes = true;

  template <class R>
  typename R::Scattering transmit(const SurfacePoint&, const Vec3& light) const {
    if constexpr (R::polarized)
      return malus::circular_polarizer(transmittance, hand, MuellerFrame::about(light));
    else
      return 0.5f * transmittance;
  }
};

/// An invisible surface, such as the border of a medium.
struct NullSurface : StraightThrough<NullSurface> {
  static constexpr bool polarizes = false;

  template <class R>
  typename R::Scattering transmit(const SurfacePoint&, const Vec3&) const {
    return R::plain(Rgb(1.0f));
  }
};

}  // namespace renderer
