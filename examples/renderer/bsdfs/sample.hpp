// SPDX-License-Identifier: MIT
// What every BSDF agrees on. Directions point away from the surface, in world space: `incident` to
// where light comes from, `exitant` to where it goes, whichever way a path is traced. Light
// therefore propagates along −incident, then along exitant, and the Mueller matrix of a pair of
// directions is one and the same for paths from the camera and from the light; only the drawing of
// directions knows which of the two is given.
#pragma once

#include <malus/malus.hpp>
#include <type_traits>

#include "../core/sampler.hpp"
#include "../geometry/hit.hpp"
#include "conductor_terms.hpp"

namespace renderer {

/// A path from the camera knows where light goes to and draws where it comes from; a path from the
/// light the reverse.
enum class Tracing { from_camera, from_light };

/// What sampling, roulette and MIS weights need of a pair of directions.
struct BsdfValue {
  Rgb m00{0.0f};           ///< the BSDF for unpolarised light, without the cosine
  float pdf_incident = 0;  ///< by solid angle, of drawing `incident` from the camera
  float pdf_exitant = 0;   ///< by solid angle, of drawing `exitant` from the light
  Rgb lobe{0.0f};          ///< what the BSDF's own scattering() can use again
};

/// A drawn direction. From the camera, weight = m00 |cos|/pdf is the share of unpolarised light
/// that it brings; from the light, the share of power that it carries on.
struct BsdfSample {
  Vec3 direction{};
  Rgb weight{0.0f};
  float pdf = 0;          ///< by solid angle; of delta distributions, the chance of the choice
  float reverse_pdf = 0;  ///< of drawing the known direction by the other tracing, from this one
  float eta = 1;          ///< index on the drawn direction's side over that on the known one's
  bool is_delta = false;
  /// By how much likelier the direction was drawn than pdf says, where a medium knows how what it
  /// scatters is polarised. The scattering is divided by it; the share of what is carried is not.
  float likelihood = 1;
  Rgb lobe{0.0f};  ///< what the BSDF's own weight() can use again
};

/// What a matrix is made of and its m00 is found by, of kinds with interfaces: kept, so that it is
/// not found twice.
struct InterfaceTerms {
  malus::FresnelTerms<float> facet;  ///< of a facet that reflects or refracts
  /// Of refraction into a coat and out of it: the first row of the one, the first column of the
  /// other.
  struct Passage {
    float mean, half_difference;
  } in, out;

  static Passage passage(const malus::FresnelTerms<float>& terms) {
    return {terms.mean(), terms.half_difference()};
  }
};

// Where polarisation is followed, values and samples hold such terms, too: of dielectrics or of
// conductors. Kinds that keep none leave them as they are.

struct PolarizedBsdfValue : BsdfValue {
  union {
    InterfaceTerms terms;
    ConductorTerms conductor;
  };

  PolarizedBsdfValue() {}  // NOLINT: a defaulted one would set the terms to zero
  explicit PolarizedBsdfValue(const BsdfValue& value) : BsdfValue(value) {}
  PolarizedBsdfValue(const BsdfValue& value, const InterfaceTerms& t)
      : BsdfValue(value), terms(t) {}
  PolarizedBsdfValue(const BsdfValue& value, const ConductorTerms& t)
      : BsdfValue(value), conductor(t) {}
};
struct PolarizedBsdfSample : BsdfSample {
  union {
    InterfaceTerms terms;
    ConductorTerms conductor;
  };

  PolarizedBsdfSample() {}  // NOLINT: the same
};

/// By families of radiometry.
template <class R>
using BsdfValueOf = std::conditional_t<R::polarized, PolarizedBsdfValue, BsdfValue>;
template <class R>
using BsdfSampleOf = std::conditional_t<R::polarized, PolarizedBsdfSample, BsdfSample>;

/// A value with terms, if there is room for them.
template <class Value, class Terms>
MALUS_INLINE Value with_terms(const BsdfValue& value, const Terms& terms) {
  if constexpr (std::is_same_v<Value, PolarizedBsdfValue>)
    return {value, terms};
  else
    return value;
}

/// The two directions of a scattering, one known and one drawn, as light has them.
struct Flow {
  Vec3 incident, exitant;
  Flow(const Vec3& known, const Vec3& drawn, Tracing tracing)
      : incident(tracing == Tracing::from_camera ? by_components(drawn) : by_components(known)),
        exitant(tracing == Tracing::from_camera ? by_components(known) : by_components(drawn)) {}
};

using MuellerFrame = malus::Frame<float>;

/// The frames of a specular event at a normal. Axes of any length: rotations need no more.
MALUS_INLINE malus::FramePair<float> specular_frames(const Vec3& normal, const Vec3& incident,
                                                     const Vec3& exitant) {
  const Vec3 s = glm::cross(incident, normal);
  constexpr float normal_incidence = std::numeric_limits<float>::epsilon();
  return malus::frames_with_common_axis<float>(
      -incident, exitant,
      glm::dot(s, s) > normal_incidence ? s : MuellerFrame::about(-incident).x());
}

}  // namespace renderer
