// SPDX-License-Identifier: MIT
// Fresnel's terms of conductors, as both kinds of them have them.
#pragma once

#include <malus/malus.hpp>

#include "../core/vector.hpp"

namespace renderer {

/// What a conductor's block is made of, by channel: the components m00 = m11, m01 = m10, m22 = m33
/// and m23 = −m32.
struct ConductorTerms {
  Rgb mean, half_difference, re, im;
};

/// malus::fresnel_conductor() of relative index eta + ik, eta² + k² in 1/16…1e8, to 2·10⁻⁶ of 1;
/// nothing where all is 0. Two divisions that do not wait for each other where that has three in a
/// chain: drawing and evaluating conductors take most of their time here. What isn't used of the
/// result costs nothing.
///
/// With q² = (η + ik)² − sin² θ, q = a + ib: R_s = (A − B)/(A + B), A = |q|² + c², B = 2ac, and R_p
/// = R_s (C − D)/(C + D), C = |q|² c² + s⁴, D = B s², r_s* r_p = −R_s (|q|² c² − s⁴ + 2i s² bc)/(C
/// + D). All is taken times the larger of a and b, of which the smaller is Im q²/2.
MALUS_INLINE ConductorTerms conductor_terms(float cosine, const Rgb& eta, const Rgb& k) {
  const Rgb one(1.0f), none(0.0f), c(cosine), c2(cosine * cosine);
  const Rgb s2((1 - cosine) * (1 + cosine)), s4 = s2 * s2;
  const Rgb re = (eta - one) * (eta + one) + c2 - k * k, half_im = eta * k;
  const Rgb modulus = sqrt(re * re + 4.0f * half_im * half_im);
  const Rgb larger2 = 0.5f * (modulus + where_negative(re, -re, re)), larger = sqrt(larger2);
  const Rgb a = where_negative(re, half_im, larger2), b = where_negative(re, larger2, half_im);

  const Rgb s_sum = (modulus + c2) * larger, s_difference = 2.0f * c * a;  // A and B
  const Rgb p_sum = (modulus * c2 + s4) * larger, p_difference = s_difference * s2;
  const Rgb plus = p_sum + p_difference;
  // Nothing is reflected where there is no interface.
  const Rgb rs =
      where_negative(s_difference - s_sum, (s_sum - s_difference) / (s_sum + s_difference), none);
  const Rgb scale = rs * where_negative(-plus, one / plus, none);
  return {scale * p_sum, scale * p_difference, -scale * ((modulus * c2 - s4) * larger),
          -scale * (2.0f * c * s2 * b)};
}

/// The block of these terms.
template <class Frame>
MALUS_INLINE auto conductor_block(const ConductorTerms& t, const malus::FramePair<Frame>& frames) {
  return malus::BlockMueller<Rgb, malus::incident, malus::exitant, malus::Frame<Frame>>::block(
      {t.mean, t.half_difference, t.half_difference, t.mean}, {t.re, t.im, -t.im, t.re},
      frames.enter, frames.exit);
}

}  // namespace renderer
