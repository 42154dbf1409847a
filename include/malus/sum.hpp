// SPDX-License-Identifier: MIT
// Sums of quantities of one kind and one space (paper, sections 4.1, 4.2 and Appendix A). The right
// one is expressed in the left one's frames; where the left has none, the right one's are taken.
// Illegal sums are deleted with their reason.
//
//   [S, F] + [T, G]           = [S + F G⁻¹ T, F]
//   [M, Fi, Fo] + [N, Gi, Go] = [M + Fo Go⁻¹ N Gi Fi⁻¹, Fi, Fo]
#pragma once

#include <concepts>

#include <malus/product.hpp>

namespace malus {

namespace detail {

template <class A, class B>
concept SameKind = (StokesType<A> && StokesType<B>) || (MuellerType<A> && MuellerType<B>) ||
                   (ImportanceType<A> && ImportanceType<B>) || (AnalyzerType<A> && AnalyzerType<B>);

template <class Q>
struct SumSpace {
  using sides = typename Q::side;
  using frames = typename Q::frame_type;
};
template <MuellerType Q>
struct SumSpace<Q> {
  using sides = void(typename Q::in_side*, typename Q::out_side*);
  using frames = void(typename Q::enter_frame_type, typename Q::exit_frame_type);
};

template <class A, class B>
concept SameSides = std::same_as<typename SumSpace<A>::sides, typename SumSpace<B>::sides>;
template <class A, class B>
concept SameFrames = std::same_as<typename SumSpace<A>::frames, typename SumSpace<B>::frames>;

}  // namespace detail

/// Two quantities of one kind, in one space: they may be added.
template <class A, class B>
concept Summable = detail::SameKind<A, B> && detail::SameValue<A, B> && detail::SameSides<A, B> &&
                   detail::SameFrames<A, B>;

// Stokes + Stokes, Analyzer + Analyzer

namespace detail {

/// a + b of two quantities of four components and one frame.
template <StokesForm FA, StokesForm FB, class A, class B, class Result>
MALUS_INLINE constexpr void add_vectors(const A& a, const B& b, const char* operation,
                                        Result& result) {
  constexpr StokesForm R = sum_form(FA, FB);
  set_form<R>(result);
  const auto *av = Access::values(a), *bv = Access::values(b);
  auto* out = Access::values(result);
  if constexpr (FA == StokesForm::full && FB == StokesForm::full) {
    typename A::value_type b1 = bv[1], b2 = bv[2];
    rotate(turn_between(Access::frame(b), Access::frame(a), operation), b1, b2);
    const typename A::value_type sum[4] = {av[0] + bv[0], av[1] + b1, av[2] + b2, av[3] + bv[3]};
    copy_values<4>(sum, out);
  } else if constexpr (FA == StokesForm::zero) {
    copy_values<value_count(FB)>(bv, out);
  } else {
    const typename A::value_type first = FB == StokesForm::zero ? av[0] : av[0] + bv[0];
    copy_values<value_count(R)>(R == FA ? av : bv, out);
    out[0] = first;
  }
  if constexpr (FA == StokesForm::full)
    copy_frame(Access::frame(result), Access::frame(a));
  else if constexpr (FB == StokesForm::full)
    copy_frame(Access::frame(result), Access::frame(b));
}

}  // namespace detail

template <StokesType A, StokesType B>
  requires Summable<A, B>
MALUS_INLINE constexpr auto operator+(const A& a, const B& b) {
  using Result = Stokes<typename A::value_type, typename A::side, typename A::frame_type,
                        sum_form(A::static_form, B::static_form)>;
  return detail::combine<Result>(
      a, b, [](auto fa, auto fb, const auto& x, const auto& y, auto& result) MALUS_INLINE_LAMBDA {
        detail::add_vectors<fa(), fb()>(x, y, "Stokes + Stokes", result);
      });
}

template <AnalyzerType A, AnalyzerType B>
  requires Summable<A, B>
MALUS_INLINE constexpr auto operator+(const A& a, const B& b) {
  using Result = Analyzer<typename A::value_type, typename A::side, typename A::frame_type,
                          sum_form(A::static_form, B::static_form)>;
  return detail::combine<Result>(
      a, b, [](auto fa, auto fb, const auto& x, const auto& y, auto& result) MALUS_INLINE_LAMBDA {
        detail::add_vectors<fa(), fb()>(x, y, "Analyzer + Analyzer", result);
      });
}

// Mueller + Mueller

namespace detail {

/// The frames that a sum of matrices is expressed in: those of the left operand, then of the right
/// one; for collinear sums with one frame known, that one on both sides.
template <class T>
struct SumFrames {
  const Frame<T>* enter = nullptr;
  const Frame<T>* exit = nullptr;
};

template <class M>
constexpr void add_frames_of(const M& m, SumFrames<typename M::scalar_type>& frames) {
  if constexpr (requires { Access::enter(m).frame; })
    if (!frames.enter && needs_enter_frame(m.form())) frames.enter = &Access::enter(m).frame;
  if constexpr (requires { Access::exit(m).frame; })
    if (!frames.exit && needs_exit_frame(m.form())) frames.exit = &Access::exit(m).frame;
}

/// Turns the exit frame of rows; returns whether by quarter turns alone.
template <class V, class T>
constexpr bool turn_exit_of_rows(const Frame<T>& from, const Frame<T>& to, V* rows) {
  const auto turn = rotation(from, to, "Mueller + Mueller");
  for (std::size_t c = 0; c < 4; ++c) rotate(turn, rows[4 + c], rows[8 + c]);
  return turn.is_quarter_turns();
}
template <class V, class T>
constexpr bool turn_enter_of_rows(const Frame<T>& from, const Frame<T>& to, V* rows) {
  const auto turn = rotation(from, to, "Mueller + Mueller");
  for (std::size_t r = 0; r < 4; ++r) rotate(turn, rows[4 * r + 1], rows[4 * r + 2]);
  return turn.is_quarter_turns();
}

/// rows = m expressed in `frames`. Returns whether all turns needed were quarter turns.
template <class M>
constexpr bool express_rows(const M& m, const SumFrames<typename M::scalar_type>& frames,
                            typename M::value_type* rows) {
  visit_form(m, [&](auto f) { expand<f()>(Access::values(m), rows); });
  bool coincident = true;
  // A collinear matrix is diagonal in any one frame: in two it is turned from the enter to the exit
  // frame.
  if (is_collinear(m.form()) && frames.enter != frames.exit)
    coincident = turn_exit_of_rows(*frames.enter, *frames.exit, rows);
  if constexpr (requires { Access::exit(m).frame; })
    if (const auto& own = Access::exit(m).frame; needs_exit_frame(m.form()) && &own != frames.exit)
      coincident = turn_exit_of_rows(own, *frames.exit, rows) && coincident;
  if constexpr (requires { Access::enter(m).frame; })
    if (const auto& own = Access::enter(m).frame;
        needs_enter_frame(m.form()) && &own != frames.enter)
      coincident = turn_enter_of_rows(own, *frames.enter, rows) && coincident;
  return coincident;
}

/// The same matrix, its form behind a flag.
template <class Result, class M>
constexpr Result as_flagged(const M& m) {
  return mapped<Result>(m, [](const auto& value) { return value; });
}

/// m + d·e0e0ᵀ, which changes m00 alone where that has a place of its own: m is neither zero nor
/// collinear.
template <class Result, class M>
constexpr Result with_m00_added(const M& m, const typename M::value_type& d) {
  Result result = as_flagged<Result>(m);
  Access::values(result)[0] += d;
  return result;
}

}  // namespace detail

template <MuellerType A, MuellerType B>
  requires Summable<A, B>
constexpr auto operator+(const A& a, const B& b) {
  using V = typename A::value_type;
  constexpr bool static_frames =
      StaticFrameType<typename A::enter_frame_type> && StaticFrameType<typename A::exit_frame_type>;
  constexpr MuellerForm R = sum_form(A::static_form, B::static_form, static_frames);
  using Result = Mueller<V, typename A::in_side, typename A::out_side, typename A::enter_frame_type,
                         typename A::exit_frame_type, R>;
  if constexpr (R == MuellerForm::dynamic) {
    // Depolarizers are most of what is added, and turn nothing.
    using enum MuellerForm;
    if (b.form() == zero) return detail::as_flagged<Result>(a);
    if (a.form() == zero) return detail::as_flagged<Result>(b);
    if (b.form() == depolarizing && !is_collinear(a.form()))
      return detail::with_m00_added<Result>(a, b.m00());
    if (a.form() == depolarizing && !is_collinear(b.form()))
      return detail::with_m00_added<Result>(b, a.m00());
  }
  Result result = detail::Access::make<Result>();
  detail::SumFrames<typename A::scalar_type> frames;
  detail::add_frames_of(a, frames);
  detail::add_frames_of(b, frames);
  if (!frames.enter) frames.enter = frames.exit;
  if (!frames.exit) frames.exit = frames.enter;

  V rows[16], right[16];
  bool coincident = detail::express_rows(a, frames, rows);
  coincident = detail::express_rows(b, frames, right) && coincident;
  for (std::size_t i = 0; i < 16; ++i) rows[i] += right[i];

  const MuellerForm form = R == MuellerForm::dynamic ? sum_form(a.form(), b.form(), coincident) : R;
  if constexpr (R == MuellerForm::dynamic) {
    detail::Access::flag(result) = detail::FormFlag<R>(form);
    detail::with_form(form, [&](auto f) {
      detail::compress<f()>(static_cast<const V*>(rows), detail::Access::values(result));
    });
  } else {
    detail::compress<R>(static_cast<const V*>(rows), detail::Access::values(result));
  }
  if constexpr (requires { detail::Access::enter(result).frame; })
    if (needs_enter_frame(form)) detail::Access::enter(result).frame = *frames.enter;
  if constexpr (requires { detail::Access::exit(result).frame; })
    if (needs_exit_frame(form)) detail::Access::exit(result).frame = *frames.exit;
  return result;
}

// Importance + Importance

template <ImportanceType A, ImportanceType B>
  requires Summable<A, B>
constexpr auto operator+(const A& a, const B& b) {
  using V = typename A::value_type;
  using T = typename A::scalar_type;
  constexpr bool static_frames = StaticFrameType<typename A::frame_type>;
  constexpr ImportanceForm R = sum_form(A::static_form, B::static_form, static_frames);
  Importance<V, typename A::side, typename A::frame_type, R> result;
  const bool a_has_frame = needs_frame(a.form()), b_has_frame = needs_frame(b.form());

  V left[16], right[16];
  detail::visit_form(a, [&](auto f) { detail::expand<f()>(detail::Access::values(a), left); });
  detail::visit_form(b, [&](auto f) { detail::expand<f()>(detail::Access::values(b), right); });
  bool coincident = true;
  if constexpr (requires {
                  detail::Access::frame(a).frame;
                  detail::Access::frame(b).frame;
                }) {
    if (a_has_frame && b_has_frame) {
      const Rotation<T> turn = rotation(detail::Access::frame(b).frame,
                                        detail::Access::frame(a).frame, "Importance + Importance");
      coincident = turn.is_quarter_turns() && turn.cos2 > 0;
      for (std::size_t r = 0; r < 4; ++r) rotate(turn, right[4 * r + 1], right[4 * r + 2]);
    }
  }
  for (std::size_t i = 0; i < 16; ++i) left[i] += right[i];

  if constexpr (R == ImportanceForm::dynamic) {
    const ImportanceForm form = sum_form(a.form(), b.form(), coincident);
    detail::Access::flag(result) = detail::FormFlag<R>(form);
    detail::with_form(form, [&](auto f) {
      detail::compress<f()>(static_cast<const V*>(left), detail::Access::values(result));
    });
  } else {
    detail::compress<R>(static_cast<const V*>(left), detail::Access::values(result));
  }
  if constexpr (requires { detail::Access::frame(a).frame; })
    if (a_has_frame) detail::copy_frame(detail::Access::frame(result), detail::Access::frame(a));
  if constexpr (requires { detail::Access::frame(b).frame; })
    if (!a_has_frame && b_has_frame)
      detail::copy_frame(detail::Access::frame(result), detail::Access::frame(b));
  return result;
}

template <class A, class B>
  requires(Summable<A, B> && requires(A a, B b) { a = a + b; })
MALUS_INLINE constexpr A& operator+=(A& a, const B& b) {
  return a = a + b;
}

// What does not compile, and why

namespace detail {
template <class A, class B>
concept ValuesDiffer = SameKind<A, B> && !SameValue<A, B>;
template <class A, class B>
concept SidesDiffer = SameKind<A, B> && SameValue<A, B> && !SameSides<A, B>;
template <class A, class B>
concept FramesDiffer = SameKind<A, B> && SameValue<A, B> && SameSides<A, B> && !SameFrames<A, B>;
template <class A, class B>
concept KindsDiffer = Scalable<A> && Scalable<B> && !SameKind<A, B>;
template <class A, class B>
concept ReadingAndQuantity =
    (MeasurementType<A> && Scalable<B>) || (MeasurementType<B> && Scalable<A>);
}  // namespace detail

// Compilers quote the line with the operator's name: the reason stays on it.
// clang-format off
template <class A, class B>
  requires detail::ValuesDiffer<A, B>
error::value_types_differ operator+(const A&, const B&) = delete;
template <class A, class B>
  requires detail::ValuesDiffer<A, B>
error::value_types_differ operator+=(const A&, const B&) = delete;

template <class A, class B>
  requires detail::SidesDiffer<A, B>
error::sides_differ operator+(const A&, const B&) = delete;
template <class A, class B>
  requires detail::SidesDiffer<A, B>
error::sides_differ operator+=(const A&, const B&) = delete;

template <class A, class B>
  requires detail::FramesDiffer<A, B>
error::frames_differ operator+(const A&, const B&) = delete;
template <class A, class B>
  requires detail::FramesDiffer<A, B>
error::frames_differ operator+=(const A&, const B&) = delete;

template <class A, class B>
  requires detail::KindsDiffer<A, B>
error::kinds_differ operator+(const A&, const B&) = delete;
template <class A, class B>
  requires detail::KindsDiffer<A, B>
error::kinds_differ operator+=(const A&, const B&) = delete;

template <class A, class B>
  requires detail::ReadingAndQuantity<A, B>
error::measurement_has_no_frame operator+(const A&, const B&) = delete;
template <class A, class B>
  requires detail::ReadingAndQuantity<A, B>
error::measurement_has_no_frame operator+=(const A&, const B&) = delete;
// clang-format on

}  // namespace malus
