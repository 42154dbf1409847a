// SPDX-License-Identifier: MIT
// A path from the sensor that polarised light is followed along: scatterings are remembered, and
// act on light when the path is at its end. On a path that finds none, and on the tail of one that
// finds no more, nothing is evaluated; where light comes by, most kinds need no matrix.
#pragma once

#include <malus/deferred_sweep.hpp>
#include <malus/radiometry.hpp>
#include <variant>
#include <vector>

#include "scatterer.hpp"

namespace renderer {

/// Keep one a thread.
template <class R, class M>
class RememberedPath {
 public:
  explicit RememberedPath(Counters& counters) : counters_(counters) {}

  /// With `carries_row`, directions are drawn by the row that intensity is read by, and what is
  /// left of a path is told by it.
  void begin(bool carries_row) {
    sweep_.begin();
    matrices_.clear();
    throughput_ = Rgb(1.0f);
    carries_row_ = carries_row;
  }

  /// The path goes on from a vertex in a drawn direction.
  MALUS_INLINE void scatter(const SurfacePoint& point, const Vec3& exitant,
                            const Scatterer<M>& scatterer, const BsdfSampleOf<R>& sample,
                            float factor) {
    const Rgb weight = sample.weight * factor;
    throughput_ *= weight;
    if (!scatterer.polarizes()) {
      counters_.count(R::depolarizer(weight));
      return sweep_.depolarize(weight);
    }
    Event& event = sweep_.scatter();
    event.point = point;
    event.exitant = exitant;
    event.scatterer = scatterer;
    event.sample = sample;
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
  /// known. Of unpolarised light no more than the matrix's first column is made, and where the
  /// vertex before depolarises no more than m00.
  MALUS_INLINE void deposit(const SurfacePoint& point, const Vec3& incident, const Vec3& exitant,
                            const Scatterer<M>& scatterer, const BsdfValueOf<R>& value,
                            const typename R::Light& light) {
    const bool reads = sweep_.reads_polarization();
    if (!R::is_unpolarized(light))
      return sweep_.deposit(
          renderer::scatter<R>(scatterer, point, incident, exitant, value, light, reads));
    const Rgb intensity = R::intensity(light);
    if (!reads || !scatterer.polarizes())
      return sweep_.deposit(R::unpolarized(value.m00 * intensity));
    scatterer.template with_scattering<R>(point, incident, exitant, value,
                                          [&](const auto& f) MALUS_INLINE_LAMBDA {
                                            sweep_.deposit(R::scatter_unpolarized(f, intensity));
                                          });
  }
  /// Whether more is read of light that leaves the current vertex than its intensity.
  bool reads_polarization() const { return sweep_.reads_polarization(); }

  Rgb throughput() { return M::present && carries_row_ ? row()[0] : throughput_; }
  /// How the row is polarised, where `scatterer` is to draw by it.
  typename M::Polarization polarization(const Scatterer<M>& scatterer) {
    if constexpr (M::present)
      if (carries_row_ && scatterer.is_medium()) return LinearPolarization(row());
    return {};
  }
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
  using Row = typename R::Row;
  using Matrix = std::variant<typename R::Scattering, typename R::Transmittance>;

  struct Event {
    SurfacePoint point;
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

  Row row() {
    return sweep_.row([&](const Row& row, const Event& e) {
      if (!e.is_matrix)
        return e.scatterer.template with_weight<R>(
            e.point, e.exitant, Tracing::from_camera, e.sample, e.factor,
            [&](const auto& f) { return R::carry(row, as_matrix(f)); });
      return std::visit([&](const auto& matrix) { return R::carry(row, matrix); },
                        matrices_[e.matrix]);
    });
  }

  Counters& counters_;
  malus::DeferredSweep<Rgb, Event> sweep_;
  std::vector<Matrix> matrices_;  // of sheets, and of media that polarise what passes through
  Rgb throughput_{1.0f};
  bool carries_row_ = false;
};

}  // namespace renderer
