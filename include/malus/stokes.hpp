// SPDX-License-Identifier: MIT
// Stokes: the pair [S, F] of the paper's Stokes space (section 4.1): polarised light of one
// direction, the frame it is expressed in, and the side of a vertex it is on.
//
// S0 is radiance (or what the user measures light in), S1 > 0 along x, S2 > 0 along x + y, S3 > 0
// right circular in the receiver's view. [S, F] and [G F⁻¹ S, G] are one and the same light.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <utility>

#include <glm/vec4.hpp>

#include <malus/detail/glm_conversion.hpp>
#include <malus/form.hpp>
#include <malus/frame.hpp>
#include <malus/side.hpp>
#include <malus/spectrum.hpp>

namespace malus {

namespace detail {

/// Asks for a quantity of which nothing is set: what a product starts from.
struct Uninitialized {};

/// Gives products and propagation access to the values, whichever the form; users go by components.
struct Access {
  template <class Q>
  static constexpr Q make() {
    return Q(Uninitialized{});
  }
  template <class Q>
  static constexpr auto* values(Q& q) {
    return q.value_.data();
  }
  template <class Q>
  static constexpr auto& flag(Q& q) {
    return q.flag_;
  }
  template <class Q>
  static constexpr auto& enter(Q& q) {
    return q.enter_;
  }
  template <class Q>
  static constexpr auto& exit(Q& q) {
    return q.exit_;
  }
  template <class Q>
  static constexpr auto& frame(Q& q) {
    return q.frame_;
  }
};

/// Where a quantity keeps a frame: nowhere if the frame is static or the form needs none. Which
/// tells two slots apart, so that both can be empty.
template <class F, int Which, bool Needed>
struct FrameSlot {
  constexpr FrameSlot() = default;
  constexpr explicit FrameSlot(const F&) {}
  static constexpr F get()
    requires StaticFrameType<F>
  {
    return {};
  }
};
template <RuntimeFrameType F, int Which>
struct FrameSlot<F, Which, true> {
  F frame;
  FrameSlot() = default;
  constexpr explicit FrameSlot(const F& f) : frame(f) {}
  constexpr const F& get() const { return frame; }
};

/// Copies a frame from slot to slot, where there is one to copy.
template <class To, class From>
MALUS_INLINE constexpr void copy_frame(To& to, const From& from) {
  if constexpr (requires { to.frame; }) to.frame = from.frame;
}

}  // namespace detail

template <SpectralValue V, SideTag Side, FrameType F, StokesForm Form>
class Stokes {
 public:
  using value_type = V;
  using scalar_type = scalar_t<V>;
  using side = Side;
  using frame_type = F;
  static constexpr StokesForm static_form = Form;
  static constexpr bool is_dynamic = Form == StokesForm::dynamic;

  /// No light: the form zero if dynamic, else all components zero (a run-time frame is then left
  /// uninitialised).
  constexpr Stokes() {
    if constexpr (!is_dynamic) value_.fill(V(0));
  }

  /// [(s0, s1, s2, s3), frame].
  constexpr Stokes(const V& s0, const V& s1, const V& s2, const V& s3, const F& frame)
    requires(Form == StokesForm::full || is_dynamic)
      : value_{s0, s1, s2, s3}, frame_(frame), flag_(StokesForm::full) {
    for (V& v : value_) detail::hide_constant(v);
  }
  constexpr Stokes(const V& s0, const V& s1, const V& s2, const V& s3)
    requires(Form == StokesForm::full && StaticFrameType<F>)
      : Stokes(s0, s1, s2, s3, F{}) {}

  /// Unpolarised light of intensity s0, which needs no frame.
  static constexpr Stokes unpolarized(const V& s0)
    requires(Form == StokesForm::unpolarized || is_dynamic ||
             (Form == StokesForm::full && StaticFrameType<F>))
  {
    Stokes s;
    s.value_[0] = s0;
    if constexpr (is_dynamic) s.flag_ = detail::FormFlag<Form>(StokesForm::unpolarized);
    return s;
  }

  /// The same light as a flagged one.
  template <StokesForm Other>
    requires(is_dynamic && Other != StokesForm::dynamic)
  constexpr Stokes(const Stokes<V, Side, F, Other>& s) : flag_(Other) {  // NOLINT: widening
    for (std::size_t i = 0; i < value_count(Other); ++i) value_[i] = detail::Access::values(s)[i];
    if constexpr (needs_frame(Other)) frame_ = decltype(frame_)(s.frame());
  }

  /// From GLM's (S0, S1, S2, S3), one vector a channel.
  template <class T>
  static constexpr Stokes from_vec4(const std::array<glm::vec<4, T>, channel_count<V>>& s,
                                    const F& frame = {})
    requires(Form == StokesForm::full || is_dynamic)
  {
    const auto value = detail::gather_vector<V>(s);
    return {value[0], value[1], value[2], value[3], frame};
  }
  /// The same vector in every channel.
  template <class T>
  static constexpr Stokes from_vec4(const glm::vec<4, T>& s, const F& frame = {})
    requires(Form == StokesForm::full || is_dynamic)
  {
    std::array<glm::vec<4, T>, channel_count<V>> same;
    same.fill(s);
    return from_vec4(same, frame);
  }

  constexpr StokesForm form() const { return flag_.value(); }

  /// The frame S1 and S2 refer to. Only light of the form full has one.
  constexpr decltype(auto) frame() const
    requires(needs_frame(Form))
  {
    assert(needs_frame(form()));
    return frame_.get();
  }

  /// Component i of 0…3 in the frame(), zero where the form has it so.
  constexpr V operator[](std::size_t i) const {
    if constexpr (is_dynamic) {
      if (form() == StokesForm::zero || (form() == StokesForm::unpolarized && i > 0)) return V(0);
      return value_[i];
    } else {
      return i < value_count(Form) ? value_[i] : V(0);
    }
  }
  constexpr V intensity() const { return (*this)[0]; }

  /// The four components of one channel, as GLM's vector.
  constexpr glm::vec<4, scalar_type> to_vec4(std::size_t i = 0) const {
    return {channel((*this)[0], i), channel((*this)[1], i), channel((*this)[2], i),
            channel((*this)[3], i)};
  }

  /// The same light, expressed in another frame of its direction: [G F⁻¹ S, G].
  constexpr Stokes expressed_in(const F& frame) const {
    if constexpr (!RuntimeFrameType<F> || !needs_frame(Form)) {
      return *this;
    } else {
      if (!needs_frame(form())) return *this;
      return expressed_in(frame, rotation(this->frame(), frame, "Stokes::expressed_in"));
    }
  }
  /// The same with the rotation from frame() to `frame` given.
  constexpr Stokes expressed_in(const F& frame, const Rotation<scalar_type>& turn) const
    requires(RuntimeFrameType<F>)
  {
    if (!needs_frame(form())) return *this;
    V s1 = value_[1], s2 = value_[2];
    rotate(turn, s1, s2);
    return {value_[0], s1, s2, value_[3], frame};
  }

 private:
  friend struct detail::Access;
  constexpr explicit Stokes(detail::Uninitialized) {}

  template <SpectralValue, SideTag, FrameType, StokesForm>
  friend class Stokes;

  std::array<V, value_count(Form)> value_;
  MALUS_NO_UNIQUE_ADDRESS detail::FrameSlot<F, 0, needs_frame(Form)> frame_;
  MALUS_NO_UNIQUE_ADDRESS detail::FormFlag<Form> flag_;
};

}  // namespace malus
