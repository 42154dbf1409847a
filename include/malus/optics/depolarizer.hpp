// SPDX-License-Identifier: MIT
// Depolarizers and attenuators, which need no frame (paper, section 5.5).
#pragma once

#include <malus/mueller.hpp>

namespace malus {

/// What leaves is unpolarised, whatever enters: diffuse surfaces. The form is in the type.
template <SpectralValue V, FrameType F = Frame<scalar_t<V>>>
constexpr DepolarizingMueller<V, incident, exitant, F> depolarizer(const V& m00) {
  return DepolarizingMueller<V, incident, exitant, F>::depolarizing(m00);
}

/// Transmits the fraction a of the intensity and, of the polarised part, b ≤ a: diag(a, b, b, b).
/// Light goes on in its direction.
template <SpectralValue V, FrameType F = Frame<scalar_t<V>>>
constexpr PartialMueller<V, incident, exitant, F> partial_depolarizer(const V& a, const V& b) {
  return PartialMueller<V, incident, exitant, F>::partial(a, b);
}

/// Transmits the fraction a, whatever the polarisation: a·I. Light goes on in its direction.
template <SpectralValue V, FrameType F = Frame<scalar_t<V>>>
constexpr PlainMueller<V, incident, exitant, F> attenuator(const V& a) {
  return PlainMueller<V, incident, exitant, F>::plain(a);
}

}  // namespace malus
