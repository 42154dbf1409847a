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
  /// The part of unpolarised light at the current vertex that reaches the first.
  const V& throughput() const { return throughput_; }
  /// The light that leaves the first vertex towards the sensor.
  const V& result() const { return light_; }

 private:
  V throughput_ = V(1), light_ = V(0);
};

/// A camera path of polarised light. Keep one a thread: begin() keeps its memory.
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
    lit_ = 0;
    throughput_ = V(1);
  }

  void deposit(const Light& light) {
    if (light.form() == StokesForm::zero) return;
    vertices_.back().deposit += light;
    lit_ = vertices_.size();
  }

  void scatter(const Scattering& f) {
    vertices_.back().scattering = f;
    throughput_ *= f.m00();
    vertices_.emplace_back();
  }

  /// A multiple of the identity, which every frame and order leaves alone, joins the scattering
  /// before it. What the current vertex already holds does not come this way.
  void attenuate(const V& transmittance) {
    if (vertices_.size() == 1 || vertices_.back().deposit.form() != StokesForm::zero)
      return scatter(Scattering::plain(transmittance));
    Scattering& before = vertices_[vertices_.size() - 2].scattering;
    V* values = detail::Access::values(before);
    for (std::size_t i = 0; i < value_count(before.form()); ++i) values[i] *= transmittance;
    throughput_ *= transmittance;
  }

  /// A stretch of medium is kept as a vertex that light goes straight on from. Of several, the one
  /// that is transmitted through first acts last.
  void transmit(const Transmittance& t) { scatter(detail::retag<Scattering>(t)); }

  const V& throughput() const { return throughput_; }

  /// The scatterings so far, and those of them that result() evaluates: none behind the last
  /// deposit.
  std::size_t scatterings() const { return vertices_.size() - 1; }
  std::size_t evaluated() const { return lit_ > 0 ? lit_ - 1 : 0; }
  /// No light has been deposited.
  bool is_dark() const { return lit_ == 0; }

  Light result() const {
    if (lit_ == 0) return {};
    Light light = vertices_[lit_ - 1].deposit;
    for (std::size_t k = lit_ - 1; k-- > 0;)
      light = vertices_[k].deposit + vertices_[k].scattering * propagate(light);
    return light;
  }

 private:
  struct Vertex {
    Light deposit;
    Scattering scattering;
  };
  std::vector<Vertex> vertices_;
  std::size_t lit_ = 0;  // vertices up to the last that light was deposited at
  V throughput_ = V(1);
};

}  // namespace malus
