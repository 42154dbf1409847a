// SPDX-License-Identifier: MIT
// The propagation operator G (paper, section 4.4): exitant light of one vertex is incident light of
// the next. Through free space only the side changes; through a medium a transmittance, Mueller<V,
// exitant, incident>, acts on the way. Importance goes the other way (G*): what measures incident
// light at a vertex measures exitant light at the one before.
#pragma once

#include <malus/product.hpp>

namespace malus {

namespace detail {

/// The same values, frames and form in another space. Every change of side goes through here.
template <class To, class From>
MALUS_INLINE constexpr To retag(const From& from) {
  return mapped<To>(from, [](const auto& value) MALUS_INLINE_LAMBDA { return value; });
}

/// The same where the form of a flagged quantity has been looked at: To is of that form.
template <class To, class From>
MALUS_INLINE constexpr To retag_known(const From& from) {
  To to = Access::make<To>();
  copy_values<value_count(To::static_form)>(Access::values(from), Access::values(to));
  if constexpr (needs_frame(To::static_form)) copy_frame(Access::frame(to), Access::frame(from));
  return to;
}

}  // namespace detail

/// G on light: exitant to incident through free space.
template <SpectralValue V, FrameType F, StokesForm Form>
MALUS_INLINE constexpr Stokes<V, incident, F, Form> propagate(
    const Stokes<V, exitant, F, Form>& s) {
  return detail::retag<Stokes<V, incident, F, Form>>(s);
}

/// G·M: scattering followed by free space.
template <SpectralValue V, SideTag In, FrameType FI, FrameType FO, MuellerForm Form>
MALUS_INLINE constexpr Mueller<V, In, incident, FI, FO, Form> propagate(
    const Mueller<V, In, exitant, FI, FO, Form>& m) {
  return detail::retag<Mueller<V, In, incident, FI, FO, Form>>(m);
}

/// G* on importance: it measures incident light here, the result exitant light at the other end of
/// free space.
template <SpectralValue V, FrameType F, ImportanceForm Form>
MALUS_INLINE constexpr Importance<V, exitant, F, Form> propagate(
    const Importance<V, incident, F, Form>& w) {
  return detail::retag<Importance<V, exitant, F, Form>>(w);
}
template <SpectralValue V, FrameType F, StokesForm Form>
MALUS_INLINE constexpr Analyzer<V, exitant, F, Form> propagate(
    const Analyzer<V, incident, F, Form>& w) {
  return detail::retag<Analyzer<V, exitant, F, Form>>(w);
}

/// A transmittance: what a stretch of medium does to light on its way from one vertex to the next.
template <class M>
concept TransmittanceType = MuellerType<M> && std::same_as<typename M::in_side, exitant> &&
                            std::same_as<typename M::out_side, incident>;

/// G through a medium on light or on a scattering: the transmittance acts last, T·x.
template <detail::Brings X, TransmittanceType T>
  requires Composable<T, X>
MALUS_INLINE constexpr auto propagate(const X& x, const T& transmittance) {
  return transmittance * x;
}

/// G* through a medium on importance: the transmittance acts before the measurement, W·T.
template <detail::Measures W, TransmittanceType T>
  requires Composable<W, T>
MALUS_INLINE constexpr auto propagate(const W& w, const T& transmittance) {
  return w * transmittance;
}

/// Two stretches of medium along one ray, with nothing between them that light notices (an
/// index-matched boundary): second · first, light passes `first` first, whichever way the path is
/// traced. A product of two propagations is illegal otherwise: a scattering goes between them.
template <TransmittanceType First, TransmittanceType Second>
  requires(detail::SameValue<First, Second> && detail::FramesMeet<Second, First>)
MALUS_INLINE constexpr auto concatenate(const First& first, const Second& second) {
  using Leaving =
      Mueller<typename First::value_type, exitant, exitant, typename First::enter_frame_type,
              typename First::exit_frame_type, First::static_form>;
  return second * detail::retag<Leaving>(first);
}

// What does not compile, and why

namespace detail {
/// Light that has arrived, or importance that measures light before it leaves: the other end of
/// free space is behind it.
template <class Q>
concept Propagated = (Brings<Q> && std::same_as<typename Spaces<Q>::out_side, incident>) ||
                     (Measures<Q> && std::same_as<typename Spaces<Q>::in_side, exitant>);
}  // namespace detail

// clang-format off
template <detail::Propagated Q>
error::already_propagated propagate(const Q&) = delete;

template <detail::Propagated Q, TransmittanceType T>
error::already_propagated propagate(const Q&, const T&) = delete;
// clang-format on

}  // namespace malus
