// SPDX-License-Identifier: MIT
// Mueller: the triple [M, F_i, F_o] of the paper's Mueller space (section 4.2): what a scattering
// event, an optical element or a stretch of medium does to polarised light, with the frame it
// expects at its entry and the frame of what leaves.
//
// Mueller<V, In, Out> maps Stokes<V, In> to Stokes<V, Out>; compositions read right to left,
// (C<-B)(B<-A). A BSDF is <incident, exitant>, a transmittance <exitant, incident>. Enter and exit
// follow the light, whichever way a path is traced.
#pragma once

#include <array>
#include <cassert>
#include <concepts>
#include <cstddef>

#include <glm/mat4x4.hpp>

#include <malus/detail/kernels.hpp>
#include <malus/stokes.hpp>

namespace malus {

template <SpectralValue V, SideTag In, SideTag Out, FrameType FI, FrameType FO, MuellerForm Form>
class Mueller {
  static consteval bool makes(MuellerForm form) {
    return Form == form || Form == MuellerForm::dynamic;
  }

 public:
  using value_type = V;
  using scalar_type = scalar_t<V>;
  using in_side = In;
  using out_side = Out;
  using enter_frame_type = FI;
  using exit_frame_type = FO;
  using rows_type = std::array<std::array<V, 4>, 4>;
  static constexpr MuellerForm static_form = Form;
  static_assert(!is_collinear(Form) || std::same_as<FI, FO>,
                "light that goes on as it came stays in its kind of frame");
  static constexpr bool is_dynamic = Form == MuellerForm::dynamic;

  /// No transport: the form zero if dynamic, else all components zero (run-time frames are then
  /// left uninitialised).
  constexpr Mueller() {
    if constexpr (!is_dynamic) value_.fill(V(0));
  }

  // Makers, one a form; each is there for the form itself and for dynamic

  /// a·I for light that goes on as it came.
  static constexpr Mueller plain(const V& a)
    requires(makes(MuellerForm::plain) && std::same_as<FI, FO>)
  {
    return Mueller(MuellerForm::plain, std::array<V, 1>{a});
  }
  /// diag(a, b, b, b) for light that goes on in its direction: transmittance a, of whose
  /// polarisation b/a is left.
  static constexpr Mueller partial(const V& a, const V& b)
    requires(makes(MuellerForm::partial) && std::same_as<FI, FO>)
  {
    return Mueller(MuellerForm::partial, std::array<V, 2>{a, b});
  }
  /// m00 alone: all polarisation is lost.
  static constexpr Mueller depolarizing(const V& m00)
    requires(makes(MuellerForm::depolarizing))
  {
    return Mueller(MuellerForm::depolarizing, std::array<V, 1>{m00});
  }
  /// The first column: whatever enters, what leaves is S0 times this Stokes vector in the exit
  /// frame.
  static constexpr Mueller depolarizing_enter(const std::array<V, 4>& column, const FO& exit)
    requires(makes(MuellerForm::depolarizing_enter))
  {
    Mueller m(MuellerForm::depolarizing_enter, column);
    m.exit_ = decltype(m.exit_)(exit);
    return m;
  }
  /// The first row: what leaves is unpolarised, of the intensity that this row measures in the
  /// enter frame.
  static constexpr Mueller depolarizing_exit(const std::array<V, 4>& row, const FI& enter)
    requires(makes(MuellerForm::depolarizing_exit))
  {
    Mueller m(MuellerForm::depolarizing_exit, row);
    m.enter_ = decltype(m.enter_)(enter);
    return m;
  }
  /// Mirror-symmetric: {m00, m01, m10, m11} and {m22, m23, m32, m33}, all else zero.
  static constexpr Mueller block(const std::array<V, 4>& upper, const std::array<V, 4>& lower,
                                 const FI& enter, const FO& exit)
    requires(makes(MuellerForm::block))
  {
    return Mueller(MuellerForm::block,
                   std::array<V, 8>{upper[0], upper[1], upper[2], upper[3], lower[0], lower[1],
                                    lower[2], lower[3]},
                   enter, exit);
  }
  /// All 16 components, by rows.
  static constexpr Mueller from_rows(const rows_type& m, const FI& enter, const FO& exit)
    requires(makes(MuellerForm::full))
  {
    return Mueller(
        MuellerForm::full,
        std::array<V, 16>{m[0][0], m[0][1], m[0][2], m[0][3], m[1][0], m[1][1], m[1][2], m[1][3],
                          m[2][0], m[2][1], m[2][2], m[2][3], m[3][0], m[3][1], m[3][2], m[3][3]},
        enter, exit);
  }
  static constexpr Mueller from_rows(const rows_type& m)
    requires(makes(MuellerForm::full) && StaticFrameType<FI> && StaticFrameType<FO>)
  {
    return from_rows(m, FI{}, FO{});
  }
  /// From GLM's matrices, one a channel. Their operator[] is a column: component (r, c) is
  /// matrix[c][r].
  template <class T>
  static constexpr Mueller from_mat4(const std::array<glm::mat<4, 4, T>, channel_count<V>>& matrix,
                                     const FI& enter = {}, const FO& exit = {})
    requires(makes(MuellerForm::full))
  {
    return from_rows(detail::gather_rows<V>(matrix), enter, exit);
  }
  /// The same matrix in every channel.
  template <class T>
  static constexpr Mueller from_mat4(const glm::mat<4, 4, T>& matrix, const FI& enter = {},
                                     const FO& exit = {})
    requires(makes(MuellerForm::full))
  {
    std::array<glm::mat<4, 4, T>, channel_count<V>> same;
    same.fill(matrix);
    return from_mat4(same, enter, exit);
  }

