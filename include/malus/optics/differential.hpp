// SPDX-License-Identifier: MIT
// The differential Mueller matrix of a homogeneous medium that absorbs and delays polarisations
// differently, and its exponential: what a stretch of the medium does to light, in closed form and
// exact for any length (Jones 1948, "A new calculus for the treatment of optical systems. VII";
// Azzam 1978, "Propagation of partially polarized light through anisotropic media with or without
// depolarization").
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>

#include <malus/mueller.hpp>

namespace malus {

/// dS/dz = −K S along the direction of light, in a frame that does not turn on the way:
///
///          ε   −D1  −D2  −D3
///   K  =  −D1   ε   −R3   R2
///         −D2   R3   ε   −R1
///         −D3  −R2   R1   ε
///
/// The signs are those of the elements: a thin slice dz is an attenuator of 1 − ε dz, a
/// diattenuator D dz and an elliptical retarder of phase |R| dz, in any order. Matter that does not
/// amplify has |D| ≤ ε; transmittance() is for such.
template <SpectralValue V>
struct DifferentialMueller {
  /// ε: unpolarised light's loss per length.
  V extinction = V(0);
  /// D, per length: points to the (S1, S2, S3) that gets through best. Light polarised as D loses
  /// ε − |D|, its opposite ε + |D|. A linear_diattenuator along x has D1 > 0.
  std::array<V, 3> diattenuation{V(0), V(0), V(0)};
  /// R, radians per length: points to the (S1, S2, S3) of the fast polarisation, behind which its
  /// opposite lags by |R|. A linear_retarder along x has R1 > 0; a rotator (counter-clockwise) R3 <
  /// 0, twice the angle.
  std::array<V, 3> retardance{V(0), V(0), V(0)};

  /// The cheapest form that holds the exponential: plain, block where there is but what is along x
  /// and y, or full.
  constexpr MuellerForm form() const {
    bool along_x = false, skew = false;
    for (std::size_t i = 0; i < channel_count<V>; ++i) {
      along_x |= channel(diattenuation[0], i) != 0 || channel(retardance[0], i) != 0;
      for (std::size_t k = 1; k < 3; ++k)
        skew |= channel(diattenuation[k], i) != 0 || channel(retardance[k], i) != 0;
    }
    return skew ? MuellerForm::full : along_x ? MuellerForm::block : MuellerForm::plain;
  }
};

/// The real parts of K's eigenvalues lie between these: what a long stretch loses per length of the
/// light that gets through best, and of the light that gets through worst. (The others' are the
/// mean of the two, the extinction.)
template <SpectralValue V>
struct DecayRates {
  V slowest, fastest;
};

namespace detail {

/// The larger of 0 and x; 0 for a NaN.
template <std::floating_point T>
MALUS_INLINE constexpr T at_least_zero(T x) {
  return x > 0 ? x : T(0);
}

/// Nearly the largest number. With the largest itself -ffast-math would leave a comparison out.
template <std::floating_point T>
inline constexpr T huge = std::numeric_limits<T>::max() / 4;

/// Within ±bound.
template <std::floating_point T>
MALUS_INLINE constexpr T within(T bound, T x) {
  const T below = x < bound ? x : bound;
  return below > -bound ? below : -bound;
}

/// 1 − exp(−x) without cancellation, x ≥ 0.
template <std::floating_point T>
MALUS_INLINE T one_minus_exp(T x) {
  if (x == 0) return 0;
  // In twice the precision the difference is good enough, and cheaper than expm1.
  if constexpr (sizeof(T) == 4)
    return static_cast<T>(1 - std::exp(-static_cast<double>(x)));
  else
    return -std::expm1(-x);
}

/// What is left where the eigenvalues of K are ε ± a: exp(−(ε − a)l) and exp(−εl), from the least
/// optical depth (ε − a)l and al ≥ 0, with lost = 1 − exp(−al). Matter that does not amplify has
/// a ≤ ε; where rounding says otherwise the depth is 0.
template <SpectralValue V>
struct Decay {
  V slow, lost, mean;

