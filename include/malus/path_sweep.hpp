// SPDX-License-Identifier: MIT
// What a camera path adds up to, as two models of one concept. An integrator that walks from the
// sensor says at each vertex what light leaves it towards the vertex before (deposit), and how
// light is scattered there on its way from the next (scatter); and, where that way is not free
// space, what it does to the light (attenuate, transmit):
//
//   L_k = deposit_k + f_k · G T_k L_{k+1},   result = T L_0.
//
// PathSweep evaluates this for polarised light from the far end, by one matrix–vector product a
// vertex: no importance matrix is carried and no two matrices are ever multiplied, and a tail of
// the path that carries no light costs nothing. PathSum is the same for intensities, where the
// order does not matter and a running throughput does.
#pragma once

#include <concepts>
#include <cstddef>
#include <vector>

#include <malus/propagate.hpp>
#include <malus/sum.hpp>

namespace malus {

/// A camera path of unpolarised light.
template <SpectralValue V>
class PathSum {
 public:
  using Light = V;
  using Scattering = V;
  using Transmittance = V;

  void begin() {
    throughput_ = V(1);
    light_ = V(0);
  }
  /// Light that leaves the current vertex towards the one before.
  void deposit(const V& light) { light_ += throughput_ * light; }
  /// Light from the next vertex is scattered at the current one by f, which becomes the one before.
  void scatter(const V& f) { throughput_ *= f; }
  /// What is left of light, whatever its polarisation, on its way to what it has been scattered by
  /// last: of all that is deposited from now on.
  void attenuate(const V& transmittance) { throughput_ *= transmittance; }
  /// The same where it depends on polarisation.
  void transmit(const V& transmittance) { throughput_ *= transmittance; }
  /// Intensities are all there is.
  static constexpr bool reads_polarization() { return false; }
  /// The part of unpolarised light at the current vertex that reaches the first.
  const V& throughput() const { return throughput_; }
  /// The light that leaves the first vertex towards the sensor.
  const V& result() const { return light_; }

 private:
  V throughput_ = V(1), light_ = V(0);
};

/// A camera path of polarised light. Keep one a thread: begin() keeps its memory.
///
/// Everything is turned on the way out into the frame that the matrix before it expects light in,
/// where that overlaps with the tracing of rays, and what is kept is two numbers a vertex instead
/// of frames. Where that matrix reads the intensity alone, no more than the intensity is kept: a
/// vertex that depolarises is joined with the next, and a chain of them is a PathSum.
template <SpectralValue V, RuntimeFrameType F = Frame<scalar_t<V>>>
class PathSweep {
 public:
  using Light = Stokes<V, exitant, F>;
  using Scattering = Mueller<V, incident, exitant, F>;
  using Transmittance = Mueller<V, exitant, incident, F>;

  PathSweep() { begin(); }

