// SPDX-License-Identifier: MIT
// What a path from the sensor carries through media that polarise what they scatter: the row
// e0ᵀ f_1 G f_2 G … that intensity is read by, four numbers, since the path was last at a surface.
// By it directions are drawn there, and roulette goes.
//
// A surface begins a new row. What polarisation it gives the path is not drawn by, which costs
// little where the next scattering in a medium is one of many, and lets surfaces wait for light as
// they do without media.
#pragma once

#include <malus/radiometry.hpp>

#include "scatterer.hpp"

namespace renderer {

class CarriedRow {
  using Family = malus::Polarized<Rgb>;

 public:
  void begin() { row_ = Row::intensity(Rgb(1.0f)); }

  MALUS_INLINE void scatter(const SurfacePoint& point, const Vec3& exitant,
                            const Scatterer<WithMedia>& scatterer,
                            const BsdfSampleOf<Family>& sample, float factor) {
    if (!scatterer.is_medium() || !scatterer.polarizes()) return pass(sample.weight * factor);
    scatterer.with_phase_weight<Family>(point, exitant, Tracing::from_camera, sample, factor,
                                        [&](const auto& f) MALUS_INLINE_LAMBDA {
                                          malus::detail::assign(row_, malus::propagate(row_ * f));
                                        });
  }
  /// At a surface, or where light is depolarised.
  void pass(const Rgb& m00) { row_ = Row::intensity(row_[0] * m00); }
  void attenuate(const Rgb& transmittance) { row_ *= transmittance; }
  /// Measured behind a stretch is what was measured in front of it: G* between the two is free
  /// space of no length.
  void transmit(const Family::Transmittance& t) {
    row_ = malus::propagate(row_ * malus::detail::retag<Family::Scattering>(t));
  }

  /// The part of unpolarised light at the current vertex that the sensor reads as intensity.
  Rgb throughput() const { return row_[0]; }
  LinearPolarization polarization() const { return LinearPolarization(row_); }

 private:
  using Row = malus::Analyzer<Rgb, malus::exitant>;
  Row row_;
};

}  // namespace renderer