  MALUS_INLINE Decay(const V& least_depth, const V& a)
      : slow(map_channels([](auto x) { return std::exp(-at_least_zero(x)); }, least_depth)),
        lost(map_channels([](auto x) { return one_minus_exp(x); }, a)),
        mean(slow - slow * lost) {}
  /// exp(−εl) sinh(al) and exp(−εl) sinh²(½al).
  MALUS_INLINE V sinh() const { return slow * (lost - lost * lost * V(scalar_t<V>(0.5))); }
  MALUS_INLINE V sinh_half2() const { return slow * lost * lost * V(scalar_t<V>(0.25)); }
};

template <SpectralValue V>
struct SineAndCosine {
  V sine, cosine;

  MALUS_INLINE explicit SineAndCosine(const V& angle) : sine(0), cosine(0) {
    for (std::size_t i = 0; i < channel_count<V>; ++i) {
      const auto x = channel(angle, i);
      set_channel(sine, i, std::sin(x));
      set_channel(cosine, i, std::cos(x));
    }
  }
};

/// q = a + ib with a ≥ 0, of q² = u + iv, and |q²|.
template <SpectralValue V>
struct ComplexRoot {
  V a, b, norm;

  MALUS_INLINE ComplexRoot(const V& u, const V& v) : a(0), b(0), norm(0) {
    using T = scalar_t<V>;
    const V norm2 = u * u + v * v;
    for (std::size_t i = 0; i < channel_count<V>; ++i) {
      const T ui = channel(u, i), vi = channel(v, i), n = std::sqrt(channel(norm2, i));
      const T larger = std::sqrt((n + std::abs(ui)) / 2);
      const T smaller = larger > 0 ? std::abs(vi) / (2 * larger) : T(0);
      set_channel(norm, i, n);
      set_channel(a, i, ui < 0 ? smaller : larger);
      set_channel(b, i, std::copysign(ui < 0 ? larger : smaller, vi));
    }
  }
};

/// f = D − iR of a stretch, with its invariants f·f = q² = u + iv and f·f* = n: the eigenvalues of
/// Kl are εl ± Re q and εl ± i Im q.
template <SpectralValue V>
struct Anisotropy {
  std::array<V, 3> d, r;
  V u, v, n;

  MALUS_INLINE Anisotropy(const DifferentialMueller<V>& k, scalar_t<V> length)
      : d(scaled(k.diattenuation, length)), r(scaled(k.retardance, length)) {
    // Fourth powers must be finite. Of phases so large rounding is all that is left; of light that
    // far in, nothing, unless matter spares a polarisation to the last digit.
    using T = scalar_t<V>;
    constexpr T bound = sizeof(T) == 4 ? T(5e8) : T(1e75);
    find_invariants();
    if (max_channel(n) <= bound * bound) return;
    for (std::array<V, 3>* const vector : {&d, &r})
      for (V& value : *vector) value = map_channels([](T x) { return within(bound, x); }, value);
    find_invariants();
  }

