// SPDX-License-Identifier: MIT
// A path from the sensor, as an integrator tells of it: where it is scattered and what light is
// deposited there. Of polarised light, a scattering's matrix is made when light is found behind it:
// on a path that finds none, and on the tail of one that finds no more, nothing is evaluated.
#pragma once

#include <malus/radiometry.hpp>
#include <vector>

#include "scatterer.hpp"

namespace renderer {

/// Keep one a thread.
template <class R, class M>
class CameraPath {
  /// In media, a path carries the row that intensity is read by, if they polarise.
  using Sum = std::conditional_t<M::present, typename R::RowPath, typename R::CameraPath>;

 public:
  explicit CameraPath(Counters& counters) : counters_(counters) {}

  /// With `carries_row`, directions are drawn by what is carried.
  void begin([[maybe_unused]] bool carries_row) {
    if constexpr (M::present && R::polarized)
      sum_.begin(carries_row);
    else
      sum_.begin();
    if constexpr (R::defers) {
      defers_ = !carries_row;
      pending_.clear();
      throughput_ = Rgb(1.0f);
    }
  }

  /// The path goes on from a vertex in a drawn direction.
  MALUS_INLINE void scatter(const SurfacePoint& point, const Vec3& exitant,
                            const Scatterer<M>& scatterer, const BsdfSampleOf<R>& sample,
                            float factor) {
    if constexpr (!R::polarized) {
      sum_.scatter(sample.weight * factor);
    } else {
      if (R::defers && defers_) {
        const Rgb weight = sample.weight * factor;
        throughput_ *= weight;
        if (pending_.empty() && !scatterer.polarizes()) {
          const auto f = R::depolarizer(weight);
          counters_.count(f);
          sum_.scatter(f);
        } else {
          defer(point, exitant, scatterer, sample, factor);
        }
      } else {
        make(point, exitant, scatterer, sample, factor);
      }
    }
  }
  /// Straight on through a sheet.
  void pass(const typename R::Scattering& sheet) {
    catch_up();
    if constexpr (R::defers) throughput_ *= R::m00(sheet);
    sum_.scatter(sheet);
  }
  /// Through a stretch of medium: what is left of light, whatever its polarisation.
  void attenuate(const Rgb& transmittance) {
    if constexpr (R::defers) {
      throughput_ *= transmittance;
      if (!pending_.empty()) {
        Scattered& last = pending_.back();
        last.attenuation = last.is_attenuated ? last.attenuation * transmittance : transmittance;
        last.is_attenuated = true;
        return;
      }
    }
    sum_.attenuate(transmittance);
  }
  /// The same where it depends on polarisation.
  template <class Transmittance>
  void transmit(const Transmittance& t) {
    catch_up();
    if constexpr (R::defers) throughput_ *= t.m00();
    sum_.transmit(t);
  }

  MALUS_INLINE void deposit(const typename R::Light& light) {
    catch_up();
    sum_.deposit(light);
  }
  /// What the current vertex scatters of light that arrives there, in directions whose value() is
  /// known. Of unpolarised light no more than the matrix's first column is made, and where the
  /// vertex before depolarises no more than m00.
  MALUS_INLINE void deposit(const SurfacePoint& point, const Vec3& incident, const Vec3& exitant,
                            const Scatterer<M>& scatterer, const BsdfValueOf<R>& value,
                            const typename R::Light& light) {
    catch_up();
    if constexpr (R::defers) {
      if (R::is_unpolarized(light)) {
        const Rgb intensity = R::intensity(light);
        if (!sum_.reads_polarization() || !scatterer.polarizes())
          return sum_.deposit(R::unpolarized(value.m00 * intensity));
        return scatterer.template with_scattering<R>(
            point, incident, exitant, value, [&](const auto& f) MALUS_INLINE_LAMBDA {
              sum_.deposit(R::scatter_unpolarized(f, intensity));
            });
      }
    }
    sum_.deposit(renderer::scatter<R>(scatterer, point, incident, exitant, value, light,
                                      sum_.reads_polarization()));
  }
  /// Whether more is read of light that leaves the current vertex than its intensity.
  bool reads_polarization() {
    catch_up();
    return sum_.reads_polarization();
  }

  Rgb throughput() const {
    if constexpr (R::defers)
      if (defers_) return throughput_;
    return sum_.throughput();
  }
  auto result() const { return sum_.result(); }

  /// The scatterings so far, and those of them whose matrices result() multiplies with.
  std::size_t scatterings() const
    requires R::defers
  {
    return sum_.scatterings() + pending_.size();
  }
  std::size_t evaluated() const
    requires R::defers
  {
    return sum_.evaluated();
  }
  /// No light has been deposited.
  bool is_dark() const
    requires R::defers
  {
    return sum_.is_dark();
  }

  /// How the row is polarised that the path carries.
  typename M::Polarization polarization() const {
    if constexpr (M::present && R::polarized)
      return LinearPolarization(sum_.row());
    else
      return {};
  }

 private:
  struct Scattered {
    SurfacePoint point;
    Vec3 exitant;
    Scatterer<M> scatterer;
    BsdfSampleOf<R> sample;
    float factor;
    bool is_attenuated;
    Rgb attenuation;  ///< of the way on, if it is

    /// Not defaulted: that would have every value set to zero before it is set.
    Scattered() {}  // NOLINT
  };

  MALUS_INLINE void defer(const SurfacePoint& point, const Vec3& exitant,
                          const Scatterer<M>& scatterer, const BsdfSampleOf<R>& sample,
                          float factor) {
    Scattered& s = pending_.emplace_back();
    s.point = point;
    s.exitant = exitant;
    s.scatterer = scatterer;
    s.sample = sample;
    s.factor = factor;
    s.is_attenuated = false;
  }

  /// Light has been found, or is to be asked for.
  MALUS_INLINE void catch_up() {
    if constexpr (R::defers)
      if (!pending_.empty()) make_pending();
  }

  void make_pending() {
    for (const Scattered& s : pending_) {
      make(s.point, s.exitant, s.scatterer, s.sample, s.factor);
      if constexpr (M::present)
        if (s.is_attenuated) sum_.attenuate(s.attenuation);
    }
    pending_.clear();
  }

  void make(const SurfacePoint& point, const Vec3& exitant, const Scatterer<M>& scatterer,
            const BsdfSampleOf<R>& sample, float factor) {
    scatterer.template with_weight<R>(point, exitant, Tracing::from_camera, sample, factor,
                                      [&](const auto& f) MALUS_INLINE_LAMBDA {
                                        counters_.count(f);
                                        if constexpr (requires { sum_.scatter(f); })
                                          sum_.scatter(f);
                                        else
                                          sum_.scatter(PlasticMueller(f));
                                      });
  }

  Counters& counters_;
  Sum sum_;
  bool defers_ = false;
  std::vector<Scattered> pending_;
  Rgb throughput_{1.0f};
};

}  // namespace renderer
