// SPDX-License-Identifier: MIT
// Spectrum<T, N>: the value that one component of a Stokes vector holds at N wavelengths or colour
// channels.
//
// Channels are padded to whole groups of four lanes, since padded groups compile to steady code
// where packed ones do not. Padding lanes hold whatever arithmetic left there; nothing reads them:
// reductions and comparisons see the N channels alone.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <malus/config.hpp>
#include <malus/fwd.hpp>

namespace malus {

namespace detail {

#if MALUS_SIMD
template <class T>
struct LanesOf {
  static constexpr std::size_t width = 16 / sizeof(T);
  using type [[gnu::vector_size(16)]] = T;
};
template <class T>
using Lanes = typename LanesOf<T>::type;
template <class T>
inline constexpr std::size_t lanes_width = LanesOf<T>::width;
#else
template <class T>
struct alignas(16) Lanes {
  T lane[16 / sizeof(T)];
  T operator[](std::size_t i) const { return lane[i]; }
  T& operator[](std::size_t i) { return lane[i]; }
#define MALUS_LANES_OPERATOR(op)                                                         \
  friend Lanes operator op(const Lanes& a, const Lanes& b) {                             \
    Lanes r;                                                                             \
    for (std::size_t i = 0; i < 16 / sizeof(T); ++i) r.lane[i] = a.lane[i] op b.lane[i]; \
    return r;                                                                            \
  }
  MALUS_LANES_OPERATOR(+)
  MALUS_LANES_OPERATOR(-)
  MALUS_LANES_OPERATOR(*)
  MALUS_LANES_OPERATOR(/)
#undef MALUS_LANES_OPERATOR
  friend Lanes operator-(const Lanes& a) {
    Lanes r;
    for (std::size_t i = 0; i < 16 / sizeof(T); ++i) r.lane[i] = -a.lane[i];
    return r;
  }
};
template <class T>
inline constexpr std::size_t lanes_width = 16 / sizeof(T);
#endif

template <class T>
MALUS_INLINE Lanes<T> broadcast(T x) {
  if constexpr (lanes_width<T> == 4)
    return Lanes<T>{x, x, x, x};
  else
    return Lanes<T>{x, x};
}

/// Of every lane. One instruction where the compiler lets us name it: it makes one of a loop only
/// if it may forget errno.
template <class T>
MALUS_INLINE Lanes<T> square_root(Lanes<T> x) {
#if MALUS_SIMD && defined(__has_builtin)
#if __has_builtin(__builtin_elementwise_sqrt)
  return __builtin_elementwise_sqrt(x);
#elif __has_builtin(__builtin_ia32_sqrtps) && __has_builtin(__builtin_ia32_sqrtpd)
  if constexpr (sizeof(T) == 4)
    return __builtin_ia32_sqrtps(x);
  else
    return __builtin_ia32_sqrtpd(x);
#endif
#endif
  for (std::size_t i = 0; i < lanes_width<T>; ++i) x[i] = std::sqrt(x[i]);
  return x;
}

/// x < 0 ? a : b in every lane.
template <class T>
MALUS_INLINE Lanes<T> where_negative(Lanes<T> x, Lanes<T> a, Lanes<T> b) {
#if MALUS_SIMD
  return x < broadcast(T(0)) ? a : b;
#else
  for (std::size_t i = 0; i < lanes_width<T>; ++i) a[i] = x[i] < 0 ? a[i] : b[i];
  return a;
#endif
}

}  // namespace detail

/// N values of one quantity, one a wavelength or colour channel. T is float or double. Trivial: a
/// default-constructed Spectrum is uninitialised, as a float is; Spectrum(0) is zero.
template <std::floating_point T, std::size_t N>
  requires(N >= 1)
class Spectrum {
 public:
  using scalar_type = T;
  static constexpr std::size_t channels = N;

  Spectrum() = default;

  /// The same value in every channel.
  MALUS_INLINE explicit(N != 1) Spectrum(T value) {
    for (auto& g : group_) g = detail::broadcast(value);
  }

  /// One value a channel, in the order of the channels.
  template <std::convertible_to<T>... U>
    requires(sizeof...(U) == N && N > 1)
  MALUS_INLINE Spectrum(U... value) : Spectrum(std::array<T, N>{static_cast<T>(value)...}) {}

  MALUS_INLINE explicit Spectrum(const std::array<T, N>& value) {
    for (auto& g : group_) g = detail::broadcast(T(0));
    for (std::size_t i = 0; i < N; ++i) group_[i / width][i % width] = value[i];
  }

  /// Channel i, i < N.
  MALUS_INLINE T operator[](std::size_t i) const { return group_[i / width][i % width]; }
  MALUS_INLINE void set(std::size_t i, T value) { group_[i / width][i % width] = value; }

  MALUS_INLINE Spectrum& operator+=(const Spectrum& b) {
    for (std::size_t g = 0; g < groups; ++g) group_[g] = group_[g] + b.group_[g];
    return *this;
  }
  MALUS_INLINE Spectrum& operator-=(const Spectrum& b) {
    for (std::size_t g = 0; g < groups; ++g) group_[g] = group_[g] - b.group_[g];
    return *this;
  }
  MALUS_INLINE Spectrum& operator*=(const Spectrum& b) {
    for (std::size_t g = 0; g < groups; ++g) group_[g] = group_[g] * b.group_[g];
    return *this;
  }
  MALUS_INLINE Spectrum& operator/=(const Spectrum& b) {
    for (std::size_t g = 0; g < groups; ++g) group_[g] = group_[g] / b.group_[g];
    return *this;
  }
  MALUS_INLINE Spectrum& operator*=(T k) {
    for (auto& g : group_) g = g * detail::broadcast(k);
    return *this;
  }
  MALUS_INLINE Spectrum& operator/=(T k) {
    for (auto& g : group_) g = g / detail::broadcast(k);
    return *this;
  }

