// SPDX-License-Identifier: MIT
// The paper's first, naive implementation (its section 5.6) as a family of radiometry, for the same
// integrators as malus::Unpolarized and malus::Polarized: every scattering and every stretch of
// medium is a whole matrix a channel with two frames, all light a whole Stokes vector, every change
// of frame a product with a rotation matrix, and a camera path carries its importance as a matrix.
//
// What no frame matters to (unpolarised light, a depolarizer, a multiple of the identity) is given
// none: its axes are zero, and the matrix that turns it is then the identity.
#pragma once

#include <malus/malus.hpp>

#include "../naive.hpp"
#include "naive_matrix.hpp"

namespace variants {

using malus::Rgb;
using NaiveFrame = malus::Frame<float>;
/// Operations are the shared ones of the algebra's benchmark.
using NaiveStokes = naive::Stokes<float>;
using NaiveMuellerBase = naive::Mueller<float, NaiveMatrix>;
using NaiveImportance = naive::Importance<float, NaiveMatrix>;

inline NaiveFrame no_frame() { return {glm::vec3(0.0f), glm::vec3(0.0f)}; }
inline bool is_given(const NaiveFrame& f) { return glm::dot(f.x(), f.x()) > 0; }
inline const NaiveFrame& given(const NaiveFrame& a, const NaiveFrame& otherwise) {
  return is_given(a) ? a : otherwise;
}

inline naive::Value<float> channels_of(const Rgb& v) { return {v[0], v[1], v[2]}; }

/// [S, F]; the light's frame, and for samplers how it is polarised.
struct NaiveLight : NaiveStokes {
  NaiveLight() = default;
  NaiveLight(const NaiveStokes& s) : NaiveStokes(s) {}  // NOLINT: the same

  static NaiveLight unpolarized(const Rgb& s0) {
    NaiveLight s;
    for (std::size_t i = 0; i < naive::channels; ++i) s.value[i] = {s0[i], 0, 0, 0};
    s.NaiveStokes::frame = no_frame();
    return s;
  }

  Rgb operator[](int k) const { return {value[0][k], value[1][k], value[2][k]}; }
  Rgb intensity() const { return (*this)[0]; }
  const NaiveFrame& frame() const { return NaiveStokes::frame; }
  malus::StokesForm form() const {
    const Rgb zero(0.0f);
    const bool is_unpolarized = (*this)[1] == zero && (*this)[2] == zero && (*this)[3] == zero;
    return is_unpolarized ? malus::StokesForm::unpolarized : malus::StokesForm::full;
  }

  friend NaiveLight operator*(NaiveLight s, float k) {
    for (auto& channel : s.value) channel *= k;
    return s;
  }
};

/// [M, F_i, F_o], also of a stretch of medium.
struct NaiveMueller : NaiveMuellerBase {
  NaiveMueller() = default;
  NaiveMueller(const NaiveMuellerBase& m) : NaiveMuellerBase(m) {}  // NOLINT: the same

  /// Everything that BSDFs and phase functions make, in full.
  template <class In, class Out, malus::MuellerForm Form>
  NaiveMueller(const malus::Mueller<Rgb, In, Out, NaiveFrame, NaiveFrame, Form>& m) {  // NOLINT
    std::array<Rgb, 16> rows;
    malus::detail::with_form(m.form(), [&](auto form) {
      malus::detail::expand<form()>(malus::detail::Access::values(m), rows.data());
    });
    for (std::size_t i = 0; i < naive::channels; ++i)
      for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c) value[i][c][r] = rows[static_cast<std::size_t>(4 * r + c)][i];
    enter = exit = no_frame();
    if constexpr (malus::needs_enter_frame(Form))
      if (malus::needs_enter_frame(m.form())) enter = m.enter();
    if constexpr (malus::needs_exit_frame(Form))
      if (malus::needs_exit_frame(m.form())) exit = m.exit();
  }

  static NaiveMueller depolarizing(const Rgb& m00) {
    NaiveMueller m;
    for (std::size_t i = 0; i < naive::channels; ++i) {
      m.value[i] = NaiveMatrix(0.0f);
      m.value[i][0][0] = m00[i];
    }
    m.enter = m.exit = no_frame();
    return m;
  }
  /// a·I, of light of this frame.
  static NaiveMueller plain(const Rgb& a, const NaiveFrame& frame) {
    NaiveMueller m;
    for (std::size_t i = 0; i < naive::channels; ++i) m.value[i] = NaiveMatrix(a[i]);
    m.enter = m.exit = frame;
    return m;
  }

  Rgb m00() const { return {value[0][0][0], value[1][0][0], value[2][0][0]}; }
  /// For the counters.
  static malus::MuellerForm form() { return malus::MuellerForm::full; }

  friend NaiveMueller operator*(const NaiveMueller& m, const Rgb& k) {
    return static_cast<const NaiveMuellerBase&>(m) * channels_of(k);
  }
  friend NaiveMueller operator*(const NaiveMueller& m, float k) { return m * Rgb(k); }
  friend NaiveMueller operator+(const NaiveMueller& a, const NaiveMueller& b) {
    return static_cast<const NaiveMuellerBase&>(a) + static_cast<const NaiveMuellerBase&>(b);
  }
};

