// SPDX-License-Identifier: MIT
// Rayleigh scattering: by particles much smaller than the wavelength, as air's molecules, whose
// anisotropy depolarises (Hansen & Travis 1974, "Light scattering in planetary atmospheres", eqs.
// 2.14-2.16). Elements as in optics/scattering_matrix.hpp, normalised as in the literature: the
// mean of a1 over the sphere is 1, so that by solid angle it is a1/4π.
#pragma once

#include <malus/optics/scattering_matrix.hpp>

namespace malus {

/// With m = cos Θ, D = (1 − ρ)/(1 + ρ/2) and D D' = (1 − 2ρ)/(1 + ρ/2):
/// a1 = ¾D(1 + m²) + 1 − D, a2 = ¾D(1 + m²), a3 = 3/2 D m, a4 = 3/2 D D' m, b1 = −¾D(1 − m²), b2 =
/// 0.
template <SpectralValue V>
class RayleighScattering {
 public:
  using scalar_type = scalar_t<V>;

  /// ρ, the depolarisation factor: of unpolarised light that is scattered at a right angle, the
  /// intensity parallel to the scattering plane over that across it. From 0 (isotropic particles;
  /// the default) to 6/7, which is that of a polarisability without trace; no real symmetric one
  /// has more. Where polarisability is positive along all axes, ρ is at most 1/2; air's is 0.028.
  explicit RayleighScattering(const V& rho = V(0)) {
    const scalar_type one = 1, half = scalar_type(0.5);
    const V below = V(one) + half * rho;
    dipoles_ = (V(one) - rho) / below;
    circular_ = (V(one) - scalar_type(2) * rho) / below;
  }

  /// D: the share of light that is scattered as by isotropic particles. The rest goes evenly to all
  /// sides and is not linearly polarised.
  const V& dipoles() const { return dipoles_; }

  /// a1 alone, to 3 ulp; cosine in [−1, 1].
  V value(scalar_type cosine) const {
    return V(scalar_type(1)) + (scalar_type(0.75) * cosine * cosine - scalar_type(0.25)) * dipoles_;
  }

  /// At an angle between the directions of propagation before and after, of this cosine in [−1, 1];
  /// to 5 ulp of the largest.
  ScatteringElements<V> elements(scalar_type cosine) const {
    const V quarters = scalar_type(0.75) * dipoles_;
    const V linear = quarters * (1 + cosine * cosine);
    const scalar_type across = scalar_type(1.5) * cosine;
    return {value(cosine),
            linear,
            across * dipoles_,
            across * circular_,
            quarters * (cosine * cosine - 1),
            V(scalar_type(0))};
  }

 private:
  V dipoles_, circular_;
};

}  // namespace malus
