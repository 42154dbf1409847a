// SPDX-License-Identifier: MIT
// How one static frame lies to another is known to nobody but the user, who says it here; and the
// one unchecked change of frames and sides, unchecked_retag, which a search for its name finds.
#pragma once

#include <malus/propagate.hpp>
#include <malus/sum.hpp>

namespace malus {

namespace detail {

/// Turns what a form keeps of S1 and S2, or of the row w1 and w2.
template <class To, class From, class Turn>
constexpr To turn_pair(const From& from, const Turn& turn) {
  To result = retag<To>(from);
  auto* value = Access::values(result);
  if constexpr (needs_frame(From::static_form))
    if (needs_frame(from.form())) rotate(turn, value[1], value[2]);
  return result;
}

}  // namespace detail

/// The same light in the frame G, which is its own frame turned by `turn` (counter-clockwise in the
/// receiver's view).
template <StaticFrameType G, SpectralValue V, SideTag Side, StaticFrameType F, StokesForm Form>
constexpr Stokes<V, Side, G, Form> change_frame(const Stokes<V, Side, F, Form>& s,
                                                const Rotation<scalar_t<V>>& turn) {
  return detail::turn_pair<Stokes<V, Side, G, Form>>(s, turn);
}

/// The same measurement of light expressed in G, its own frame turned by `turn`.
template <StaticFrameType G, SpectralValue V, SideTag Side, StaticFrameType F, StokesForm Form>
constexpr Analyzer<V, Side, G, Form> change_frame(const Analyzer<V, Side, F, Form>& w,
                                                  const Rotation<scalar_t<V>>& turn) {
  return detail::turn_pair<Analyzer<V, Side, G, Form>>(w, turn);
}
template <StaticFrameType G, SpectralValue V, SideTag Side, StaticFrameType F, ImportanceForm Form>
constexpr Importance<V, Side, G, ImportanceForm::full> change_frame(
    const Importance<V, Side, F, Form>& w, const Rotation<scalar_t<V>>& turn) {
  Importance<V, Side, G, ImportanceForm::full> result;
  V* row = detail::Access::values(result);
  for (int i = 0; i < 16; ++i) row[i] = w(i / 4, i % 4);
  for (int r = 0; r < 4; ++r) rotate(turn, row[4 * r + 1], row[4 * r + 2]);
  return result;
}

/// The same matrix between the frames GI and GO, its own frames turned by `enter_turn` and
/// `exit_turn`.
template <StaticFrameType GI, StaticFrameType GO, SpectralValue V, SideTag In, SideTag Out,
          StaticFrameType FI, StaticFrameType FO, MuellerForm Form>
constexpr FullMueller<V, In, Out, GI, GO> change_frames(const Mueller<V, In, Out, FI, FO, Form>& m,
                                                        const Rotation<scalar_t<V>>& enter_turn,
                                                        const Rotation<scalar_t<V>>& exit_turn) {
  FullMueller<V, In, Out, GI, GO> result;
  V* rows = detail::Access::values(result);
  for (int i = 0; i < 16; ++i) rows[i] = m(i / 4, i % 4);
  for (int c = 0; c < 4; ++c) rotate(exit_turn, rows[4 + c], rows[8 + c]);
  for (int r = 0; r < 4; ++r) rotate(enter_turn, rows[4 * r + 1], rows[4 * r + 2]);
  return result;
}

/// The same quantity with other tags: no component changes, nothing is checked. To must be of the
/// same kind, value and form.
template <class To, class From>
  requires(detail::SameKind<To, From> && detail::SameValue<To, From> &&
           To::static_form == From::static_form && sizeof(To) == sizeof(From))
constexpr To unchecked_retag(const From& from) {
  return detail::retag<To>(from);
}

}  // namespace malus
