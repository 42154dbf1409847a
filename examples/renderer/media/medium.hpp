// SPDX-License-Identifier: MIT
// A participating medium: what it takes from light on its way, what it scatters, and what it emits.
// Coefficients are by unit of length. Where the density varies, extinction, scattering and emission
// vary with it. Light may be extinguished by its polarisation; then what is left of it is a Mueller
// matrix, and all values here are those of unpolarised light.
//
// A path's distances are drawn so that no channel's share can grow (Wilkie et al. 2014; Miller et
// al. 2019): of each channel's distribution by its part in what the path carries, as one mixture.
#pragma once

#include <malus/malus.hpp>
#include <memory>
#include <optional>

#include "density_grid.hpp"
#include "phase_function.hpp"

namespace renderer {

/// How a path has fared in a medium: it is scattered at a distance, or passes.
struct Flight {
  bool is_scattered = false;
  float distance = 0;  ///< flown
  Rgb weight{1.0f};  ///< transmittance over the density (the chance, of what passes) of the outcome
  /// The transmittance as MIS weights know it: a function of the two ends alone.
  Rgb transmittance{1.0f};
};

class Medium {
 public:
  struct Description {
    Rgb extinction{1.0f};  ///< σ_t; of the ordinary wave, where polarisation matters
    Rgb albedo{0.75f};     ///< σ_s/σ_t
    Rgb emission{0.0f};    ///< radiance by length
    PhaseFunction phase;
    /// Extinction by polarisation; its `extinction` is the one above. Not together with a density.
    std::optional<malus::UniaxialExtinction<Rgb>> polarizing;
    std::shared_ptr<const DensityGrid> density;      ///< factor of extinction and emission
    std::shared_ptr<const DensityGrid> albedo_grid;  ///< instead of `albedo`
  };
  explicit Medium(Description description);

  const PhaseFunction& phase() const { return d_.phase; }
  bool scatters() const { return scatters_; }
  bool emits() const { return emits_; }
  bool is_homogeneous() const { return !d_.density; }
  /// What is left of light depends on its polarisation.
  bool extinguishes_by_polarization() const { return d_.polarizing.has_value(); }
  /// Takes more of one polarisation than of another; else it turns and retards at most.
  bool is_dichroic() const {
    const auto has_any = [](const Rgb& d) { return d[0] != 0 || d[1] != 0 || d[2] != 0; };
    return d_.polarizing &&
           (has_any(d_.polarizing->linear_dichroism) || has_any(d_.polarizing->circular_dichroism));
  }
  /// Can make polarised light of unpolarised light, or change polarised light but by a factor.
  bool polarizes() const {
    return extinguishes_by_polarization() || (scatters_ && d_.phase.polarizes());
  }

  /// For light that arrives unpolarised, and of which the intensity alone counts afterwards.
  void depolarize_what_is_scattered() { d_.phase = d_.phase.as_depolarizer(); }

  Rgb extinction(const Vec3& point) const {
    return d_.density ? d_.extinction * (*d_.density)(point) : d_.extinction;
  }
  /// Radiance by length.
  Rgb emission(const Vec3& point) const {
    return d_.density ? d_.emission * (*d_.density)(point) : d_.emission;
  }
  Rgb scattering(const Vec3& point) const {
    if (!d_.density) return scattering_;
    return extinction(point) * (d_.albedo_grid ? (*d_.albedo_grid)(point) : d_.albedo);
  }

  /// Draws how far a path that carries `throughput` gets along a ray of unit direction, on which
  /// there is `length` of the medium.
  Flight fly(const Ray& ray, float length, const Rgb& throughput, Sampler& sampler) const;

  /// What is left of unpolarised light after a stretch, or an unbiased estimate of it.
  Rgb transmittance(const Ray& ray, float length, Sampler& sampler) const;
  /// The same as MIS weights know it.
  Rgb expected_transmittance(const Ray& ray, float length) const;
  /// What is left of light that propagates in a direction through a stretch of a homogeneous medium
  /// that extinguishes by polarisation.
  template <class R>
  typename R::Transmittance polarized_transmittance(const Vec3& light, float length) const {
    if constexpr (R::polarized)
      return d_.polarizing->transmittance(light, length);
    else
      return d_.polarizing->unpolarized_transmittance(light, length);
  }

  /// The medium's own light from a stretch of a ray, as it arrives at the ray's origin.
  template <class R>
  typename R::Light emitted(const Ray& ray, float length, Sampler& sampler) const {
    if (!extinguishes_by_polarization())
      return R::unpolarized(emitted_radiance(ray, length, sampler));
    const auto [distance, inverse_pdf] = sample_stretch(ray.direction, length, sampler);
    return R::transmit(polarized_transmittance<R>(-ray.direction, distance),
                       R::unpolarized(d_.emission * inverse_pdf));
  }

 private:
  struct Stretch {
    float distance, inverse_pdf;
  };

  Flight fly_by_rates(const Ray& ray, float length, const Rgb& throughput, Sampler& sampler) const;
  Flight track(const Ray& ray, float length, const Rgb& throughput, Sampler& sampler) const;
  Rgb track_transmittance(const Ray& ray, float length, Sampler& sampler, Rgb* emitted) const;
  Rgb emitted_radiance(const Ray& ray, float length, Sampler& sampler) const;
  Stretch sample_stretch(const Vec3& direction, float length, Sampler& sampler) const;

  Description d_;
  Rgb scattering_{0.0f};
  float majorant_ = 0;  // of extinction, where the density varies
  bool scatters_ = false, emits_ = false, is_grey_ = false;
};

}  // namespace renderer
