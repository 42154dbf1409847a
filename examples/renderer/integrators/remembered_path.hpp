// SPDX-License-Identifier: MIT
// A path from the sensor that polarised light is followed along: scatterings are remembered, and
// act on light when the path is at its end. On a path that finds none, and on the tail of one that
// finds no more, nothing is evaluated; where light comes by, most kinds need no matrix.
#pragma once

#include <malus/deferred_sweep.hpp>
#include <malus/radiometry.hpp>
#include <memory>
#include <variant>
#include <vector>

#include "scatterer.hpp"

namespace renderer {

/// Keep one a thread.
template <class R, class M>
class RememberedPath {
 public:
  explicit RememberedPath(Counters& counters) : counters_(counters) {}

  void begin() {
    sweep_.begin();
    matrices_.clear();
    throughput_ = Rgb(1.0f);
  }

  /// Where a walk is to put what it finds and draws at the current vertex: where it is remembered,
  /// so that nothing has to be copied. The walk's own places are not used.
  Hit& place(Hit&) { return sweep_.event().point; }
  BsdfSampleOf<R>& place(BsdfSampleOf<R>&) { return *std::construct_at(&sweep_.event().sample); }

  /// The path goes on from a vertex in a drawn direction.
  MALUS_INLINE void scatter(const Hit& point, const Vec3& exitant, const Scatterer<M>& scatterer,
                            const BsdfSampleOf<R>& sample, float factor) {
    const Rgb weight = sample.weight * factor;
    throughput_ *= weight;
    if (!scatterer.polarizes()) {
      counters_.count(R::depolarizer(weight));
      return sweep_.depolarize(weight);
    }
    Event& event = sweep_.scatter();
    // What was remembered on the way to the vertex has taken the place that it was found in.
    if (&event.point != &point) event.point = point;
    if (&event.sample != &sample) event.sample = sample;
    event.exitant = by_components(exitant);
    event.scatterer = scatterer;
    event.factor = factor;
    event.is_matrix = false;
  }
  /// Straight on through a sheet.
  void pass(const typename R::Scattering& sheet) {
    throughput_ *= R::m00(sheet);
    remember(sheet);
  }
  /// Through a stretch of medium: what is left of light, whatever its polarisation.
  void attenuate(const Rgb& transmittance) {
    throughput_ *= transmittance;
    sweep_.attenuate(transmittance);
  }
  /// The same where it depends on polarisation.
  void transmit(const typename R::Transmittance& t) {
    throughput_ *= t.m00();
    remember(t);
  }

  MALUS_INLINE void deposit(const typename R::Light& light) { sweep_.deposit(light); }
  /// What the current vertex scatters of light that arrives there, in directions whose value() is
  /// known.
  MALUS_INLINE void deposit(const SurfacePoint& point, const Vec3& incident, const Vec3& exitant,
                            const Scatterer<M>& scatterer, const BsdfValueOf<R>& value,
                            const typename R::Light& light) {
    deposit_scattered<R>(sweep_, point, incident, exitant, scatterer, value, light);
  }
  /// Whether more is read of light that leaves the current vertex than its intensity.
  bool reads_polarization() const { return sweep_.reads_polarization(); }

  const Rgb& throughput() const { return throughput_; }
  typename R::Light result() {
    return sweep_.result([&](const Event& e, const typename R::Light& light, bool reads) {
      if (!e.is_matrix) return act(e, light, reads);
      return std::visit([&](const auto& matrix) { return act(matrix, light, reads); },
                        matrices_[e.matrix]);
    });
  }

  /// The scatterings so far, and those of them that result() evaluates.
  std::size_t scatterings() const { return sweep_.scatterings(); }
  std::size_t evaluated() const { return sweep_.evaluated(); }
  /// No light has been deposited.
  bool is_dark() const { return sweep_.is_dark(); }

 private:
  using Light = typename R::Light;
  using Matrix = std::variant<typename R::Scattering, typename R::Transmittance>;

  struct Event {
    Hit point;
    Vec3 exitant;
    Scatterer<M> scatterer;
    BsdfSampleOf<R> sample;
    float factor;
    bool is_matrix;
    std::size_t matrix;  ///< if it is one: of matrices_

    /// Not defaulted: that would have every value set to zero before it is set.
    Event() {}  // NOLINT
  };

  void remember(const Matrix& matrix) {
    Event& event = sweep_.scatter();
    event.is_matrix = true;
    event.matrix = matrices_.size();
    matrices_.emplace_back(matrix);
  }

  Light act(const typename R::Scattering& sheet, const Light& light, bool reads) {
    counters_.count(sheet);
    return R::scatter(sheet, light, reads);
  }
  Light act(const typename R::Transmittance& t, const Light& light, bool) {
    return R::transmit(t, light);
  }
  Light act(const Event& e, const Light& light, bool reads) {
    return e.scatterer.template with_weight<R>(e.point, e.exitant, Tracing::from_camera, e.sample,
                                               e.factor, [&](const auto& f) {
                                                 counters_.count(f);
                                                 return R::scatter(as_taken_by<R>(f), light, reads);
                                               });
  }

  Counters& counters_;
  malus::DeferredSweep<Rgb, Event> sweep_;
  std::vector<Matrix> matrices_;  // of sheets, and of media that polarise what passes through
  Rgb throughput_{1.0f};
};

}  // namespace renderer
