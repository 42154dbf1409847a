// SPDX-License-Identifier: MIT
// Analyzer: the pair [wᵀ, F] of the paper's importance space (section 4.3): one measurement of
// light of one direction, a row such as a polarising filter in front of a sensor. The dual of
// Stokes; it stands on the left.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>

#include <malus/stokes.hpp>

namespace malus {

/// Forms are those of the light that the row tells apart: `unpolarized` reads S0 alone and needs no
/// frame.
template <SpectralValue V, SideTag Side, FrameType F, StokesForm Form>
class Analyzer {
 public:
  using value_type = V;
  using scalar_type = scalar_t<V>;
  using side = Side;
  using frame_type = F;
  static constexpr StokesForm static_form = Form;
  static constexpr bool is_dynamic = Form == StokesForm::dynamic;

  /// Reads nothing: the form zero if dynamic, else all components zero.
  constexpr Analyzer() {
    if constexpr (!is_dynamic) value_.fill(V(0));
  }

  /// The reading w0 S0 + w1 S1 + w2 S2 + w3 S3 of light expressed in `frame`.
  constexpr Analyzer(const V& w0, const V& w1, const V& w2, const V& w3, const F& frame)
    requires(Form == StokesForm::full || is_dynamic)
      : value_{w0, w1, w2, w3}, frame_(frame), flag_(StokesForm::full) {
    for (V& v : value_) detail::hide_constant(v);
  }
  constexpr Analyzer(const V& w0, const V& w1, const V& w2, const V& w3)
    requires(Form == StokesForm::full && StaticFrameType<F>)
      : Analyzer(w0, w1, w2, w3, F{}) {}

  /// w·e0ᵀ: reads the intensity, whatever the polarisation.
  static constexpr Analyzer intensity(const V& w)
    requires(Form == StokesForm::unpolarized || is_dynamic ||
             (Form == StokesForm::full && StaticFrameType<F>))
  {
    Analyzer a;
    a.value_[0] = w;
    if constexpr (is_dynamic) a.flag_ = detail::FormFlag<Form>(StokesForm::unpolarized);
    return a;
  }

  template <StokesForm Other>
    requires(is_dynamic && Other != StokesForm::dynamic)
  constexpr Analyzer(const Analyzer<V, Side, F, Other>& w) : flag_(Other) {  // NOLINT: widening
    for (std::size_t i = 0; i < value_count(Other); ++i) value_[i] = detail::Access::values(w)[i];
    if constexpr (needs_frame(Other)) frame_ = decltype(frame_)(w.frame());
  }

  constexpr StokesForm form() const { return flag_.value(); }

  /// The frame of the light that is read. Only the form full has one.
  constexpr decltype(auto) frame() const
    requires(needs_frame(Form))
  {
    assert(needs_frame(form()));
    return frame_.get();
  }

  /// Component i of 0…3 in the frame(), zero where the form has it so.
  constexpr V operator[](std::size_t i) const {
    return detail::slot(form(), static_cast<int>(i)) < 0 ? V(0) : value_[i];
  }

  /// The same measurement, of light expressed in another frame: [wᵀ F G⁻¹, G].
  constexpr Analyzer expressed_in(const F& frame) const {
    if constexpr (!RuntimeFrameType<F> || !needs_frame(Form)) {
      return *this;
    } else {
      Analyzer w = *this;
      if (!needs_frame(form())) return w;
      rotate(rotation(this->frame(), frame, "Analyzer::expressed_in"), w.value_[1], w.value_[2]);
      w.frame_ = decltype(frame_)(frame);
      return w;
    }
  }

 private:
  friend struct detail::Access;
  constexpr explicit Analyzer(detail::Uninitialized) {}

  template <SpectralValue, SideTag, FrameType, StokesForm>
  friend class Analyzer;

  std::array<V, value_count(Form)> value_;
  MALUS_NO_UNIQUE_ADDRESS detail::FrameSlot<F, 0, needs_frame(Form)> frame_;
  MALUS_NO_UNIQUE_ADDRESS detail::FormFlag<Form> flag_;
};

}  // namespace malus
