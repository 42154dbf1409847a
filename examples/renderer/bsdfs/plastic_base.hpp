// SPDX-License-Identifier: MIT
// The diffuse base of plastics below its dielectric coat, as seen through it. Light is refracted
// into the coat, loses all polarisation at the base, and is refracted out: T_out · D · T_in. The
// light that leaves is polarised, along the plane of emission.
#pragma once

#include <concepts>

#include "sample.hpp"

namespace renderer {

/// ∫ F(cos) 2cos dcos, of light that comes diffuse from all directions to an interface of relative
/// index eta; by the trapezium rule, to 1e-5.
inline double diffuse_fresnel_reflectance(double eta) {
  // From the denser side by n² (1 − F) being the same from both.
  if (eta < 1) return 1 - eta * eta * (1 - diffuse_fresnel_reflectance(1 / eta));
  constexpr int steps = 1024;
  double sum = 0.5 * malus::fresnel_dielectric(1.0, eta).mean();
  for (int i = 1; i < steps; ++i) {
    const double cosine = static_cast<double>(i) / steps;
    sum += malus::fresnel_dielectric(cosine, eta).mean() * cosine;
  }
  return 2 * sum / steps;
}

/// The share of draws that a plastic spends on its coat: the coat's part of what it reflects.
inline float coat_share(float reflectance, const Rgb& coat, const Rgb& base) {
  const float c = reflectance * malus::mean_channel(coat);
  const float b = (1 - reflectance) * malus::mean_channel(base);
  return c + b > 0 ? c / (c + b) : 0.0f;
}

/// The frame of light at a surface with x = s, perpendicular to the plane of incidence, of any
/// length.
inline MuellerFrame frame_of_incidence(const Vec3& normal, const Vec3& propagation) {
  const Vec3 s = glm::cross(normal, propagation);
  if (glm::dot(s, s) > std::numeric_limits<float>::epsilon())
    return MuellerFrame::from_direction_and_x(propagation, s);
  return MuellerFrame::about(propagation);
}

/// T_out · D · T_in, D = diag(base, 0, 0, 0): the outer product of the first column of T_out and
/// the first row of T_in.
inline auto base_matrix(const Vec3& normal, const Vec3& incident, const Vec3& exitant,
                        const InterfaceTerms::Passage& in, const InterfaceTerms::Passage& out,
                        const Rgb& base) {
  const auto [in_0, in_1] = in;
  const auto [out_0, out_1] = out;
  const Rgb none(0.0f);
  return malus::BlockMueller<Rgb, malus::incident, malus::exitant, MuellerFrame>::block(
      {base * (out_0 * in_0), base * (out_0 * in_1), base * (out_1 * in_0), base * (out_1 * in_1)},
      {none, none, none, none}, frame_of_incidence(normal, -incident),
      frame_of_incidence(normal, exitant));
}

/// The same two vectors in the frames of a facet: (T_out)ᵢ0 and (T_in)0ⱼ, i, j < 3; the fourth
/// components are 0. At normal incidence, where there is no plane of incidence, nothing is
/// polarised.
struct BasePolarization {
  float column[3], row[3];

  MALUS_INLINE BasePolarization(const Vec3& normal, const Vec3& incident, const Vec3& exitant,
                                const InterfaceTerms::Passage& in,
                                const InterfaceTerms::Passage& out) {
    // The facet's x is o × i on both sides, the base's is i × n and n × o. The angles between them
    // need no axes: (o × i)·(i × n) = (i·n)(i·o) − n·o, (n × o)·(o × i) = (i·o)(n·o) − i·n, and the
    // sines are the volume of the three directions, n·(i × o), with opposite signs.
    const float volume = glm::dot(glm::cross(incident, exitant), normal);
    const float between = glm::dot(incident, exitant);
    const float cos_i = glm::dot(incident, normal), cos_o = glm::dot(exitant, normal);
    const auto enter = malus::rotation_by(between * cos_i - cos_o, volume);
    const auto exit = malus::rotation_by(between * cos_o - cos_i, -volume);
    row[0] = in.mean;
    row[1] = enter.cos2 * in.half_difference, row[2] = enter.sin2 * in.half_difference;
    column[0] = out.mean;
    column[1] = exit.cos2 * out.half_difference, column[2] = -exit.sin2 * out.half_difference;
  }
};

using PlasticMueller = malus::FullMueller<Rgb, malus::incident, malus::exitant, MuellerFrame>;

/// A facet's block, times `coat`, over a base, in the facet's frames: what a full matrix is made
/// of. Light that it is applied to needs no matrix: a base is a row and a column.
struct CoatOverBase {
  malus::FresnelTerms<float> terms;
  Rgb coat;
  malus::FramePair<float> facet;
  BasePolarization polarization;
  Rgb base;

  static constexpr malus::MuellerForm form() { return malus::MuellerForm::full; }

  MALUS_INLINE operator PlasticMueller() const {
    const auto& [o, i] = polarization;
    const Rgb sum = coat * terms.mean(), difference = coat * terms.half_difference();
    const Rgb re = coat * terms.re, im = coat * terms.im, none(0.0f);
    const Rgb b0 = base * o[0], b1 = base * o[1], b2 = base * o[2];
    return PlasticMueller::from_rows({{{sum + b0 * i[0], difference + b0 * i[1], b0 * i[2], none},
                                       {difference + b1 * i[0], sum + b1 * i[1], b1 * i[2], none},
                                       {b2 * i[0], b2 * i[1], re + b2 * i[2], im},
                                       {none, none, -im, re}}},
                                     facet.enter, facet.exit);
  }

  /// The matrix times light.
  template <malus::StokesForm Form>
  MALUS_INLINE friend auto operator*(
      const CoatOverBase& m, const malus::Stokes<Rgb, malus::incident, MuellerFrame, Form>& light) {
    using Result = malus::Stokes<Rgb, malus::exitant, MuellerFrame, malus::StokesForm::full>;
    const auto& [o, i] = m.polarization;
    const malus::FresnelTerms<float>& f = m.terms;
    const Rgb s0 = light.intensity();
    if constexpr (Form != malus::StokesForm::full) {
      const Rgb specular = m.coat * s0, diffuse = m.base * s0 * i[0];
      return Result(specular * f.mean() + diffuse * o[0],
                    specular * f.half_difference() + diffuse * o[1], diffuse * o[2], Rgb(0.0f),
                    m.facet.exit);
    } else {
      Rgb s1 = light[1], s2 = light[2];
      rotate(rotation(light.frame(), m.facet.enter, "CoatOverBase * Stokes"), s1, s2);
      const Rgb s3 = light[3];
      const Rgb diffuse = m.base * (i[0] * s0 + i[1] * s1 + i[2] * s2);
      return Result(m.coat * (f.mean() * s0 + f.half_difference() * s1) + diffuse * o[0],
                    m.coat * (f.half_difference() * s0 + f.mean() * s1) + diffuse * o[1],
                    m.coat * (f.re * s2 + f.im * s3) + diffuse * o[2],
                    m.coat * (f.re * s3 - f.im * s2), m.facet.exit);
    }
  }
};

/// A matrix, whatever a BSDF has for it.
template <class F>
MALUS_INLINE decltype(auto) as_matrix(const F& f) {
  if constexpr (std::same_as<F, CoatOverBase>)
    return PlasticMueller(f);
  else
    return (f);
}

}  // namespace renderer
