// SPDX-License-Identifier: MIT
// A path from the sensor, as an integrator tells of it: where it is scattered and what light is
// deposited there. Of polarised light it is remembered and looked at from its end.
#pragma once

#include <type_traits>

#include "carried_row.hpp"
#include "remembered_path.hpp"
#include "summed_path.hpp"

namespace renderer {

/// How a family adds up what it does not remember.
template <class R, class M>
struct SumOfPath {
  using type = typename R::CameraPath;
};
template <class R>
  requires requires { typename R::MediaPath; }
struct SumOfPath<R, WithMedia> {
  using type = typename R::MediaPath;
};

template <class R, class M>
using PlainCameraPath = std::conditional_t<R::defers, RememberedPath<R, M>,
                                           SummedPath<R, M, typename SumOfPath<R, M>::type>>;

/// Keep one a thread.
template <class R, class M>
class CameraPath : public PlainCameraPath<R, M> {
 public:
  using PlainCameraPath<R, M>::PlainCameraPath;
  void begin(bool) { PlainCameraPath<R, M>::begin(); }
  static typename M::Polarization polarization() { return {}; }
};

/// Among media that polarise what they scatter, directions are drawn by what a path carries.
template <class R>
  requires(R::polarized)
class CameraPath<R, WithMedia> : public PlainCameraPath<R, WithMedia> {
  using Path = PlainCameraPath<R, WithMedia>;

 public:
  using Path::Path;

  void begin(bool draws_by_polarization) {
    Path::begin();
    carries_row_ = draws_by_polarization;
    row_.begin();
  }
  MALUS_INLINE void scatter(const Hit& point, const Vec3& exitant,
                            const Scatterer<WithMedia>& scatterer, const BsdfSampleOf<R>& sample,
                            float factor) {
    if (carries_row_) row_.scatter(point, exitant, scatterer, sample, factor);
    Path::scatter(point, exitant, scatterer, sample, factor);
  }
  void pass(const typename R::Scattering& sheet) {
    if (carries_row_) row_.pass(R::m00(sheet));
    Path::pass(sheet);
  }
  void attenuate(const Rgb& transmittance) {
    if (carries_row_) row_.attenuate(transmittance);
    Path::attenuate(transmittance);
  }
  void transmit(const malus::Polarized<Rgb>::Transmittance& t) {
    if (carries_row_) row_.transmit(t);
    Path::transmit(t);
  }
  Rgb throughput() const { return carries_row_ ? row_.throughput() : Path::throughput(); }
  LinearPolarization polarization() const {
    return carries_row_ ? row_.polarization() : LinearPolarization();
  }

 private:
  CarriedRow row_;
  bool carries_row_ = false;
};

}  // namespace renderer