 private:
  static MALUS_INLINE std::array<V, 3> scaled(const std::array<V, 3>& rates, scalar_t<V> length) {
    return {rates[0] * length, rates[1] * length, rates[2] * length};
  }
  MALUS_INLINE void find_invariants() {
    const V d2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    const V r2 = r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
    const V dr = d[0] * r[0] + d[1] * r[1] + d[2] * r[2];
    u = d2 - r2, v = -(dr + dr), n = d2 + r2;
  }
};

template <SpectralValue V>
MALUS_INLINE V plain_exponential(const V& extinction, scalar_t<V> length) {
  return map_channels([](auto depth) { return std::exp(-depth); }, extinction * length);
}

/// The exponential of a stretch. With c = cosh ½q and s = sinh(½q)/q Jones's J is exp(−½εl)
/// (c + s f·σ), and M = ½ Tr(σᵢ J σⱼ J†): exp(−εl) times |c|² (unit), 2 c* s (real, imaginary) and
/// |s|² (square) are what it is made of.
template <SpectralValue V>
class Exponential {
 public:
  /// No power of e is positive, so that nothing overflows. Nothing cancels either for small
  /// arguments: cosh x ± cos y are 2 sinh² ½x + 2 cos² ½y and 2 sinh² ½x + 2 sin² ½y.
  MALUS_INLINE Exponential(const DifferentialMueller<V>& k, scalar_t<V> length) : f_(k, length) {
    using T = scalar_t<V>;
    const ComplexRoot<V> q(f_.u, f_.v);
    const Decay<V> decay(k.extinction * length - q.a, q.a);
    const SineAndCosine<V> half(q.b * T(0.5));
    const V sinh = decay.sinh(), sinh_half2 = decay.sinh_half2();
    const V sine = (decay.mean + decay.mean) * half.sine * half.cosine;
    unit_ = sinh_half2 + decay.mean * half.cosine * half.cosine;
    // Where q vanishes, 1/q² is left out and the limits are put in.
    const auto vanishes = [](T norm) { return norm <= std::numeric_limits<T>::epsilon(); };
    const V inverse =
        map_channels([&](T norm) { return vanishes(norm) ? T(0) : 1 / norm; }, q.norm);
    const V limit = map_channels([&](T norm, T mean) { return vanishes(norm) ? mean : T(0); },
                                 q.norm, decay.mean);
    real_ = (q.a * sinh + q.b * sine) * inverse + limit;
    imaginary_ = (q.a * sine - q.b * sinh) * inverse;
    square_ = (sinh_half2 + decay.mean * half.sine * half.sine) * inverse + limit * T(0.25);
  }

  MALUS_INLINE V m00() const { return unit_ + square_ * f_.n; }

  MALUS_INLINE std::array<std::array<V, 4>, 4> rows() const {
    const auto &d = f_.d, &r = f_.r;
    const V twice = square_ + square_, rest = unit_ - square_ * f_.n;
    const auto along = [&](std::size_t i)
                           MALUS_INLINE_LAMBDA { return real_ * d[i] + imaginary_ * r[i]; };
    const auto about = [&](std::size_t i)
                           MALUS_INLINE_LAMBDA { return real_ * r[i] - imaginary_ * d[i]; };
    const auto cross = [&](std::size_t i, std::size_t j)
                           MALUS_INLINE_LAMBDA { return twice * (d[i] * r[j] - d[j] * r[i]); };
    const auto product = [&](std::size_t i, std::size_t j)
                             MALUS_INLINE_LAMBDA { return twice * (d[i] * d[j] + r[i] * r[j]); };
    const V a1 = along(0), a2 = along(1), a3 = along(2);
    const V b1 = about(0), b2 = about(1), b3 = about(2);
    const V c1 = cross(1, 2), c2 = cross(2, 0), c3 = cross(0, 1);
    const V xy = product(0, 1), yz = product(1, 2), zx = product(2, 0);
    return {{{m00(), a1 - c1, a2 - c2, a3 - c3},
             {a1 + c1, rest + product(0, 0), xy + b3, zx - b2},
             {a2 + c2, xy - b3, rest + product(1, 1), yz + b1},
             {a3 + c3, zx + b2, yz - b1, rest + product(2, 2)}}};
  }

 private:
  Anisotropy<V> f_;
  V unit_, real_, imaginary_, square_;
};

/// The same where the first components of D and R are all there is.
template <SpectralValue V>
struct BlockExponential {
  V sum, difference, cosine, sine;