/// A multiple of the identity that has no frame leaves the light its own; behind a depolarizer,
/// none matters.
inline NaiveLight scatter_naively(const NaiveMueller& m, const NaiveLight& light) {
  NaiveLight result =
      static_cast<const NaiveMuellerBase&>(m) * static_cast<const NaiveStokes&>(light);
  result.NaiveStokes::frame = given(m.exit, light.frame());
  return result;
}

/// Light behind a medium, which is a matrix like any other.
inline NaiveLight operator*(const NaiveLight& light, const Rgb& transmittance) {
  return scatter_naively(NaiveMueller::plain(transmittance, light.frame()), light);
}
inline NaiveLight& operator*=(NaiveLight& light, const Rgb& transmittance) {
  return light = light * transmittance;
}

/// A camera path by the paper's section 5.2: its importance, and what that has measured so far.
class NaivePath {
 public:
  using Light = NaiveLight;
  using Scattering = NaiveMueller;
  using Transmittance = NaiveMueller;

  NaivePath() { begin(); }

  void begin() {
    for (auto& channel : importance_.value) channel = NaiveMatrix(1.0f);
    importance_.frame = exit_ = no_frame();
    readings_.fill(glm::vec4(0.0f));
    throughput_ = Rgb(1.0f);
  }
  void deposit(const Light& light) {
    begin_at(light.frame());
    const auto reading = importance_ * static_cast<const NaiveStokes&>(light);
    for (std::size_t i = 0; i < naive::channels; ++i) readings_[i] += reading[i];
  }
  void scatter(const Scattering& f) {
    begin_at(f.exit);
    const NaiveFrame before = importance_.frame;
    importance_ = importance_ * static_cast<const NaiveMuellerBase&>(f);
    importance_.frame = given(f.enter, before);
    throughput_ *= f.m00();
  }
  void attenuate(const Rgb& transmittance) {
    scatter(Scattering::plain(transmittance, importance_.frame));
  }
  void transmit(const Transmittance& t) { scatter(t); }

  static constexpr bool reads_polarization() { return true; }
  /// As the other families have it, so that all of them take the same paths.
  const Rgb& throughput() const { return throughput_; }

  Light result() const {
    Light light;
    light.value = readings_;
    light.NaiveStokes::frame = exit_;
    return light;
  }

 private:
  /// The readings are those of the first frame met.
  void begin_at(const NaiveFrame& frame) {
    if (is_given(importance_.frame)) return;
    importance_.frame = frame;
    if (!is_given(exit_)) exit_ = frame;
  }

  NaiveImportance importance_;
  naive::Readings<float> readings_;
  NaiveFrame exit_;
  Rgb throughput_;
};

/// In media a flight is a matrix even where nothing attenuates.
class NaiveMediaPath : public NaivePath {
 public:
  NaiveMediaPath() { begin(); }

  void begin() {
    NaivePath::begin();
    has_flown_ = false;
  }
  void deposit(const Light& light) {
    arrive();
    NaivePath::deposit(light);
  }
  void scatter(const Scattering& f) {
    arrive();
    NaivePath::scatter(f);
    has_flown_ = false;
  }
  void attenuate(const Rgb& transmittance) {
    NaivePath::attenuate(transmittance);
    has_flown_ = true;
  }
  void transmit(const Transmittance& t) {
    NaivePath::transmit(t);
    has_flown_ = true;
  }

 private:
  void arrive() {
    if (!has_flown_) attenuate(Rgb(1.0f));
  }

  bool has_flown_ = false;
};

struct Naive {
  using Value = Rgb;
  using Light = NaiveLight;
  using Scattering = NaiveMueller;
  using Transmittance = NaiveMueller;
  using Importance = NaiveImportance;
  using CameraPath = NaivePath;
  using MediaPath = NaiveMediaPath;
  static constexpr bool polarized = true;
  static constexpr bool defers = false;

  static Light unpolarized(const Rgb& radiance) { return Light::unpolarized(radiance); }
  static Scattering depolarizer(const Rgb& m00) { return Scattering::depolarizing(m00); }
  static Scattering plain(const Rgb& a) { return Scattering::plain(a, no_frame()); }
  static Light scatter(const Scattering& f, const Light& light, bool = true) {
    return scatter_naively(f, light);
  }
  /// Whole vectors and matrices are made of everything.
  static bool is_unpolarized(const Light&) { return false; }
  static Rgb intensity(const Light& light) { return light.intensity(); }
  static Light transmit(const Transmittance& t, const Light& light) {
    return scatter_naively(t, light);
  }
  static Rgb m00(const Scattering& f) { return f.m00(); }
  static Importance importance(const Rgb& w, const NaiveFrame& frame) {
    Importance result;
    for (std::size_t i = 0; i < naive::channels; ++i) result.value[i] = NaiveMatrix(w[i]);
    result.frame = frame;
    return result;
  }
  static malus::Measurement<Rgb> measure(const Importance& w, const Light& light) {
    return malus::Measurement<Rgb>::from_vec4(w * static_cast<const NaiveStokes&>(light));
  }
};

}  // namespace variants
