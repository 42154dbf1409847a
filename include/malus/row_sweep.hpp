// SPDX-License-Identifier: MIT
// A camera path that knows which part of the light at its end the sensor would read as intensity.
//
// A path's directions are drawn by m00, as of unpolarised light. Where scattering polarises
// strongly, as Rayleigh's at 90°, what the path really carries can then grow like 2ⁿ with n
// scatterings (García Muñoz & Mills 2015). RowSweep is a PathSweep that carries one row along, the
// Analyzer e0ᵀ f_1 G f_2 G …: four numbers, no matrix. By it, directions and roulette can be drawn
// in proportion to what they contribute.
#pragma once

#include <malus/path_sweep.hpp>
#include <malus/product.hpp>

namespace malus {

template <SpectralValue V, RuntimeFrameType F = Frame<scalar_t<V>>>
class RowSweep {
 public:
  using Light = typename PathSweep<V, F>::Light;
  using Scattering = typename PathSweep<V, F>::Scattering;
  using Transmittance = typename PathSweep<V, F>::Transmittance;
  using Row = Analyzer<V, exitant, F>;

  /// Without the row, all is as in a PathSweep.
  void begin(bool carries_row = true) {
    sweep_.begin();
    row_ = Row::intensity(V(1));
    carries_row_ = carries_row;
  }
  bool reads_polarization() const { return sweep_.reads_polarization(); }
  MALUS_INLINE void deposit(const Light& light) { sweep_.deposit(light); }
  /// Of a form that is known when this is compiled.
  template <StokesForm Form>
  MALUS_INLINE void deposit(const Stokes<V, exitant, F, Form>& light) {
    sweep_.deposit(light);
  }
  MALUS_INLINE void scatter(const Scattering& f) { scatter_by(f); }
  /// Of a form that is known when this is compiled.
  template <MuellerForm Form>
  MALUS_INLINE void scatter(const Mueller<V, incident, exitant, F, F, Form>& f) {
    scatter_by(f);
  }
  void attenuate(const V& transmittance) {
    sweep_.attenuate(transmittance);
    if (carries_row_) row_ *= transmittance;
  }
  void transmit(const Transmittance& t) {
    sweep_.transmit(t);
    // Measured behind the stretch is what was measured in front of it: G* between the two is free
    // space of no length.
    if (carries_row_) row_ = propagate(row_ * detail::retag<Scattering>(t));
  }
  Light result() const { return sweep_.result(); }
  std::size_t scatterings() const { return sweep_.scatterings(); }
  std::size_t evaluated() const { return sweep_.evaluated(); }
  bool is_dark() const { return sweep_.is_dark(); }

  /// The part of unpolarised light at the current vertex that the sensor reads as intensity;
  /// without the row, as if it lost its polarisation at every vertex.
  V throughput() const { return carries_row_ ? row_[0] : sweep_.throughput(); }
  /// What light that leaves the current vertex is read by; e0ᵀ where the row isn't carried.
  const Row& row() const { return row_; }

 private:
  template <class M>
  MALUS_INLINE void scatter_by(const M& f) {
    sweep_.scatter(f);
    if (carries_row_) detail::assign(row_, propagate(row_ * f));
  }

  PathSweep<V, F> sweep_;
  Row row_;
  bool carries_row_ = true;
};

}  // namespace malus
