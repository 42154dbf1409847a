// SPDX-License-Identifier: MIT
// Which light a quantity acts on and which it brings: the side, the kind of frame and the value
// that have to agree where two quantities meet.
#pragma once

#include <concepts>

#include <malus/fwd.hpp>

namespace malus {

namespace detail {

// What a quantity emits to its left and expects from its right: the spaces that must agree.
template <class Q>
struct Spaces;
template <StokesType Q>
struct Spaces<Q> {
  using out_side = typename Q::side;
  using out_frame = typename Q::frame_type;
};
template <MuellerType Q>
struct Spaces<Q> {
  using out_side = typename Q::out_side;
  using out_frame = typename Q::exit_frame_type;
  using in_side = typename Q::in_side;
  using in_frame = typename Q::enter_frame_type;
};
template <class Q>
  requires(ImportanceType<Q> || AnalyzerType<Q>)
struct Spaces<Q> {
  using in_side = typename Q::side;
  using in_frame = typename Q::frame_type;
};

/// Acts on light to its right.
template <class Q>
concept Acts = MuellerType<Q> || ImportanceType<Q> || AnalyzerType<Q>;
/// Brings light from its right to its left.
template <class Q>
concept Brings = MuellerType<Q> || StokesType<Q>;
template <class Q>
concept Measures = ImportanceType<Q> || AnalyzerType<Q>;

template <class A, class B>
concept SameValue = std::same_as<typename A::value_type, typename B::value_type>;
template <class A, class B>
concept SidesMeet = std::same_as<typename Spaces<A>::in_side, typename Spaces<B>::out_side>;
template <class A, class B>
concept FramesMeet = std::same_as<typename Spaces<A>::in_frame, typename Spaces<B>::out_frame>;

}  // namespace detail

/// The light that leaves B is what A acts on: the product A * B is legal.
template <class A, class B>
concept Composable = detail::Acts<A> && detail::Brings<B> && detail::SameValue<A, B> &&
                     detail::SidesMeet<A, B> && detail::FramesMeet<A, B>;

}  // namespace malus
