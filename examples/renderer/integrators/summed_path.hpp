// SPDX-License-Identifier: MIT
// A path from the sensor as its family's own sum has it: of intensities, or of matrices.
#pragma once

#include <malus/radiometry.hpp>

#include "scatterer.hpp"

namespace renderer {

/// Keep one a thread.
template <class R, class M, class Sum>
class SummedPath {
 public:
  explicit SummedPath(Counters& counters) : counters_(counters) {}

  void begin() { sum_.begin(); }

  /// Where a walk is to put what it finds and draws at the current vertex: in its own places, since
  /// nothing of it is remembered.
  static Hit& place(Hit& of_walk) { return of_walk; }
  static BsdfSampleOf<R>& place(BsdfSampleOf<R>& of_walk) { return of_walk; }

  MALUS_INLINE void scatter(const Hit& point, const Vec3& exitant, const Scatterer<M>& scatterer,
                            const BsdfSampleOf<R>& sample, float factor) {
    if constexpr (!R::polarized)
      sum_.scatter(sample.weight * factor);
    else
      scatterer.template with_weight<R>(point, exitant, Tracing::from_camera, sample, factor,
                                        [&](const auto& f) MALUS_INLINE_LAMBDA {
                                          counters_.count(f);
                                          sum_.scatter(as_matrix(f));
                                        });
  }
  void pass(const typename R::Scattering& sheet) { sum_.scatter(sheet); }
  void attenuate(const Rgb& transmittance) { sum_.attenuate(transmittance); }
  template <class Transmittance>
  void transmit(const Transmittance& t) {
    sum_.transmit(t);
  }
  MALUS_INLINE void deposit(const typename R::Light& light) { sum_.deposit(light); }
  MALUS_INLINE void deposit(const SurfacePoint& point, const Vec3& incident, const Vec3& exitant,
                            const Scatterer<M>& scatterer, const BsdfValueOf<R>& value,
                            const typename R::Light& light) {
    deposit_scattered<R>(sum_, point, incident, exitant, scatterer, value, light);
  }
  bool reads_polarization() const { return sum_.reads_polarization(); }
  Rgb throughput() const { return sum_.throughput(); }
  auto result() const { return sum_.result(); }

 private:
  Counters& counters_;
  Sum sum_;
};

}  // namespace renderer
