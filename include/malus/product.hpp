// SPDX-License-Identifier: MIT
// Every legal product, and every illegal one with its reason (paper, sections 4.1–4.3).
// Compositions read right to left:
//
//   Mueller·Stokes      [M, Fi, Fo][S, F]      = [M Fi F⁻¹ S, Fo]
//   Mueller·Mueller     [N, Gt, Fo][M, Fi, Ft] = [N Gt Ft⁻¹ M, Fi, Fo]
//   Importance·Mueller  [Wᵀ, F][M, Fi, Fo]     = [Wᵀ F Fo⁻¹ M, Fi]
//   Importance·Stokes   [Wᵀ, F][S, G]          = Wᵀ F G⁻¹ S, a Measurement
//   Analyzer·Mueller, Analyzer·Stokes: the same, of one row; the latter is a value.
#pragma once

#include <concepts>

#include <malus/analyzer.hpp>
#include <malus/detail/combine.hpp>
#include <malus/error.hpp>
#include <malus/importance.hpp>
#include <malus/measurement.hpp>
#include <malus/mueller.hpp>
#include <malus/spaces.hpp>
#include <malus/stokes.hpp>

namespace malus {

// Mueller · Stokes

namespace detail {

template <MuellerForm FM, StokesForm FS, class M, class S, class Result>
MALUS_INLINE constexpr void apply_into(const M& m, const S& s, Result& result) {
  constexpr StokesForm R = product_form(FM, FS);
  constexpr std::size_t count = value_count(R);
  set_form<R>(result);
  if constexpr (R == StokesForm::zero) return;
  const auto *mv = Access::values(m), *sv = Access::values(s);
  if constexpr (needs_enter_frame(FM) && FS == StokesForm::full)
    apply_turned<count, FM, FS>(
        mv, turn_between(Access::frame(s), Access::enter(m), "Mueller * Stokes"), sv,
        Access::values(result));
  else
    apply<count, FM, FS>(mv, sv, Access::values(result));
  if constexpr (R == StokesForm::full) {
    if constexpr (needs_exit_frame(FM))
      copy_frame(Access::frame(result), Access::exit(m));
    else
      copy_frame(Access::frame(result), Access::frame(s));
  }
}

}  // namespace detail

template <MuellerType M, StokesType S>
  requires Composable<M, S>
MALUS_INLINE constexpr auto operator*(const M& m, const S& s) {
  constexpr StokesForm R = product_form(M::static_form, S::static_form);
  using Result =
      Stokes<typename S::value_type, typename M::out_side, typename M::exit_frame_type, R>;
  return detail::combine<Result>(
      m, s, [](auto fa, auto fb, const auto& a, const auto& b, auto& result) MALUS_INLINE_LAMBDA {
        detail::apply_into<fa(), fb()>(a, b, result);
      });
}

// Mueller · Mueller

namespace detail {

template <MuellerForm FN, MuellerForm FM, class N, class M, class Result>
MALUS_INLINE constexpr void multiply_into(const N& n, const M& m, Result& result) {
  constexpr bool turns = needs_enter_frame(FN) && needs_exit_frame(FM) &&
                         RuntimeFrameType<typename N::enter_frame_type>;
  constexpr MuellerForm R = product_form(FN, FM, !turns);
  set_form<R>(result);
  if constexpr (R == MuellerForm::zero) return;
  const auto *nv = Access::values(n), *mv = Access::values(m);
  auto* out = Access::values(result);
  if constexpr (!turns) {
    multiply<R, FN, FM>(nv, mv, out);
  } else {
    const auto turn = turn_between(Access::exit(m), Access::enter(n), "Mueller * Mueller");
    constexpr bool may_stay_block =
        Result::is_dynamic && FN == MuellerForm::block && FM == MuellerForm::block;
    if (may_stay_block && turn.is_quarter_turns()) {
      set_form<MuellerForm::block>(result);
      multiply_blocks(nv, turn.cos2, mv, out);
    } else {
      multiply_turned<R, FN, FM>(nv, turn, mv, out);
    }
  }
  if constexpr (needs_enter_frame(R)) {
    if constexpr (needs_enter_frame(FM))
      copy_frame(Access::enter(result), Access::enter(m));
    else
      copy_frame(Access::enter(result), Access::enter(n));
  }
  if constexpr (needs_exit_frame(R)) {
    if constexpr (needs_exit_frame(FN))
      copy_frame(Access::exit(result), Access::exit(n));
    else
      copy_frame(Access::exit(result), Access::exit(m));
  }
}

}  // namespace detail

template <MuellerType N, MuellerType M>
  requires Composable<N, M>
MALUS_INLINE constexpr auto operator*(const N& n, const M& m) {
  constexpr bool coincident = StaticFrameType<typename N::enter_frame_type>;
  constexpr MuellerForm R = product_form(N::static_form, M::static_form, coincident);
  using Result = Mueller<typename N::value_type, typename M::in_side, typename N::out_side,
                         typename M::enter_frame_type, typename N::exit_frame_type, R>;
  return detail::combine<Result>(
      n, m, [](auto fa, auto fb, const auto& a, const auto& b, auto& result) MALUS_INLINE_LAMBDA {
        detail::multiply_into<fa(), fb()>(a, b, result);
      });
}

// Importance · Mueller and Importance · Stokes

namespace detail {

template <ImportanceForm FW, MuellerForm FM, class W, class M, class Result>
MALUS_INLINE constexpr void measure_into(const W& w, const M& m, Result& result) {
  constexpr ImportanceForm R = product_form(FW, FM);
  set_form<R>(result);
  if constexpr (R == ImportanceForm::zero) return;
  const auto *wv = Access::values(w), *mv = Access::values(m);
  auto* out = Access::values(result);
  if constexpr (needs_frame(FW) && needs_exit_frame(FM))
    multiply_turned<R, FW, FM>(
        wv, turn_between(Access::exit(m), Access::frame(w), "Importance * Mueller"), mv, out);
  else
    multiply<R, FW, FM>(wv, mv, out);
  if constexpr (needs_frame(R)) {
    if constexpr (needs_enter_frame(FM))
      copy_frame(Access::frame(result), Access::enter(m));
    else
      copy_frame(Access::frame(result), Access::frame(w));
  }
}

}  // namespace detail

template <ImportanceType W, MuellerType M>
  requires Composable<W, M>
MALUS_INLINE constexpr auto operator*(const W& w, const M& m) {
  constexpr ImportanceForm R = product_form(W::static_form, M::static_form);
  using Result =
      Importance<typename W::value_type, typename M::in_side, typename M::enter_frame_type, R>;
  return detail::combine<Result>(
      w, m, [](auto fa, auto fb, const auto& a, const auto& b, auto& result) MALUS_INLINE_LAMBDA {
        detail::measure_into<fa(), fb()>(a, b, result);
      });
}

template <ImportanceType W, StokesType S>
  requires Composable<W, S>
MALUS_INLINE constexpr auto operator*(const W& w, const S& s) {
  using V = typename W::value_type;
  return detail::visit_form(w, [&](auto fw) MALUS_INLINE_LAMBDA {
    return detail::visit_form(s, [&](auto fs) MALUS_INLINE_LAMBDA {
      if constexpr (fw() == ImportanceForm::zero || fs() == StokesForm::zero) {
        return Measurement<V>();
      } else {
        V out[4];
        const auto *wv = detail::Access::values(w), *sv = detail::Access::values(s);
        if constexpr (needs_frame(fw()) && fs() == StokesForm::full)
          detail::apply_turned<4, fw(), fs()>(
              wv,
              detail::turn_between(detail::Access::frame(s), detail::Access::frame(w),
                                   "Importance * Stokes"),
              sv, out);
        else
          detail::apply<4, fw(), fs()>(wv, sv, out);
        return Measurement<V>(out[0], out[1], out[2], out[3]);
      }
    });
  });
}

// Analyzer · Mueller and Analyzer · Stokes

namespace detail {

template <StokesForm FW, MuellerForm FM, class W, class M, class Result>
MALUS_INLINE constexpr void filter_into(const W& w, const M& m, Result& result) {
  constexpr StokesForm R = row_product_form(FW, FM);
  set_form<R>(result);
  if constexpr (R == StokesForm::zero) return;
  const auto* mv = Access::values(m);
  auto* out = Access::values(result);
  if constexpr (FW == StokesForm::full && needs_exit_frame(FM)) {
    const auto* wv = Access::values(w);
    typename W::value_type row[4] = {wv[0], wv[1], wv[2], wv[3]};
    rotate(turn_between(Access::frame(w), Access::exit(m), "Analyzer * Mueller"), row[1], row[2]);
    apply_row<value_count(R), FW, FM>(static_cast<const typename W::value_type*>(row), mv, out);
  } else {
    apply_row<value_count(R), FW, FM>(Access::values(w), mv, out);
  }
  if constexpr (R == StokesForm::full) {
    if constexpr (needs_enter_frame(FM))
      copy_frame(Access::frame(result), Access::enter(m));
    else
      copy_frame(Access::frame(result), Access::frame(w));
  }
}

/// Σ wᵢ R(s)ᵢ over the components that both have.
template <class A, class B>
MALUS_INLINE constexpr typename A::value_type dot_product(const A& w, const B& s,
                                                          const char* operation) {
  using V = typename A::value_type;
  return visit_form(w, [&](auto fw) MALUS_INLINE_LAMBDA {
    return visit_form(s, [&](auto fs) MALUS_INLINE_LAMBDA {
      if constexpr (fw() == StokesForm::zero || fs() == StokesForm::zero) {
        return V(0);
      } else {
        const auto *wv = Access::values(w), *sv = Access::values(s);
        if constexpr (fw() == StokesForm::unpolarized || fs() == StokesForm::unpolarized) {
          static_cast<void>(operation);
          return V(wv[0] * sv[0]);
        } else {
          V s1 = sv[1], s2 = sv[2];
          rotate(turn_between(Access::frame(s), Access::frame(w), operation), s1, s2);
          return V(wv[0] * sv[0] + wv[1] * s1 + wv[2] * s2 + wv[3] * sv[3]);
        }
      }
    });
  });
}

}  // namespace detail

template <AnalyzerType W, MuellerType M>
  requires Composable<W, M>
MALUS_INLINE constexpr auto operator*(const W& w, const M& m) {
  constexpr StokesForm R = row_product_form(W::static_form, M::static_form);
  using Result =
      Analyzer<typename W::value_type, typename M::in_side, typename M::enter_frame_type, R>;
  return detail::combine<Result>(
      w, m, [](auto fa, auto fb, const auto& a, const auto& b, auto& result) MALUS_INLINE_LAMBDA {
        detail::filter_into<fa(), fb()>(a, b, result);
      });
}

template <AnalyzerType W, StokesType S>
  requires Composable<W, S>
MALUS_INLINE constexpr auto operator*(const W& w, const S& s) {
  return detail::dot_product(w, s, "Analyzer * Stokes");
}

/// ⟨[S, F], [T, G]⟩ = Sᵀ F G⁻¹ T, the inner product of the paper's Appendix A.
template <StokesType S, StokesType T>
  requires(detail::SameValue<S, T> && std::same_as<typename S::side, typename T::side> &&
           std::same_as<typename S::frame_type, typename T::frame_type>)
MALUS_INLINE constexpr auto inner_product(const S& s, const T& t) {
  return detail::dot_product(s, t, "inner_product");
}

// Scaling

namespace detail {
template <class Q>
concept Scalable = StokesType<Q> || MuellerType<Q> || ImportanceType<Q> || AnalyzerType<Q>;
}

/// Scaling by a value a channel. Forms and frames stay.
template <detail::Scalable Q>
MALUS_INLINE constexpr Q operator*(const Q& q, const typename Q::value_type& k) {
  return detail::mapped<Q>(q, [&](const auto& value) MALUS_INLINE_LAMBDA { return value * k; });
}
template <detail::Scalable Q>
MALUS_INLINE constexpr Q operator*(const typename Q::value_type& k, const Q& q) {
  return q * k;
}
/// Scaling by a number.
template <detail::Scalable Q>
  requires(!std::same_as<typename Q::value_type, typename Q::scalar_type>)
MALUS_INLINE constexpr Q operator*(const Q& q, typename Q::scalar_type k) {
  return q * typename Q::value_type(k);
}
template <detail::Scalable Q>
  requires(!std::same_as<typename Q::value_type, typename Q::scalar_type>)
MALUS_INLINE constexpr Q operator*(typename Q::scalar_type k, const Q& q) {
  return q * typename Q::value_type(k);
}
template <detail::Scalable Q>
MALUS_INLINE constexpr Q operator/(const Q& q, typename Q::scalar_type k) {
  return q * typename Q::value_type(1 / k);
}
template <detail::Scalable Q, class K>
  requires requires(Q q, K k) { q = q * k; }
MALUS_INLINE constexpr Q& operator*=(Q& q, const K& k) {
  using V = typename Q::value_type;
  V factor;
  if constexpr (std::convertible_to<const K&, V>)
    factor = k;
  else
    factor = V(static_cast<typename Q::scalar_type>(k));
  detail::map_in_place(q, [&](const V& value) MALUS_INLINE_LAMBDA { return value * factor; });
  return q;
}

// What does not compile, and why

namespace detail {
template <class A, class B>
concept ActsBefore = Acts<A> && Brings<B>;
template <class A, class B>
concept SidesMiss = ActsBefore<A, B> && SameValue<A, B> && !SidesMeet<A, B>;
template <class A, class B>
concept FramesMiss = ActsBefore<A, B> && SameValue<A, B> && SidesMeet<A, B> && !FramesMeet<A, B>;
template <class A, class B>
concept ExpectsArriving = SidesMiss<A, B> && std::same_as<typename Spaces<A>::in_side, incident>;
template <class A, class B>
concept ExpectsLeaving = SidesMiss<A, B> && std::same_as<typename Spaces<A>::in_side, exitant>;
template <class A, class B>
concept ReadingInProduct = (MeasurementType<A> && (Scalable<B> || MeasurementType<B>)) ||
                           (MeasurementType<B> && Scalable<A>);
}  // namespace detail

// Compilers quote the line with the operator's name: the reason stays on it.
// clang-format off
template <detail::Acts A, detail::Brings B>
  requires(!detail::SameValue<A, B>)
error::value_types_differ operator*(const A&, const B&) = delete;

template <class A, class B>
  requires detail::ExpectsArriving<A, B>
error::call_propagate_first operator*(const A&, const B&) = delete;

template <class A, class B>
  requires detail::ExpectsLeaving<A, B>
error::already_propagated operator*(const A&, const B&) = delete;

template <class A, class B>
  requires detail::FramesMiss<A, B>
error::frames_differ operator*(const A&, const B&) = delete;

template <StokesType A, MuellerType B>
error::mueller_goes_on_the_left operator*(const A&, const B&) = delete;

template <class A, detail::Measures B>
  requires(MuellerType<A> || StokesType<A>)
error::importance_goes_on_the_left operator*(const A&, const B&) = delete;

template <StokesType A, StokesType B>
error::use_inner_product operator*(const A&, const B&) = delete;

template <detail::Measures A, detail::Measures B>
error::importance_measures_light_only operator*(const A&, const B&) = delete;

template <class A, class B>
  requires detail::ReadingInProduct<A, B>
error::measurement_has_no_frame operator*(const A&, const B&) = delete;
// clang-format on

}  // namespace malus
