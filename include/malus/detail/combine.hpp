// SPDX-License-Identifier: MIT
// How operations of two quantities reach their kernels: forms that are flags become constants, and
// the result is made in place, no further than its form goes.
#pragma once

#include <malus/detail/kernels.hpp>
#include <malus/stokes.hpp>

namespace malus::detail {

/// Calls f with the form of a quantity as a compile-time constant.
template <class Q, class F>
MALUS_INLINE constexpr decltype(auto) visit_form(const Q& q, F&& f) {
  if constexpr (Q::is_dynamic)
    return with_form(q.form(), f);
  else
    return f(FormConstant<Q::static_form>{});
}

template <auto Form, class Q>
MALUS_INLINE constexpr void set_form(Q& q) {
  if constexpr (Q::is_dynamic) Access::flag(q) = FormFlag<Q::static_form>(Form);
}

/// The result that f(fa, fb, a, b, result) makes, told both forms as constants, where one of them
/// is a flag. A function of its own: a table of all pairs of forms is not to be had at every place
/// where two quantities meet.
template <class Result, class A, class B, class F>
constexpr Result combine_flagged(const A& a, const B& b, F f) {
  Result result = Access::make<Result>();
  visit_form(a, [&](auto fa) MALUS_INLINE_LAMBDA {
    visit_form(b, [&](auto fb) MALUS_INLINE_LAMBDA { f(fa, fb, a, b, result); });
  });
  return result;
}
template <class Result, class A, class B, class F>
MALUS_INLINE constexpr Result combine_fixed(const A& a, const B& b, F f) {
  Result result = Access::make<Result>();
  f(FormConstant<A::static_form>{}, FormConstant<B::static_form>{}, a, b, result);
  return result;
}
/// The same; where both forms are types, in place.
template <class Result, class A, class B, class F>
MALUS_INLINE constexpr Result combine(const A& a, const B& b, F f) {
  if constexpr (A::is_dynamic || B::is_dynamic)
    return combine_flagged<Result>(a, b, f);
  else
    return combine_fixed<Result>(a, b, f);
}

/// G F⁻¹ from one slot to another, of static or of run-time frames.
template <class From, class To>
MALUS_INLINE constexpr auto turn_between(const From& from, const To& to, const char* operation) {
  return rotation(from.get(), to.get(), operation);
}

/// A quantity of the same form and frames whose values are f of these. What the form doesn't have
/// is not copied.
template <class To, class From, class F>
MALUS_INLINE constexpr To mapped(const From& from, F&& f) {
  To to = Access::make<To>();
  visit_form(from, [&](auto form) MALUS_INLINE_LAMBDA {
    map_values<value_count(form())>(f, Access::values(from), Access::values(to));
    if constexpr (MuellerType<From>) {
      if constexpr (needs_enter_frame(form())) copy_frame(Access::enter(to), Access::enter(from));
      if constexpr (needs_exit_frame(form())) copy_frame(Access::exit(to), Access::exit(from));
    } else {
      if constexpr (needs_frame(form())) copy_frame(Access::frame(to), Access::frame(from));
    }
    set_form<form()>(to);
  });
  return to;
}

/// The same of the quantity itself.
template <class Q, class F>
MALUS_INLINE constexpr void map_in_place(Q& q, F&& f) {
  auto* values = Access::values(q);
  visit_form(q, [&](auto form)
                    MALUS_INLINE_LAMBDA { map_values<value_count(form())>(f, values, values); });
}

/// to = from, part by part: what has just been made is not written as a whole to be copied.
template <class Q>
MALUS_INLINE constexpr void assign(Q& to, const Q& from) {
  copy_values<4>(Access::values(from), Access::values(to));
  copy_frame(Access::frame(to), Access::frame(from));
  Access::flag(to) = Access::flag(from);
}

}  // namespace malus::detail