  friend MALUS_INLINE Spectrum operator+(Spectrum a, const Spectrum& b) { return a += b; }
  friend MALUS_INLINE Spectrum operator-(Spectrum a, const Spectrum& b) { return a -= b; }
  friend MALUS_INLINE Spectrum operator*(Spectrum a, const Spectrum& b) { return a *= b; }
  friend MALUS_INLINE Spectrum operator/(Spectrum a, const Spectrum& b) { return a /= b; }
  friend MALUS_INLINE Spectrum operator*(Spectrum a, T k)
    requires(N > 1)
  {
    return a *= k;
  }
  friend MALUS_INLINE Spectrum operator*(T k, Spectrum a)
    requires(N > 1)
  {
    return a *= k;
  }
  friend MALUS_INLINE Spectrum operator/(Spectrum a, T k)
    requires(N > 1)
  {
    return a /= k;
  }
  friend MALUS_INLINE Spectrum operator-(Spectrum a) {
    for (auto& g : a.group_) g = -g;
    return a;
  }
  /// Channel by channel.
  friend MALUS_INLINE Spectrum sqrt(Spectrum a) {
    for (auto& g : a.group_) g = detail::square_root<T>(g);
    return a;
  }
  /// x < 0 ? a : b, channel by channel.
  friend MALUS_INLINE Spectrum where_negative(const Spectrum& x, Spectrum a, const Spectrum& b) {
    for (std::size_t g = 0; g < groups; ++g)
      a.group_[g] = detail::where_negative<T>(x.group_[g], a.group_[g], b.group_[g]);
    return a;
  }

  friend MALUS_INLINE bool operator==(const Spectrum& a, const Spectrum& b) {
    for (std::size_t i = 0; i < N; ++i)
      if (!(a[i] == b[i])) return false;
    return true;
  }

  /// Makes the value one that the optimiser knows nothing of; see MALUS_HIDE_CONSTANTS.
  MALUS_INLINE void hide() {
#if MALUS_HIDE_CONSTANTS
    for (auto& g : group_) asm("" : "+v"(g));
#endif
  }

 private:
  static constexpr std::size_t width = detail::lanes_width<T>;
  static constexpr std::size_t groups = N == 1 ? 1 : (N + 3) / 4 * 4 / width;
  detail::Lanes<T> group_[groups];
};

// One vocabulary for a scalar and a Spectrum

/// Channel i of a value; a plain scalar has the one channel 0.
template <SpectralValue V>
MALUS_INLINE constexpr scalar_t<V> channel(const V& value, std::size_t i) {
  if constexpr (std::floating_point<V>)
    return static_cast<void>(i), value;
  else
    return value[i];
}

template <SpectralValue V>
MALUS_INLINE constexpr void set_channel(V& value, std::size_t i, scalar_t<V> x) {
  if constexpr (std::floating_point<V>)
    static_cast<void>(i), value = x;
  else
    value.set(i, x);
}

/// x < 0 ? a : b.
template <std::floating_point T>
MALUS_INLINE constexpr T where_negative(T x, T a, T b) {
  return x < 0 ? a : b;
}

namespace detail {

#if MALUS_HIDE_CONSTANTS
template <class T>
MALUS_INLINE void hide_scalar(T& value) {
  asm("" : "+v"(value));
}
#endif

/// For values that makers store: see MALUS_HIDE_CONSTANTS. Does nothing where the compiler is
/// sound.
template <SpectralValue V>
MALUS_INLINE constexpr void hide_constant([[maybe_unused]] V& value) {
#if MALUS_HIDE_CONSTANTS
  if (std::is_constant_evaluated()) return;
  if constexpr (std::floating_point<V>) {
    if constexpr (sizeof(V) <= 8) hide_scalar(value);
  } else {
    value.hide();
  }
#endif
}

}  // namespace detail

/// A value computed channel by channel: f(x) for one value, f(x, y) for two.
template <SpectralValue V, class Function, class... Others>
MALUS_INLINE constexpr V map_channels(Function&& f, const V& first, const Others&... others) {
  if constexpr (std::floating_point<V>) {
    return f(first, others...);
  } else {
    V result(scalar_t<V>(0));
    for (std::size_t i = 0; i < channel_count<V>; ++i) result.set(i, f(first[i], others[i]...));
    return result;
  }
}

template <SpectralValue V>
MALUS_INLINE constexpr scalar_t<V> max_channel(const V& value) {
  scalar_t<V> largest = channel(value, 0);
  for (std::size_t i = 1; i < channel_count<V>; ++i)
    largest = channel(value, i) > largest ? channel(value, i) : largest;
  return largest;
}

template <SpectralValue V>
MALUS_INLINE constexpr scalar_t<V> mean_channel(const V& value) {
  scalar_t<V> sum = channel(value, 0);
  for (std::size_t i = 1; i < channel_count<V>; ++i) sum += channel(value, i);
  return sum / static_cast<scalar_t<V>>(channel_count<V>);
}

/// True when no channel is NaN or infinite. Reads the bits, so that -ffast-math cannot fold it to
/// true.
template <SpectralValue V>
MALUS_INLINE constexpr bool is_finite(const V& value) {
  using T = scalar_t<V>;
  using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
  constexpr Bits exponent = sizeof(T) == 4 ? Bits(0x7f800000u) : Bits(0x7ff0000000000000ull);
  for (std::size_t i = 0; i < channel_count<V>; ++i)
    if ((std::bit_cast<Bits>(channel(value, i)) & exponent) == exponent) return false;
  return true;
}

}  // namespace malus
