// SPDX-License-Identifier: MIT
// A camera path whose scatterings are remembered as they are, and act on light at the end: a
// PathSweep for scatterings that know better than by a matrix what becomes of light. Whatever they
// are made of is found where light comes by, at none else, and once.
//
//   L_k = deposit_k + f_k · G L_{k+1},   result = L_0.
#pragma once

#include <cstddef>
#include <list>
#include <utility>

#include <malus/propagate.hpp>
#include <malus/sum.hpp>

namespace malus {

/// Keep one a thread: begin() keeps its memory, and it cannot be copied. An Event is what a
/// scattering is remembered by: anything that can be assigned to.
///
/// What every frame and order leaves alone, multiples of the identity and what depolarises, is
/// joined to one factor, which is all that a chain of them costs.
template <SpectralValue V, class Event, RuntimeFrameType F = Frame<scalar_t<V>>>
class DeferredSweep {
 public:
  using Light = Stokes<V, exitant, F>;

  DeferredSweep() : vertices_(1) { begin(); }
  DeferredSweep(const DeferredSweep&) = delete;
  DeferredSweep& operator=(const DeferredSweep&) = delete;

  void begin() {
    current_ = lit_ = vertices_.begin();
    scatterings_ = lit_scatterings_ = 0;
    is_lit_ = false;
    current_->deposit_form = StokesForm::zero;
    forget_factor();
  }

  /// Whether more is read of light that leaves the current vertex than its intensity: not where it
  /// is depolarised next.
  bool reads_polarization() const { return reads_polarization_; }

  MALUS_INLINE void deposit(const Light& light) {
    detail::visit_form(light, [&](auto form) MALUS_INLINE_LAMBDA { deposit_as<form()>(light); });
  }
  /// Of a form that is known when this is compiled.
  template <StokesForm Form>
  MALUS_INLINE void deposit(const Stokes<V, exitant, F, Form>& light) {
    deposit_as<Form>(light);
  }

  /// What a scattering at the current vertex would be remembered by. It may be filled in before it
  /// is known whether there is one, and stays where it is until the next path begins.
  MALUS_INLINE Event& event() { return current_->event; }

  /// Light from the next vertex is scattered at the current one, which becomes the one before. The
  /// event is to be filled in.
  MALUS_INLINE Event& scatter() {
    ++scatterings_;
    Vertex& v = *current_;
    v.reads_polarization = reads_polarization_;
    v.is_scaled = is_scaled_;
    if (is_scaled_) v.scale = factor_;
    forget_factor();
    if (++current_ == vertices_.end()) current_ = vertices_.emplace(current_);
    current_->deposit_form = StokesForm::zero;
    return v.event;
  }
  /// The same where nothing is left of it but an intensity.
  MALUS_INLINE void depolarize(const V& m00) {
    ++scatterings_;
    scale(m00);
    reads_polarization_ = false;
  }
  /// What is left of light, whatever its polarisation, on its way to what it has been scattered by
  /// last: of all that is deposited from now on.
  MALUS_INLINE void attenuate(const V& transmittance) { scale(transmittance); }

  /// The scatterings so far, and those of them that result() looks at: none behind the last
  /// deposit.
  std::size_t scatterings() const { return scatterings_; }
  std::size_t evaluated() const { return lit_scatterings_; }
  /// No light has been deposited.
  bool is_dark() const { return !is_lit_; }

  /// The light that leaves the first vertex towards the sensor, in whatever frame it comes.
  /// `act(event, light, reads)` is the light that an event makes of light as it left the vertex
  /// behind; unless its polarisation is read, no more than its intensity need be right.
  template <class Act>
  MALUS_INLINE Light result(Act&& act) const {
    Light light;
    if (!is_lit_) return light;
    add(*lit_, light);
    for (auto k = lit_; k != vertices_.begin();) {
      const Vertex& v = *--k;
      light = act(v.event, std::as_const(light), v.reads_polarization);
      if (!v.reads_polarization && light.form() == StokesForm::full)
        light = Light::unpolarized(light.intensity());
      if (v.is_scaled) light *= v.scale;
      add(v, light);
    }
    return light;
  }

