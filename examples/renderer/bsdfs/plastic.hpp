// SPDX-License-Identifier: MIT
// A diffuse base below a smooth dielectric coat: a mirror's reflection and, smooth, the light that
// the base gives back, however often it is reflected between the two. Its front alone reflects.
#pragma once

#include "../core/warp.hpp"
#include "../textures/texture.hpp"
#include "plastic_base.hpp"

namespace renderer {

class Plastic {
 public:
  ColorTexture diffuse_reflectance{Rgb(0.5f)}, specular_reflectance{Rgb(1.0f)};

  static constexpr bool is_delta = false;
  static constexpr bool polarizes = true;

  /// `eta`: inner over outer index. `nonlinear`: reflections within the coat are coloured by the
  /// base each time; else the colour stays what the base's is.
  explicit Plastic(float eta = 1.49f / 1.000277f, bool nonlinear = false)
      : eta_(eta),
        inverse_eta2_(1 / (eta * eta)),
        internal_reflectance_(
            static_cast<float>(diffuse_fresnel_reflectance(1.0 / static_cast<double>(eta)))),
        nonlinear_(nonlinear) {}

  template <class Sample>
  bool sample(const SurfacePoint& point, const Vec3& known, Tracing tracing, Sampler& sampler,
              Sample& result) const {
    const float choice = sampler.next_1d();
    const Vec2 u = sampler.next_2d();
    const float c = glm::dot(point.normal, known);
    if (c <= 0) return false;
    const Rgb coat = specular_reflectance(point), base = diffuse_reflectance(point);
    const auto on_known_side = transmission(c);
    const float reflectance = 1 - on_known_side.mean;
    const float share = coat_share(reflectance, coat, base);
    if (choice < share) {
      result.direction = glm::normalize(reflect_about(known, point.normal));
      result.is_delta = true;
      result.pdf = result.reverse_pdf = share;
      result.weight = coat * (reflectance / share);
      return true;
    }
    const Vec3 d = square_to_cosine_hemisphere(u);
    if (d.z <= 0) return false;
    const Basis basis(point.normal);
    result.direction = glm::normalize(d.x * basis.s + d.y * basis.t + d.z * point.normal);
    const auto on_drawn_side = transmission(d.z);
    const float through = on_drawn_side.mean;
    result.pdf = (1 - share) * d.z / pi;
    result.reverse_pdf = (1 - coat_share(1 - through, coat, base)) * c / pi;
    result.weight = within(base) * (inverse_eta2_ * (1 - reflectance) * through / (1 - share));
    if constexpr (std::is_same_v<Sample, PolarizedBsdfSample>) {
      const bool from_camera = tracing == Tracing::from_camera;
      result.terms.in = from_camera ? on_drawn_side : on_known_side;
      result.terms.out = from_camera ? on_known_side : on_drawn_side;
    }
    return result.pdf > 0;
  }

  /// Of the base: what the coat reflects is a mirror's.
  template <class Value>
  Value value(const SurfacePoint& point, const Vec3& incident, const Vec3& exitant) const {
    const float cos_i = glm::dot(point.normal, incident), cos_o = glm::dot(point.normal, exitant);
    if (cos_i <= 0 || cos_o <= 0) return {};
    const Rgb coat = specular_reflectance(point), base = diffuse_reflectance(point);
    const auto in = transmission(cos_i), out = transmission(cos_o);
    const Rgb scale = within(base) * (inverse_eta2_ / pi);
    return with_terms<Value>(
        {scale * (in.mean * out.mean), (1 - coat_share(1 - out.mean, coat, base)) * cos_i / pi,
         (1 - coat_share(1 - in.mean, coat, base)) * cos_o / pi, scale},
        InterfaceTerms{{}, in, out});
  }

  template <class R>
  MALUS_INLINE auto scattering(const SurfacePoint& point, const Vec3& incident, const Vec3& exitant,
                               const BsdfValueOf<R>& value) const {
    if constexpr (R::polarized)
      return base_matrix(point.normal, incident, exitant, value.terms.in, value.terms.out,
                         value.lobe);
    else
      return value.m00;
  }

  template <class R>
  MALUS_INLINE auto weight(const SurfacePoint& point, const Vec3& known, Tracing tracing,
                           const BsdfSampleOf<R>& sample, float factor) const {
    if constexpr (R::polarized) {
      const Flow flow(known, sample.direction, tracing);
      if (sample.is_delta) {
        const auto terms = malus::fresnel_dielectric(cosine(glm::dot(point.normal, known)), eta_);
        const auto frames = specular_frames(point.normal, flow.incident, flow.exitant);
        return malus::fresnel_block<Rgb>(terms, frames.enter, frames.exit) *
               (specular_reflectance(point) * (factor / sample.pdf));
      }
      const auto& [facet, in, out] = sample.terms;
      const float unpolarized = in.mean * out.mean;
      return base_matrix(point.normal, flow.incident, flow.exitant, in, out,
                         unpolarized > 0 ? sample.weight * (factor / unpolarized) : Rgb(0.0f));
    } else {
      return sample.weight * factor;
    }
  }

 private:
  static float cosine(float c) { return std::min(c, 1.0f); }
  InterfaceTerms::Passage transmission(float c) const {
    return InterfaceTerms::passage(malus::fresnel_transmission(cosine(c), eta_));
  }
  /// The base's reflectance, by way of any number of reflections at the coat's inside.
  Rgb within(const Rgb& base) const {
    return base / (Rgb(1.0f) - (nonlinear_ ? base : Rgb(1.0f)) * internal_reflectance_);
  }

  float eta_, inverse_eta2_;
  float internal_reflectance_;
  bool nonlinear_;
};

}  // namespace renderer
