// SPDX-License-Identifier: MIT
// An optical element turned about the beam: R(−θ) M R(θ). Where the frames are known at run time
// they are what turns, and the matrix keeps its form.
#pragma once

#include <malus/mueller.hpp>

namespace malus {

/// The element after a turn by `angle` radians, counter-clockwise in the receiver's view. The light
/// it passes on goes where it went: meant for elements that light goes straight through.
template <SpectralValue V, SideTag In, SideTag Out, std::floating_point T, MuellerForm Form>
Mueller<V, In, Out, Frame<T>, Frame<T>, Form> turned(
    Mueller<V, In, Out, Frame<T>, Frame<T>, Form> m, T angle) {
  if constexpr (needs_enter_frame(Form))
    if (needs_enter_frame(m.form())) {
      auto& enter = detail::Access::enter(m).frame;
      enter = enter.turned(angle);
    }
  if constexpr (needs_exit_frame(Form))
    if (needs_exit_frame(m.form())) {
      auto& exit = detail::Access::exit(m).frame;
      exit = exit.turned(angle);
    }
  return m;
}

/// The same in a static frame, which stays: the matrix becomes full.
template <SpectralValue V, SideTag In, SideTag Out, StaticFrameType F, MuellerForm Form>
FullMueller<V, In, Out, F> turned(const Mueller<V, In, Out, F, F, Form>& m, scalar_t<V> angle) {
  const auto back = Rotation<scalar_t<V>>::by(-angle);
  FullMueller<V, In, Out, F> result;
  V* rows = detail::Access::values(result);
  for (int i = 0; i < 16; ++i) rows[i] = m(i / 4, i % 4);
  for (int c = 0; c < 4; ++c) rotate(back, rows[4 + c], rows[8 + c]);
  for (int r = 0; r < 4; ++r) rotate(back, rows[4 * r + 1], rows[4 * r + 2]);
  return result;
}

}  // namespace malus