  void begin() {
    vertices_.clear();
    vertices_.emplace_back();
    lit_ = scatterings_ = lit_scatterings_ = 0;
    throughput_ = chain_ = V(1);
    reads_polarization_ = true;
    has_entry_ = false;
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

  MALUS_INLINE void scatter(const Scattering& f) { act(f); }
  /// Of a form that is known when this is compiled.
  template <MuellerForm Form>
  MALUS_INLINE void scatter(const Mueller<V, incident, exitant, F, F, Form>& f) {
    act(f);
  }

  /// A multiple of the identity, which every frame and order leaves alone, joins the scattering
  /// before it. What the current vertex already holds does not come this way.
  void attenuate(const V& transmittance) {
    if (!reads_polarization_) {
      chain_ *= transmittance;
      throughput_ *= transmittance;
      return;
    }
    if (vertices_.size() == 1 || vertices_.back().deposit_form != StokesForm::zero)
      return act(PlainMueller<V, incident, exitant, F>::plain(transmittance));
    Vertex& before = vertices_[vertices_.size() - 2];
    for (std::size_t i = 0; i < value_count(before.form); ++i) before.matrix[i] *= transmittance;
    throughput_ *= transmittance;
  }

  /// A stretch of medium is kept as a vertex that light goes straight on from. Of several, the one
  /// that is transmitted through first acts last.
  void transmit(const Transmittance& t) { act(t); }

  const V& throughput() const { return throughput_; }

  /// The scatterings so far, and those of them that result() evaluates: none behind the last
  /// deposit.
  std::size_t scatterings() const { return scatterings_; }
  std::size_t evaluated() const { return lit_scatterings_; }
  /// No light has been deposited.
  bool is_dark() const { return lit_ == 0; }

  Light result() const {
    if (lit_ == 0) return {};
    Arriving light;
    light.add(vertices_[lit_ - 1]);
    for (std::size_t k = lit_ - 1; k-- > 0;) {
      light.pass(vertices_[k]);
      light.add(vertices_[k]);
    }
    if (!light.is_polarized) return Light::unpolarized(light.s[0]);
    return {light.s[0], light.s[1], light.s[2], light.s[3], outermost_};
  }

 private:
  /// What leaves towards the vertex before, and what is done to light from the next.
  struct Vertex {
    V deposit[4];
    StokesForm deposit_form = StokesForm::zero;
    MuellerForm form = MuellerForm::zero;
    Rotation<scalar_t<V>> turn;  ///< from the matrix's exit frame to where the one before enters
    V matrix[16];

    /// Not defaulted: that would have every value set to zero.
    Vertex() {}  // NOLINT
  };

  /// Light on its way back, in the frame that the next matrix expects.
  struct Arriving {
    V s[4];
    bool is_polarized = false;

    Arriving() : s{V(0), V(0), V(0), V(0)} {}

    MALUS_INLINE void add(const Vertex& v) {
      if (v.deposit_form == StokesForm::zero) return;
      s[0] += v.deposit[0];
      if (v.deposit_form == StokesForm::unpolarized) return;
      for (int i = 1; i < 4; ++i) s[i] = is_polarized ? s[i] + v.deposit[i] : v.deposit[i];
      is_polarized = true;
    }

    MALUS_INLINE void pass(const Vertex& v) {
      detail::with_form(v.form, [&](auto form) MALUS_INLINE_LAMBDA {
        if (is_polarized)
          pass_as<form(), StokesForm::full>(v);
        else
          pass_as<form(), StokesForm::unpolarized>(v);
      });
    }

   private:
    template <MuellerForm FM, StokesForm FS>
    MALUS_INLINE void pass_as(const Vertex& v) {
      constexpr StokesForm R = product_form(FM, FS);
      is_polarized = R == StokesForm::full;
      if constexpr (R == StokesForm::zero) {
        s[0] = V(0);
      } else {
        V out[value_count(R)];
        detail::apply<value_count(R), FM, FS>(static_cast<const V*>(v.matrix),
                                              static_cast<const V*>(s), static_cast<V*>(out));
        if constexpr (needs_exit_frame(FM)) rotate(v.turn, out[1], out[2]);
        detail::copy_values<value_count(R)>(static_cast<const V*>(out), s);
      }
    }
  };

  template <StokesForm Form, class S>
  MALUS_INLINE void deposit_as(const S& light) {
    if constexpr (Form != StokesForm::zero) {
      const V* from = detail::Access::values(light);
      Vertex& v = vertices_.back();
      const bool is_first = v.deposit_form == StokesForm::zero;
      const V intensity = chain_ * from[0];
      v.deposit[0] = is_first ? intensity : v.deposit[0] + intensity;
      if (is_first) v.deposit_form = StokesForm::unpolarized;
      lit_ = vertices_.size();
      lit_scatterings_ = scatterings_;
      if constexpr (Form == StokesForm::full) {
        if (!reads_polarization_) return;
        V s1 = from[1], s2 = from[2];
        rotate(turn_to_entry(light.frame()), s1, s2);
        const bool adds = v.deposit_form == StokesForm::full;
        v.deposit[1] = adds ? v.deposit[1] + s1 : s1;
        v.deposit[2] = adds ? v.deposit[2] + s2 : s2;
        v.deposit[3] = adds ? v.deposit[3] + from[3] : from[3];
        v.deposit_form = StokesForm::full;
      }
    }
  }

  template <class M>
  MALUS_INLINE void act(const M& m) {
    ++scatterings_;
    detail::visit_form(m, [&](auto form) MALUS_INLINE_LAMBDA { act_as<form()>(m); });
  }

  template <MuellerForm Form, class M>
  MALUS_INLINE void act_as(const M& m) {
    if constexpr (Form == MuellerForm::zero) {
      chain_ = throughput_ = V(0);
      reads_polarization_ = false;
    } else {
      const V* from = detail::Access::values(m);
      throughput_ *= from[0];
      if (Form == MuellerForm::depolarizing || !reads_polarization_) {
        if constexpr (needs_enter_frame(Form)) {
          keep_row<Form>(m);
        } else {
          chain_ *= from[0];
          reads_polarization_ = false;
        }
      } else {
        keep<Form>(m);
      }
    }
  }

  template <MuellerForm Form, class M>
  MALUS_INLINE void keep(const M& m) {
    Vertex& v = vertices_.back();
    if constexpr (needs_exit_frame(Form)) v.turn = turn_to_entry(m.exit());
    v.form = Form;
    detail::copy_values<value_count(Form)>(detail::Access::values(m), v.matrix);
    if constexpr (needs_enter_frame(Form))
      enter(m);
    else if constexpr (!is_collinear(Form))
      reads_polarization_ = false;
    vertices_.emplace_back();
  }

  /// What is left of a matrix where nothing but the intensity of what leaves is read.
  template <MuellerForm Form, class M>
  MALUS_INLINE void keep_row(const M& m) {
    Vertex& v = vertices_.back();
    const V* from = detail::Access::values(m);
    v.form = MuellerForm::depolarizing_exit;
    for (int c = 0; c < 4; ++c) {
      const int place = detail::slot(Form, 0, c);
      v.matrix[c] = place < 0 ? V(0) : chain_ * from[place];
    }
    chain_ = V(1);
    enter(m);
    vertices_.emplace_back();
  }

  template <class M>
  MALUS_INLINE void enter(const M& m) {
    entry_ = m.enter();
    has_entry_ = true;
    reads_polarization_ = true;
  }

  /// Into the frame in which the matrix before expects light; the first frame of all is the
  /// result's.
  MALUS_INLINE Rotation<scalar_t<V>> turn_to_entry(const F& frame) {
    if (has_entry_) return rotation(frame, entry_, "PathSweep");
    entry_ = frame;
    outermost_ = frame;
    has_entry_ = true;
    return {};
  }

  std::vector<Vertex> vertices_;
  std::size_t lit_ = 0;  // vertices up to the last that light was deposited at
  std::size_t scatterings_ = 0, lit_scatterings_ = 0;  // so far, and up to the last deposit
  V throughput_ = V(1);
  V chain_ = V(1);  // what is left of intensity since the current vertex, if it depolarises
  bool reads_polarization_ = true;
  bool has_entry_ = false;
  F entry_, outermost_;  // of the matrix before the current vertex; of what leaves the first
};

}  // namespace malus
