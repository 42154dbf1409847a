// SPDX-License-Identifier: MIT
// Importance: the pair [Wᵀ, F] of the paper's matrix importance space (section 4.3): four
// simultaneous measurements of light of one direction, one a row. It has one frame, that of the
// light it measures; its rows are readings and have none.
//
// Importance<V, incident> measures light that arrives at its vertex; propagate() turns it into the
// measurement of the exitant light one vertex further. It stands on the left: Wᵀ·M is an
// importance, Wᵀ·S a measurement, M·Wᵀ nothing.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>

#include <glm/mat4x4.hpp>

#include <malus/detail/kernels.hpp>
#include <malus/stokes.hpp>

namespace malus {

template <SpectralValue V, SideTag Side, FrameType F, ImportanceForm Form>
class Importance {
  static consteval bool makes(ImportanceForm form) {
    return Form == form || Form == ImportanceForm::dynamic;
  }

 public:
  using value_type = V;
  using scalar_type = scalar_t<V>;
  using side = Side;
  using frame_type = F;
  using rows_type = std::array<std::array<V, 4>, 4>;
  static constexpr ImportanceForm static_form = Form;
  static constexpr bool is_dynamic = Form == ImportanceForm::dynamic;

  /// Measures nothing: the form zero if dynamic, else all components zero (a run-time frame is then
  /// left uninitialised).
  constexpr Importance() {
    if constexpr (!is_dynamic) value_.fill(V(0));
  }

  /// w·Id: reads the four Stokes components in `frame`, each times w (the paper's "choice of
  /// importance").
  static constexpr Importance plain(const V& w, const F& frame)
    requires(makes(ImportanceForm::plain))
  {
    return Importance(ImportanceForm::plain, std::array<V, 1>{w}, frame);
  }
  /// Four measurements that see S0 alone: W's first column.
  static constexpr Importance depolarizing(const std::array<V, 4>& column)
    requires(makes(ImportanceForm::depolarizing))
  {
    Importance w;
    w.store(column);
    w.flag_ = decltype(w.flag_)(ImportanceForm::depolarizing);
    return w;
  }
  /// Any four rows, each a filter in `frame`.
  static constexpr Importance from_rows(const rows_type& m, const F& frame)
    requires(makes(ImportanceForm::full))
  {
    return Importance(
        ImportanceForm::full,
        std::array<V, 16>{m[0][0], m[0][1], m[0][2], m[0][3], m[1][0], m[1][1], m[1][2], m[1][3],
                          m[2][0], m[2][1], m[2][2], m[2][3], m[3][0], m[3][1], m[3][2], m[3][3]},
        frame);
  }

  /// From GLM's matrices, one a channel: reading r weighs Stokes component c by matrix[c][r].
  template <class T>
  static constexpr Importance from_mat4(
      const std::array<glm::mat<4, 4, T>, channel_count<V>>& matrix, const F& frame = {})
    requires(makes(ImportanceForm::full))
  {
    return from_rows(detail::gather_rows<V>(matrix), frame);
  }

  template <ImportanceForm Other>
    requires(is_dynamic && Other != ImportanceForm::dynamic)
  constexpr Importance(const Importance<V, Side, F, Other>& w) : flag_(Other) {  // NOLINT: widening
    for (std::size_t i = 0; i < value_count(Other); ++i) value_[i] = w.value_[i];
    if constexpr (needs_frame(Other)) frame_ = decltype(frame_)(w.frame());
  }

  constexpr ImportanceForm form() const { return flag_.value(); }

  /// The frame of the light that is measured. Only plain and full importance has one.
  constexpr decltype(auto) frame() const
    requires(needs_frame(Form))
  {
    assert(needs_frame(form()));
    return frame_.get();
  }

  /// Component (measurement, Stokes component), zero where the form has it so.
  constexpr V operator()(int r, int c) const {
    const int place = detail::slot(form(), r, c);
    return place < 0 ? V(0) : value_[static_cast<std::size_t>(place)];
  }

  /// One channel as GLM's matrix (columns), so that `to_mat4() * stokes.to_vec4()` are the
  /// readings.
  constexpr glm::mat<4, 4, scalar_type> to_mat4(std::size_t i = 0) const {
    return detail::to_glm_matrix<scalar_type>(i, *this);
  }

  /// The same measurements, of light expressed in another frame: [Wᵀ F G⁻¹, G].
  constexpr auto expressed_in(const F& frame) const {
    constexpr bool fills = Form == ImportanceForm::plain && RuntimeFrameType<F>;
    Importance<V, Side, F, fills ? ImportanceForm::full : Form> result;
    if constexpr (is_dynamic) {
      result = *this;
      if (!needs_frame(form())) return result;
    }
    if constexpr (!needs_frame(Form) || StaticFrameType<F>) {
      return *this;
    } else {
      detail::with_form(form(),
                        [&](auto f) { detail::expand<f()>(value_.data(), result.value_.data()); });
      const auto turn = rotation(this->frame(), frame, "Importance::expressed_in");
      for (std::size_t r = 0; r < 4; ++r)
        rotate(turn, result.value_[4 * r + 1], result.value_[4 * r + 2]);
      result.frame_ = decltype(result.frame_)(frame);
      result.flag_ = decltype(result.flag_)(ImportanceForm::full);
      return result;
    }
  }

 private:
  friend struct detail::Access;
  constexpr explicit Importance(detail::Uninitialized) {}

  template <SpectralValue, SideTag, FrameType, ImportanceForm>
  friend class Importance;

  template <std::size_t N>
  constexpr Importance(ImportanceForm form, const std::array<V, N>& values, const F& frame)
      : frame_(frame), flag_(form) {
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
  MALUS_NO_UNIQUE_ADDRESS detail::FrameSlot<F, 0, needs_frame(Form)> frame_;
  MALUS_NO_UNIQUE_ADDRESS detail::FormFlag<Form> flag_;
};

}  // namespace malus
