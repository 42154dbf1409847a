// SPDX-License-Identifier: MIT
// The two families that an integrator is templated on: what light, scattering and a camera path are
// when polarisation is followed, and when it is not. One source serves both; what a family doesn't
// need, it doesn't compute.
#pragma once

#include <malus/measurement.hpp>
#include <malus/path_sweep.hpp>

namespace malus {

/// Intensities alone: light, scattering and readings are values. Renders what the m00 components
/// give.
template <SpectralValue V>
struct Unpolarized {
  using Value = V;
  using Light = V;                ///< exitant radiance
  using Scattering = V;           ///< BSDF or phase function value
  using Transmittance = V;        ///< what a stretch of medium leaves of light
  using Importance = V;           ///< what a sensor weighs incident radiance by
  using CameraPath = PathSum<V>;  ///< deposits and scatterings of a path, and their result
  static constexpr bool polarized = false;
  static constexpr bool defers = false;  ///< matrices are made when light is found behind them

  static Light unpolarized(const V& radiance) { return radiance; }
  static Scattering depolarizer(const V& m00) { return m00; }
  static Scattering plain(const V& a) { return a; }
  /// f acts on light that reached its vertex.
  static Light scatter(const Scattering& f, const Light& light) { return f * light; }
  static const V& intensity(const Light& light) { return light; }
  /// Light on its way, behind a stretch of medium.
  static Light transmit(const Transmittance& t, const Light& light) { return t * light; }
  static const V& m00(const Scattering& f) { return f; }
  /// The importance that a sensor whose image axes are `frame` emits.
  static Importance importance(const V& w, const Frame<scalar_t<V>>&) { return w; }
  /// What a sensor reads of light that is on its way to it.
  static Measurement<V> measure(const Importance& w, const Light& light) {
    return {w * light, V(0), V(0), V(0)};
  }
};

/// Stokes vectors and Mueller matrices with their frames.
template <SpectralValue V>
struct Polarized {
  using Value = V;
  using frame = Frame<scalar_t<V>>;
  using Light = Stokes<V, exitant>;
  using Scattering = Mueller<V, incident, exitant>;
  /// Of a form that is known when it is compiled.
  template <MuellerForm Form>
  using ScatteringAs = Mueller<V, incident, exitant, frame, frame, Form>;
  using Transmittance = Mueller<V, exitant, incident>;
  using Importance = malus::Importance<V, incident, frame, ImportanceForm::plain>;
  using CameraPath = PathSweep<V>;
  static constexpr bool polarized = true;
  static constexpr bool defers = true;

  static Light unpolarized(const V& radiance) { return Light::unpolarized(radiance); }
  static auto depolarizer(const V& m00) { return DepolarizingMueller<V>::depolarizing(m00); }
  static Scattering plain(const V& a) { return Scattering::plain(a); }
  static bool is_unpolarized(const Light& light) { return light.form() != StokesForm::full; }
  static V intensity(const Light& light) { return light.intensity(); }
  /// f acts on light that reached its vertex. Where the form of f is a type, of unpolarised light
  /// its first column alone is made, and its first row where no polarisation is read.
  template <MuellerForm Form>
  MALUS_INLINE static Light scatter(const ScatteringAs<Form>& f, const Light& light,
                                    bool reads_polarization = true) {
    if constexpr (Form == MuellerForm::dynamic) {
      return f * propagate(light);
    } else {
      return detail::with_form(light.form(), [&](auto form) MALUS_INLINE_LAMBDA {
        const auto result = f * detail::retag_known<Stokes<V, incident, frame, form()>>(light);
        return reads_polarization ? Light(result) : Light::unpolarized(result.intensity());
      });
    }
  }
  /// The same of what isn't a matrix but multiplies light of a form that is a type as one does.
  template <class F>
    requires(!MuellerType<F>)
  MALUS_INLINE static Light scatter(const F& f, const Light& light,
                                    bool reads_polarization = true) {
    return detail::with_form(light.form(), [&](auto form) MALUS_INLINE_LAMBDA {
      const auto result = f * detail::retag_known<Stokes<V, incident, frame, form()>>(light);
      return reads_polarization ? Light(result) : Light::unpolarized(result.intensity());
    });
  }
  /// The same of unpolarised light: the first column alone, with its form as a type if f has it so.
  template <class F>
  MALUS_INLINE static auto scatter_unpolarized(const F& f, const V& intensity) {
    return f * Stokes<V, incident, frame, StokesForm::unpolarized>::unpolarized(intensity);
  }
  /// The end of a stretch is no vertex: what leaves it is still on its way.
  static Light transmit(const Transmittance& t, const Light& light) {
    return detail::retag<Light>(propagate(light, t));
  }
  static V m00(const Scattering& f) { return f.m00(); }
  /// W_e = [w Id, F_v]: the four Stokes components in the sensor's frame, times w.
  static Importance importance(const V& w, const Frame<scalar_t<V>>& frame) {
    return Importance::plain(w, frame);
  }
  /// The paper's measurement equation (2), for one path.
  static Measurement<V> measure(const Importance& w, const Light& light) {
    return w * propagate(light);
  }
};

}  // namespace malus