  /// The same matrix as a flagged one.
  template <MuellerForm Other>
    requires(is_dynamic && Other != MuellerForm::dynamic)
  constexpr Mueller(const Mueller<V, In, Out, FI, FO, Other>& m)
      : flag_(Other) {  // NOLINT: widening
    for (std::size_t i = 0; i < value_count(Other); ++i) value_[i] = m.value_[i];
    if constexpr (needs_enter_frame(Other)) enter_ = decltype(enter_)(m.enter());
    if constexpr (needs_exit_frame(Other)) exit_ = decltype(exit_)(m.exit());
  }

  // Observers

  constexpr MuellerForm form() const { return flag_.value(); }

  /// The frame that this matrix expects light in. Only for forms that have one (form.hpp).
  constexpr decltype(auto) enter() const
    requires(needs_enter_frame(Form))
  {
    assert(needs_enter_frame(form()));
    return enter_.get();
  }
  /// The frame of the light that leaves. Only for forms that have one (form.hpp).
  constexpr decltype(auto) exit() const
    requires(needs_exit_frame(Form))
  {
    assert(needs_exit_frame(form()));
    return exit_.get();
  }

  /// Component (row, column), zero where the form has it so.
  constexpr V operator()(int r, int c) const {
    const int place = detail::slot(form(), r, c);
    return place < 0 ? V(0) : value_[static_cast<std::size_t>(place)];
  }

  /// What becomes of unpolarised light's intensity: all that unpolarised rendering knows.
  constexpr V m00() const { return form() == MuellerForm::zero ? V(0) : value_[0]; }

  /// One channel as GLM's matrix (columns), so that `to_mat4() * stokes.to_vec4()` is the product.
  constexpr glm::mat<4, 4, scalar_type> to_mat4(std::size_t i = 0) const {
    return detail::to_glm_matrix<scalar_type>(i, *this);
  }

  /// The same matrix in other frames of the same directions: [G_o F_o⁻¹ M F_i G_i⁻¹, G_i, G_o].
  constexpr auto expressed_in(const FI& enter, const FO& exit) const;

 private:
  friend struct detail::Access;
  constexpr explicit Mueller(detail::Uninitialized) {}

  template <SpectralValue, SideTag, SideTag, FrameType, FrameType, MuellerForm>
  friend class Mueller;

  template <std::size_t N>
  constexpr Mueller(MuellerForm form, const std::array<V, N>& values) : flag_(form) {
    store(values);
  }
  template <std::size_t N>
  constexpr Mueller(MuellerForm form, const std::array<V, N>& values, const FI& enter,
                    const FO& exit)
      : enter_(enter), exit_(exit), flag_(form) {
    store(values);
  }

  template <std::size_t N>
  constexpr void store(const std::array<V, N>& values) {
    for (std::size_t i = 0; i < N; ++i) {
      value_[i] = values[i];
      detail::hide_constant(value_[i]);
    }
  }

  std::array<V, value_count(Form)> value_;
  MALUS_NO_UNIQUE_ADDRESS detail::FrameSlot<FI, 0, needs_enter_frame(Form)> enter_;
  MALUS_NO_UNIQUE_ADDRESS detail::FrameSlot<FO, 1, needs_exit_frame(Form)> exit_;
  MALUS_NO_UNIQUE_ADDRESS detail::FormFlag<Form> flag_;
};

template <SpectralValue V, SideTag In, SideTag Out, FrameType FI, FrameType FO, MuellerForm Form>
constexpr auto Mueller<V, In, Out, FI, FO, Form>::expressed_in(const FI& enter,
                                                               const FO& exit) const {
  // Turning one frame of a block makes it full, but for quarter turns, which only a flag can tell.
  constexpr MuellerForm Result =
      Form == MuellerForm::block && (RuntimeFrameType<FI> || RuntimeFrameType<FO>)
          ? MuellerForm::full
          : Form;
  Mueller<V, In, Out, FI, FO, Result> result;
  const MuellerForm from = form();
  bool stays_block = from == MuellerForm::block;
  Rotation<scalar_type> enter_turn, exit_turn;
  if constexpr (RuntimeFrameType<FI> && needs_enter_frame(Form))
    if (needs_enter_frame(from))
      enter_turn = rotation(enter_.get(), enter, "Mueller::expressed_in");
  if constexpr (RuntimeFrameType<FO> && needs_exit_frame(Form))
    if (needs_exit_frame(from)) exit_turn = rotation(exit_.get(), exit, "Mueller::expressed_in");
  stays_block = stays_block && enter_turn.is_quarter_turns() && exit_turn.is_quarter_turns();

  std::array<V, 16> rows;
  detail::with_form(from, [&](auto f) { detail::expand<f()>(value_.data(), rows.data()); });
  if (needs_exit_frame(from))
    for (std::size_t c = 0; c < 4; ++c) rotate(exit_turn, rows[4 + c], rows[8 + c]);
  if (needs_enter_frame(from))
    for (std::size_t r = 0; r < 4; ++r) rotate(enter_turn, rows[4 * r + 1], rows[4 * r + 2]);

  const MuellerForm to = from == MuellerForm::block && !stays_block ? MuellerForm::full : from;
  if constexpr (Result == MuellerForm::dynamic) {
    result.flag_ = detail::FormFlag<Result>(to);
    detail::with_form(to,
                      [&](auto f) { detail::compress<f()>(rows.data(), result.value_.data()); });
  } else {
    detail::compress<Result>(rows.data(), result.value_.data());
  }
  if constexpr (needs_enter_frame(Result)) result.enter_ = decltype(result.enter_)(enter);
  if constexpr (needs_exit_frame(Result)) result.exit_ = decltype(result.exit_)(exit);
  return result;
}

}  // namespace malus
