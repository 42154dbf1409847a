// SPDX-License-Identifier: MIT
// Polarising extinction: a homogeneous medium that has an optical axis, fixed in space, and a hand.
// It absorbs (dichroism) and delays (birefringence, optical activity) polarisations differently:
// oriented dye in a stretched foil, stressed plastic, a solution of sugar.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <malus/detail/length.hpp>
#include <malus/frame.hpp>
#include <malus/mueller.hpp>
#include <malus/optics/differential.hpp>

namespace malus {

/// A weakly anisotropic medium of one axis. Light at an angle θ to the axis meets an ordinary wave,
/// polarised across the axis, and an extraordinary one, polarised along the axis as far as that is
/// seen. They differ by sin² θ of what they differ by across the axis: to first order in the
/// anisotropy that is what the index ellipsoid 1/n(θ)² = cos² θ/n_o² + sin² θ/n_e² gives, of real
/// indices and of complex ones (Born & Wolf 1999, sections 15.3 and 15.6). Both waves go on as one
/// ray. What is circular is the same in all directions, as it is in liquids.
///
/// Each quantity is per length. All default to none, so that designated initialisers name what
/// there is: UniaxialExtinction<Rgb>{.axis = {0, 1, 0}, .linear_birefringence = Rgb(2.0f)}.
template <SpectralValue V>
struct UniaxialExtinction {
  using scalar_type = scalar_t<V>;
  using vector = glm::vec<3, scalar_type>;

  /// The optical axis, of unit length; either sense. Of no concern where nothing linear is there.
  vector axis{0, 0, 1};
  /// Of the ordinary wave: of light that is polarised across the axis.
  V extinction = V(0);
  /// By how much more light that is polarised along the axis loses, across the axis; may be
  /// negative.
  V linear_dichroism = V(0);
  /// By how much more right circular light loses than left circular light; the mean stays.
  V circular_dichroism = V(0);
  /// Radians by which light that is polarised along the axis lags, across the axis; may be
  /// negative: 2π (n_e − n_o)/λ.
  V linear_birefringence = V(0);
  /// Radians by which the plane of polarisation turns *clockwise* for the receiver (Biot's positive
  /// rotation: dextrorotatory). In the convention of all other angles here that is −α. A specific
  /// rotation [α] in degrees per decimetre and g/ml gives π/180 · [α] · c per decimetre (Biot's
  /// law).
  V optical_rotation = V(0);

  /// False where the medium is but an absorber.
  constexpr bool polarizes() const {
    const V none(0);
    return !(linear_dichroism == none && circular_dichroism == none &&
             linear_birefringence == none && optical_rotation == none);
  }

  /// x is the axis as the receiver sees it; any frame of the ray where it is along the axis. Like
  /// every direction here, that of light's propagation, and of unit length.
  Frame<scalar_type> frame(const vector& direction) const {
    const vector across = glm::cross(direction, axis);
    const scalar_type sin2 = glm::dot(across, across);
    constexpr scalar_type rounding = std::numeric_limits<scalar_type>::epsilon();
    if (!(sin2 > 16 * rounding * rounding)) return Frame<scalar_type>::about(direction);
    return Frame<scalar_type>::from_direction_and_x(
        direction, glm::cross(across, direction) / std::sqrt(sin2));
  }

  /// K in frame(direction). Light that runs the other way meets the same.
  DifferentialMueller<V> differential(const vector& direction) const {
    const scalar_type sin2 = sin2_theta(direction), half(0.5);
    const V half_dichroism = linear_dichroism * (half * sin2), none(0);
    return {extinction + half_dichroism,
            {-half_dichroism, none, circular_dichroism * -half},
            {linear_birefringence * -sin2, none, optical_rotation * scalar_type(2)}};
  }

  /// What unpolarised light loses per length.
  V mean_extinction(const vector& direction) const {
    return extinction + linear_dichroism * (scalar_type(0.5) * sin2_theta(direction));
  }

  /// A stretch along the ray; in frame(direction), and without a frame where nothing polarises.
  Mueller<V, exitant, incident> transmittance(const vector& direction, scalar_type length) const {
    return detail::stretch<Mueller<V, exitant, incident>>(differential(direction), length,
                                                          [&] { return frame(direction); });
  }

  /// Its m00 alone.
  V unpolarized_transmittance(const vector& direction, scalar_type length) const {
    return malus::unpolarized_transmittance(differential(direction), length);
  }

  /// At which rates light decays along a ray: distances are drawn by them.
  DecayRates<V> rates(const vector& direction) const {
    return decay_rates(differential(direction));
  }

  /// What the ordinary wave has to be absorbed at the least, per length, so that no polarisation
  /// gains in any direction: the dichroisms take from one what they spare another. The extinction
  /// less the scattering has to be as much. With t = sin² θ light of the best polarisation loses σ
  /// + ½ (D t − √(D² t² + C²)), which is monotonic in t: least at an end of [0, 1], along the axis
  /// or across.
  V least_absorption() const {
    return map_channels(
        [](scalar_type linear, scalar_type circular) {
          const scalar_type across =
              linear < 0 ? detail::length_of(linear, circular) - linear : std::abs(circular);
          return across / 2;
        },
        linear_dichroism, circular_dichroism);
  }

  /// True where no light gains, given the absorption of the ordinary wave.
  bool is_passive(const V& absorption) const {
    const V least = least_absorption();
    for (std::size_t i = 0; i < channel_count<V>; ++i)
      if (!(channel(absorption, i) >= channel(least, i))) return false;
    return true;
  }

 private:
  scalar_type sin2_theta(const vector& direction) const {
    const vector across = glm::cross(direction, axis);
    return std::min(glm::dot(across, across), scalar_type(1));
  }
};

}  // namespace malus