  MALUS_INLINE BlockExponential(const V& extinction, const V& diattenuation, const V& retardance,
                                scalar_t<V> length) {
    using T = scalar_t<V>;
    const V rate = map_channels([](T x) { return std::abs(x); }, diattenuation);
    const V phase = map_channels([](T x) { return within(huge<T>, x); }, retardance * length);
    const Decay<V> decay((extinction - rate) * length, rate * length);
    const SineAndCosine<V> turn(phase);
    const V half = decay.sinh();
    sum = decay.slow - half;
    difference =
        map_channels([](T x, T sign) { return std::copysign(x, sign); }, half, diattenuation);
    cosine = decay.mean * turn.cosine;
    sine = decay.mean * turn.sine;
  }
};

/// The exponential in the cheapest form; the frame is asked for where that has one.
template <MuellerType M, class MakeFrame>
MALUS_INLINE M stretch(const DifferentialMueller<typename M::value_type>& k,
                       typename M::scalar_type length, MakeFrame&& make_frame) {
  using V = typename M::value_type;
  const auto l = within(huge<typename M::scalar_type>, length);
  if constexpr (M::is_dynamic) {
    const MuellerForm form = k.form();
    if (form == MuellerForm::plain) return M::plain(plain_exponential(k.extinction, l));
    if (form == MuellerForm::block) {
      const BlockExponential<V> e(k.extinction, k.diattenuation[0], k.retardance[0], l);
      const auto frame = make_frame();
      return M::block({e.sum, e.difference, e.difference, e.sum},
                      {e.cosine, e.sine, -e.sine, e.cosine}, frame, frame);
    }
  }
  const auto frame = make_frame();
  return M::from_rows(Exponential<V>(k, l).rows(), frame, frame);
}

}  // namespace detail

/// exp(−K·length), the transmittance of a stretch, for propagate(): light enters and leaves in
/// `frame`. With run-time frames it comes in the form that k.form() says, with static ones full.
/// Any length will do, from 0 to infinity. To 4 ulp of m00 times 1 + (ε + |D| + |R|)·length, by
/// which the exponents are rounded.
template <SpectralValue V, FrameType F>
Mueller<V, exitant, incident, F> transmittance(const DifferentialMueller<V>& k, scalar_t<V> length,
                                               const F& frame) {
  return detail::stretch<Mueller<V, exitant, incident, F>>(
      k, length, [&]() MALUS_INLINE_LAMBDA -> const F& { return frame; });
}

/// The transmittance's m00 alone: what is left of unpolarised light's intensity; to
/// the same.
template <SpectralValue V>
V unpolarized_transmittance(const DifferentialMueller<V>& k, scalar_t<V> length) {
  const auto l = detail::within(detail::huge<scalar_t<V>>, length);
  switch (k.form()) {
    case MuellerForm::plain:
      return detail::plain_exponential(k.extinction, l);
    case MuellerForm::block:
      return detail::BlockExponential<V>(k.extinction, k.diattenuation[0], k.retardance[0], l).sum;
    default:
      return detail::Exponential<V>(k, l).m00();
  }
}

/// Where the eigenvalues of K lie: ε ± Re q, with q² = |D|² − |R|² − 2i D·R. Retardance mixes the
/// polarisations and so brings the rates together: Re q ≤ |D|. None is negative, for distances are
/// drawn by them. To 2 ulp of the fastest.
template <SpectralValue V>
DecayRates<V> decay_rates(const DifferentialMueller<V>& k) {
  V spread(0);
  for (std::size_t i = 0; i < channel_count<V>; ++i) {
    // In double, where the fourth powers of float's smallest numbers are numbers.
    double d2 = 0, r2 = 0, dr = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      const double d = static_cast<double>(channel(k.diattenuation[j], i));
      const double r = static_cast<double>(channel(k.retardance[j], i));
      d2 += d * d, r2 += r * r, dr += d * r;
    }
    const detail::ComplexRoot<double> q(d2 - r2, -2 * dr);
    set_channel(spread, i, static_cast<scalar_t<V>>(q.a));
  }
  const V slowest =
      map_channels([](auto x) { return detail::at_least_zero(x); }, k.extinction - spread);
  return {slowest, k.extinction + spread};
}

}  // namespace malus