 private:
  /// What leaves towards the vertex before, and what is done to light from the next.
  struct Vertex {
    V deposit[4];
    F frame;
    StokesForm deposit_form;
    bool reads_polarization, is_scaled;
    V scale;  ///< of what the event lets through, if it is
    Event event;

    /// Not defaulted: that would have every value set to zero.
    Vertex() {}  // NOLINT
  };

  void forget_factor() {
    is_scaled_ = false;
    reads_polarization_ = true;
  }
  MALUS_INLINE void scale(const V& by) {
    factor_ = is_scaled_ ? factor_ * by : by;
    is_scaled_ = true;
  }

  template <StokesForm Form, class S>
  MALUS_INLINE void deposit_as(const S& light) {
    if constexpr (Form != StokesForm::zero) {
      const V* from = detail::Access::values(light);
      Vertex& v = *current_;
      is_lit_ = true;
      lit_ = current_;
      lit_scatterings_ = scatterings_;
      const bool is_first = v.deposit_form == StokesForm::zero;
      const V intensity = is_scaled_ ? factor_ * from[0] : from[0];
      v.deposit[0] = is_first ? intensity : v.deposit[0] + intensity;
      if (is_first) v.deposit_form = StokesForm::unpolarized;
      if constexpr (Form == StokesForm::full) {
        if (!reads_polarization_) return;
        V s[3] = {from[1], from[2], from[3]};
        if (is_scaled_)
          for (V& value : s) value *= factor_;
        if (v.deposit_form == StokesForm::full) {
          rotate(rotation(light.frame(), v.frame, "DeferredSweep"), s[0], s[1]);
          for (int i = 0; i < 3; ++i) v.deposit[i + 1] += s[i];
        } else {
          for (int i = 0; i < 3; ++i) v.deposit[i + 1] = s[i];
          v.frame = light.frame();
          v.deposit_form = StokesForm::full;
        }
      }
    }
  }

  /// `light` and what a vertex adds to it.
  MALUS_INLINE static void add(const Vertex& v, Light& light) {
    if (v.deposit_form == StokesForm::zero) return;
    const V intensity = light.form() == StokesForm::zero
                            ? v.deposit[0]
                            : v.deposit[0] + detail::Access::values(light)[0];
    if (v.deposit_form == StokesForm::unpolarized) {
      if (light.form() == StokesForm::full)
        detail::Access::values(light)[0] = intensity;
      else
        light = Light::unpolarized(intensity);
      return;
    }
    if (light.form() != StokesForm::full) {
      // Part by part: as a whole it would be made in one place and copied to another.
      V* s = detail::Access::values(light);
      s[0] = intensity;
      for (int i = 1; i < 4; ++i) s[i] = v.deposit[i];
      detail::Access::frame(light).frame = v.frame;
      detail::Access::flag(light) = detail::FormFlag<StokesForm::dynamic>(StokesForm::full);
      return;
    }
    V* s = detail::Access::values(light);
    V s1 = v.deposit[1], s2 = v.deposit[2];
    rotate(rotation(v.frame, light.frame(), "DeferredSweep"), s1, s2);
    s[0] = intensity;
    s[1] += s1;
    s[2] += s2;
    s[3] += v.deposit[3];
  }

  using Vertices = std::list<Vertex>;
  Vertices vertices_;                          // as many as the longest path had, where they are
  typename Vertices::iterator current_, lit_;  // lit_: the last that light was deposited at, if any
  bool is_lit_ = false;
  std::size_t scatterings_ = 0, lit_scatterings_ = 0;  // so far, and up to the last deposit
  V factor_;                                           // since the current vertex, if it is scaled
  bool is_scaled_ = false;
  bool reads_polarization_ = true;
};

}  // namespace malus
