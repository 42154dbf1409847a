// SPDX-License-Identifier: MIT
// Declarations: the types with their default template arguments, their aliases, and the concepts
// that constrain them. Enough for a header that only names them.
#pragma once

#include <concepts>
#include <cstddef>

#include <malus/form.hpp>
#include <malus/side.hpp>

namespace malus {

// What a component holds

template <std::floating_point T, std::size_t N>
  requires(N >= 1)
class Spectrum;

using Rgb = Spectrum<float, 3>;

namespace detail {
template <class V>
struct ValueTraits;
template <std::floating_point T>
struct ValueTraits<T> {
  using scalar = T;
  static constexpr std::size_t channels = 1;
};
template <class T, std::size_t N>
struct ValueTraits<Spectrum<T, N>> {
  using scalar = T;
  static constexpr std::size_t channels = N;
};
}  // namespace detail

/// What a component may hold: float, double, or a Spectrum of them.
template <class V>
concept SpectralValue = requires { typename detail::ValueTraits<V>::scalar; };

template <SpectralValue V>
using scalar_t = typename detail::ValueTraits<V>::scalar;

template <SpectralValue V>
inline constexpr std::size_t channel_count = detail::ValueTraits<V>::channels;

// What it is expressed in

template <std::floating_point T>
class Frame;
template <class Tag>
struct StaticFrame;

namespace detail {
template <class F>
inline constexpr bool is_static_frame = false;
template <class Tag>
inline constexpr bool is_static_frame<StaticFrame<Tag>> = true;
template <class F>
inline constexpr bool is_runtime_frame = false;
template <class T>
inline constexpr bool is_runtime_frame<Frame<T>> = true;

/// Static frames are the optical bench's, where everything is known at compile time; run-time
/// frames a renderer's.
template <class F, class Form>
inline constexpr Form default_form = is_static_frame<F> ? Form::full : Form::dynamic;
}  // namespace detail

template <class F>
concept StaticFrameType = detail::is_static_frame<F>;
template <class F>
concept RuntimeFrameType = detail::is_runtime_frame<F>;
template <class F>
concept FrameType = StaticFrameType<F> || RuntimeFrameType<F>;

// The quantities

template <SpectralValue V, SideTag Side = exitant, FrameType F = Frame<scalar_t<V>>,
          StokesForm Form = detail::default_form<F, StokesForm>>
class Stokes;

template <SpectralValue V, SideTag In = incident, SideTag Out = exitant,
          FrameType FI = Frame<scalar_t<V>>, FrameType FO = FI,
          MuellerForm Form = detail::default_form<FI, MuellerForm>>
class Mueller;

template <SpectralValue V, SideTag Side = incident, FrameType F = Frame<scalar_t<V>>,
          ImportanceForm Form = detail::default_form<F, ImportanceForm>>
class Importance;

template <SpectralValue V, SideTag Side = incident, FrameType F = Frame<scalar_t<V>>,
          StokesForm Form = detail::default_form<F, StokesForm>>
class Analyzer;

template <SpectralValue V>
class Measurement;

/// Unpolarised light as a type: one value, no frame.
template <SpectralValue V, SideTag Side = exitant, FrameType F = Frame<scalar_t<V>>>
using UnpolarizedStokes = Stokes<V, Side, F, StokesForm::unpolarized>;

// Matrices whose form is known at compile time.
template <SpectralValue V, SideTag In = incident, SideTag Out = exitant,
          FrameType FI = Frame<scalar_t<V>>, FrameType FO = FI>
using PlainMueller = Mueller<V, In, Out, FI, FO, MuellerForm::plain>;
template <SpectralValue V, SideTag In = incident, SideTag Out = exitant,
          FrameType FI = Frame<scalar_t<V>>, FrameType FO = FI>
using PartialMueller = Mueller<V, In, Out, FI, FO, MuellerForm::partial>;
template <SpectralValue V, SideTag In = incident, SideTag Out = exitant,
          FrameType FI = Frame<scalar_t<V>>, FrameType FO = FI>
using DepolarizingMueller = Mueller<V, In, Out, FI, FO, MuellerForm::depolarizing>;
template <SpectralValue V, SideTag In = incident, SideTag Out = exitant,
          FrameType FI = Frame<scalar_t<V>>, FrameType FO = FI>
using BlockMueller = Mueller<V, In, Out, FI, FO, MuellerForm::block>;
template <SpectralValue V, SideTag In = incident, SideTag Out = exitant,
          FrameType FI = Frame<scalar_t<V>>, FrameType FO = FI>
using FullMueller = Mueller<V, In, Out, FI, FO, MuellerForm::full>;

// Which quantity a type is

template <class Q>
inline constexpr bool is_stokes = false;
template <class V, class Side, class F, StokesForm Form>
inline constexpr bool is_stokes<Stokes<V, Side, F, Form>> = true;
template <class Q>
concept StokesType = is_stokes<Q>;

template <class Q>
inline constexpr bool is_mueller = false;
template <class V, class In, class Out, class FI, class FO, MuellerForm Form>
inline constexpr bool is_mueller<Mueller<V, In, Out, FI, FO, Form>> = true;
template <class Q>
concept MuellerType = is_mueller<Q>;

template <class Q>
inline constexpr bool is_importance = false;
template <class V, class Side, class F, ImportanceForm Form>
inline constexpr bool is_importance<Importance<V, Side, F, Form>> = true;
template <class Q>
concept ImportanceType = is_importance<Q>;

template <class Q>
inline constexpr bool is_analyzer = false;
template <class V, class Side, class F, StokesForm Form>
inline constexpr bool is_analyzer<Analyzer<V, Side, F, Form>> = true;
template <class Q>
concept AnalyzerType = is_analyzer<Q>;

template <class Q>
inline constexpr bool is_measurement = false;
template <class V>
inline constexpr bool is_measurement<Measurement<V>> = true;
template <class Q>
concept MeasurementType = is_measurement<Q>;

}  // namespace malus
