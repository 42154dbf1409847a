// SPDX-License-Identifier: MIT
// How one static frame lies to another is known to nobody but the user, who says it here; and the
// one unchecked change of frames and sides, unchecked_retag, which a search for its name finds.
#pragma once

#include <malus/propagate.hpp>
#include <malus/sum.hpp>

namespace malus {

/// The same light in the frame G, which is its own frame turned by `turn` (counter-clockwise in the
/// receiver's view).
template <StaticFrameType G, SpectralValue V, SideTag Side, StaticFrameType F, StokesForm Form>
constexpr Stokes<V, Side, G, Form> change_frame(const Stokes<V, Side, F, Form>& s,
                                                const Rotation<scalar_t<V>>& turn) {
  Stokes<V, Side, G, Form> result = detail::retag<Stokes<V, Side, G, Form>>(s);
  auto* value = detail::Access::values(result);
  if constexpr (needs_frame(Form))
    if (needs_frame(s.form())) rotate(turn, value[1], value[2]);
  return result;
}

/// The same quantity with other tags: no component changes, nothing is checked. To must be of the
/// same kind, value and form.
template <class To, class From>
requires(detail::SameKind<To, From>&& detail::SameValue<To, From>&& To::static_form ==
             From::static_form &&
         sizeof(To) == sizeof(From)) constexpr To unchecked_retag(const From& from) {
  return detail::retag<To>(from);
}

}  // namespace malus
