// SPDX-License-Identifier: MIT
// The adjoint of a Mueller matrix, ⟨w, M s⟩ = ⟨Mᵀ w, s⟩: the transpose with the frames exchanged
// (the K* of the paper's section 4.4). It acts on importance in column form; Wᵀ·M needs none of it.
#pragma once

#include <malus/mueller.hpp>

namespace malus {

template <SpectralValue V, SideTag In, SideTag Out, FrameType FI, FrameType FO, MuellerForm Form>
constexpr Mueller<V, Out, In, FO, FI, adjoint_form(Form)> adjoint(
    const Mueller<V, In, Out, FI, FO, Form>& m) {
  using Result = Mueller<V, Out, In, FO, FI, adjoint_form(Form)>;
  Result result = detail::Access::make<Result>();
  const auto* values = detail::Access::values(m);
  auto* out = detail::Access::values(result);
  const auto transpose = [&](auto f) MALUS_INLINE_LAMBDA {
    constexpr MuellerForm A = adjoint_form(f());
    detail::for_each_slot<A>([&]<int R, int C>() MALUS_INLINE_LAMBDA {
      out[detail::slot(A, R, C)] = values[detail::slot(f(), C, R)];
    });
    if constexpr (Form == MuellerForm::dynamic)
      detail::Access::flag(result) = detail::FormFlag<MuellerForm::dynamic>(A);
    if constexpr (needs_enter_frame(f()))
      detail::copy_frame(detail::Access::exit(result), detail::Access::enter(m));
    if constexpr (needs_exit_frame(f()))
      detail::copy_frame(detail::Access::enter(result), detail::Access::exit(m));
  };
  if constexpr (Form == MuellerForm::dynamic)
    detail::with_form(m.form(), transpose);
  else
    transpose(detail::FormConstant<Form>{});
  return result;
}

}  // namespace malus
