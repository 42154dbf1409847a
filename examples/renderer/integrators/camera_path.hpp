// SPDX-License-Identifier: MIT
// A path from the sensor, as an integrator tells of it: where it is scattered and what light is
// deposited there. Of polarised light it is remembered and looked at from its end, but where
// directions are drawn by what it carries.
#pragma once

#include <type_traits>

#include "remembered_path.hpp"
#include "summed_path.hpp"

namespace renderer {

/// Keep one a thread.
template <class R, class M>
class CameraPath;

/// Among surfaces.
template <class R>
class CameraPath<R, NoMedia>
    : public std::conditional_t<R::defers, RememberedPath<R, NoMedia>,
                                SummedPath<R, NoMedia, typename R::CameraPath>> {
  using Path = std::conditional_t<R::defers, RememberedPath<R, NoMedia>,
                                  SummedPath<R, NoMedia, typename R::CameraPath>>;

 public:
  using Path::Path;
  static NoMedia::Polarization polarization() { return {}; }
};

/// Among media that polarise, a path carries the row that intensity is read by, and directions are
/// drawn by it.
template <class R>
class CameraPath<R, WithMedia> {
  using Carrying = SummedPath<R, WithMedia, typename R::RowPath>;
  using Remembered = RememberedPath<R, WithMedia>;

 public:
  explicit CameraPath(Counters& counters) : carrying_(counters), remembered_(counters) {}

  void begin(bool carries_row) {
    carries_row_ = carries_row;
    carries_row ? carrying_.begin(true) : remembered_.begin(false);
  }
  template <class... Arguments>
  MALUS_INLINE void scatter(const Arguments&... a) {
    carries_row_ ? carrying_.scatter(a...) : remembered_.scatter(a...);
  }
  template <class... Arguments>
  MALUS_INLINE void deposit(const Arguments&... a) {
    carries_row_ ? carrying_.deposit(a...) : remembered_.deposit(a...);
  }
  void pass(const typename R::Scattering& sheet) {
    carries_row_ ? carrying_.pass(sheet) : remembered_.pass(sheet);
  }
  void attenuate(const Rgb& t) { carries_row_ ? carrying_.attenuate(t) : remembered_.attenuate(t); }
  void transmit(const typename R::Transmittance& t) {
    carries_row_ ? carrying_.transmit(t) : remembered_.transmit(t);
  }
  bool reads_polarization() const {
    return carries_row_ ? carrying_.reads_polarization() : remembered_.reads_polarization();
  }
  Rgb throughput() const {
    return carries_row_ ? carrying_.throughput() : remembered_.throughput();
  }
  typename R::Light result() { return carries_row_ ? carrying_.result() : remembered_.result(); }
  std::size_t scatterings() const {
    return carries_row_ ? carrying_.sum().scatterings() : remembered_.scatterings();
  }
  std::size_t evaluated() const {
    return carries_row_ ? carrying_.sum().evaluated() : remembered_.evaluated();
  }
  bool is_dark() const { return carries_row_ ? carrying_.sum().is_dark() : remembered_.is_dark(); }

  /// How the row is polarised that the path carries.
  LinearPolarization polarization() const {
    return carries_row_ ? LinearPolarization(carrying_.sum().row()) : LinearPolarization();
  }

 private:
  Carrying carrying_;
  Remembered remembered_;
  bool carries_row_ = false;
};

/// Of families that remember nothing.
template <class R>
  requires(!R::defers)
class CameraPath<R, WithMedia> : public SummedPath<R, WithMedia, typename R::RowPath> {
 public:
  using SummedPath<R, WithMedia, typename R::RowPath>::SummedPath;
  LinearPolarization polarization() const {
    if constexpr (R::polarized)
      return LinearPolarization(this->sum().row());
    else
      return {};
  }
};

}  // namespace renderer
