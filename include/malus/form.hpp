// SPDX-License-Identifier: MIT
// Forms: which of its components a Stokes vector, Mueller matrix or importance can have non-zero,
// and so which are stored, computed and rotated (paper, section 5.5, "differentiating edge cases",
// and a block form for mirror-symmetric matrices).
//
// A form is a template argument where its maker knows it, and a flag (`dynamic`) where it is known
// only at run time. The tables below serve both. Nothing behind a flag is initialised, read or
// rotated.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <malus/config.hpp>

namespace malus {

enum class StokesForm : std::uint8_t {
  zero,         ///< nothing: the neutral element of addition
  unpolarized,  ///< S0; no frame
  full,         ///< S0…S3; a frame
  dynamic,      ///< one of the above, by a flag
};

enum class MuellerForm : std::uint8_t {
  zero,     ///< nothing; no frames
  plain,    ///< a·I, collinear: clear media, absorbers; no frames
  partial,  ///< diag(a, b, b, b), collinear: a partial depolarizer; no frames. Sums of plain and
            ///< depolarizing
  depolarizing,        ///< m00 alone: diffuse surfaces; no frames
  depolarizing_enter,  ///< the first column, M·D: what enters is depolarised; exit frame
  depolarizing_exit,   ///< the first row, D·M: what leaves is depolarised; enter frame
  block,    ///< two 2×2 blocks, mirror-symmetric: Fresnel, microfacets, Rayleigh, Mie; both frames
  full,     ///< all 16; both frames
  dynamic,  ///< one of the above, by a flag
};

enum class ImportanceForm : std::uint8_t {
  zero,          ///< nothing; no frame
  plain,         ///< w·I; a frame
  depolarizing,  ///< the first column: measures S0 alone; no frame
  full,          ///< all 16; a frame
  dynamic,       ///< one of the above, by a flag
};

inline constexpr std::size_t stokes_forms = 3, mueller_forms = 8, importance_forms = 4;

// What a form stores

constexpr std::size_t value_count(StokesForm f) {
  constexpr std::size_t count[] = {0, 1, 4, 4};
  return count[static_cast<std::size_t>(f)];
}
constexpr std::size_t value_count(MuellerForm f) {
  constexpr std::size_t count[] = {0, 1, 2, 1, 4, 4, 8, 16, 16};
  return count[static_cast<std::size_t>(f)];
}
constexpr std::size_t value_count(ImportanceForm f) {
  constexpr std::size_t count[] = {0, 1, 4, 16, 16};
  return count[static_cast<std::size_t>(f)];
}

constexpr bool needs_frame(StokesForm f) { return f >= StokesForm::full; }
constexpr bool needs_frame(ImportanceForm f) {
  return f == ImportanceForm::plain || f >= ImportanceForm::full;
}
constexpr bool needs_enter_frame(MuellerForm f) {
  return f == MuellerForm::depolarizing_exit || f >= MuellerForm::block;
}
constexpr bool needs_exit_frame(MuellerForm f) {
  return f == MuellerForm::depolarizing_enter || f >= MuellerForm::block;
}
/// Leaves direction and frame of light as they were.
constexpr bool is_collinear(MuellerForm f) {
  return f == MuellerForm::plain || f == MuellerForm::partial;
}

// The multiplication table

/// The form of N·M. `coincident`: N's enter frame is M's exit frame up to quarter turns; only then
/// do two blocks make a block.
constexpr MuellerForm product_form(MuellerForm n, MuellerForm m, bool coincident) {
  using enum MuellerForm;
  constexpr MuellerForm enter = depolarizing_enter, exit = depolarizing_exit, depol = depolarizing;
  // clang-format off
  constexpr MuellerForm table[mueller_forms][mueller_forms] = {
      // N \ M      zero  plain    partial  depol  enter  exit  block  full
      /* zero    */ {zero, zero,    zero,    zero,  zero,  zero, zero,  zero},
      /* plain   */ {zero, plain,   partial, depol, enter, exit, block, full},
      /* partial */ {zero, partial, partial, depol, enter, exit, block, full},
      /* depol   */ {zero, depol,   depol,   depol, depol, exit, exit,  exit},
      /* enter   */ {zero, enter,   enter,   enter, enter, full, full,  full},
      /* exit    */ {zero, exit,    exit,    depol, depol, exit, exit,  exit},
      /* block   */ {zero, block,   block,   enter, enter, full, block, full},
      /* full    */ {zero, full,    full,    enter, enter, full, full,  full},
  };
  // clang-format on
  if (n == dynamic || m == dynamic) return dynamic;
  const MuellerForm product = table[static_cast<std::size_t>(n)][static_cast<std::size_t>(m)];
  return product == block && n == block && m == block && !coincident ? full : product;
}

/// The form of M·S.
constexpr StokesForm product_form(MuellerForm m, StokesForm s) {
  using enum MuellerForm;
  if (m == dynamic || s == StokesForm::dynamic) return StokesForm::dynamic;
  if (m == zero || s == StokesForm::zero) return StokesForm::zero;
  if (m == depolarizing || m == depolarizing_exit) return StokesForm::unpolarized;
  if (is_collinear(m)) return s;
  return StokesForm::full;
}

/// The form of the row wᵀ·M: that of Mᵀ·w.
constexpr StokesForm row_product_form(StokesForm w, MuellerForm m) {
  using enum MuellerForm;
  if (m == depolarizing_enter) return product_form(depolarizing_exit, w);
  if (m == depolarizing_exit) return product_form(depolarizing_enter, w);
  return product_form(m, w);
}

/// The form of Wᵀ·M.
constexpr ImportanceForm product_form(ImportanceForm w, MuellerForm m) {
  using enum MuellerForm;
  if (w == ImportanceForm::dynamic || m == dynamic) return ImportanceForm::dynamic;
  if (w == ImportanceForm::zero || m == zero) return ImportanceForm::zero;
  if (m == depolarizing || m == depolarizing_enter) return ImportanceForm::depolarizing;
  if (m == plain || (m == partial && w == ImportanceForm::depolarizing)) return w;
  return ImportanceForm::full;
}

// The addition tables

constexpr StokesForm sum_form(StokesForm a, StokesForm b) { return a < b ? b : a; }

/// The form of M + N. `coincident`: the frames of both agree up to quarter turns (for plain and
/// partial ones: the enter and exit frame of the other); only then do two blocks make a block.
constexpr MuellerForm sum_form(MuellerForm a, MuellerForm b, bool coincident) {
  using enum MuellerForm;
  constexpr MuellerForm enter = depolarizing_enter, exit = depolarizing_exit, depol = depolarizing;
  // clang-format off
  constexpr MuellerForm table[mueller_forms][mueller_forms] = {
      // M \ N       zero    plain    partial  depol    enter  exit  block  full
      /* zero    */ {zero,    plain,   partial, depol,   enter, exit, block, full},
      /* plain   */ {plain,   plain,   partial, partial, full,  full, block, full},
      /* partial */ {partial, partial, partial, partial, full,  full, block, full},
      /* depol   */ {depol,   partial, partial, depol,   enter, exit, block, full},
      /* enter   */ {enter,   full,    full,    enter,   enter, full, full,  full},
      /* exit    */ {exit,    full,    full,    exit,    full,  exit, full,  full},
      /* block   */ {block,   block,   block,   block,   full,  full, block, full},
      /* full    */ {full,    full,    full,    full,    full,  full, full,  full},
  };
  // clang-format on
  if (a == dynamic || b == dynamic) return dynamic;
  const MuellerForm sum = table[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)];
  const bool frames_meet = a != zero && b != zero && a != depol && b != depol;
  return sum == block && frames_meet && !coincident ? full : sum;
}

constexpr ImportanceForm sum_form(ImportanceForm a, ImportanceForm b, bool coincident) {
  using enum ImportanceForm;
  if (a == dynamic || b == dynamic) return dynamic;
  if (a == zero) return b;
  if (b == zero) return a;
  if (a == b && (a != plain || coincident)) return a;
  return full;
}

/// The form of the adjoint Mᵀ: enter and exit exchanged.
constexpr MuellerForm adjoint_form(MuellerForm m) {
  if (m == MuellerForm::depolarizing_enter) return MuellerForm::depolarizing_exit;
  if (m == MuellerForm::depolarizing_exit) return MuellerForm::depolarizing_enter;
  return m;
}

// Where a form keeps component (row, column)

namespace detail {

/// The place of component (r, c) among a form's values, or −1 where the component is zero by form.
constexpr int slot(MuellerForm f, int r, int c) {
  using enum MuellerForm;
  switch (f) {
    case zero:
      return -1;
    case plain:
      return r == c ? 0 : -1;
    case partial:
      return r != c ? -1 : r == 0 ? 0 : 1;
    case depolarizing:
      return r == 0 && c == 0 ? 0 : -1;
    case depolarizing_enter:
      return c == 0 ? r : -1;
    case depolarizing_exit:
      return r == 0 ? c : -1;
    case block:
      return r / 2 == c / 2 ? 4 * (r / 2) + 2 * (r % 2) + c % 2 : -1;
    default:
      return 4 * r + c;
  }
}
constexpr int slot(ImportanceForm f, int r, int c) {
  using enum ImportanceForm;
  switch (f) {
    case zero:
      return -1;
    case plain:
      return slot(MuellerForm::plain, r, c);
    case depolarizing:
      return slot(MuellerForm::depolarizing_enter, r, c);
    default:
      return 4 * r + c;
  }
}
constexpr int slot(StokesForm f, int r) {
  if (f == StokesForm::zero) return -1;
  return f == StokesForm::unpolarized && r > 0 ? -1 : r;
}

template <auto Form>
using FormConstant = std::integral_constant<decltype(Form), Form>;

/// Calls f with the form as a compile-time constant.
template <class F>
MALUS_INLINE constexpr decltype(auto) with_form(StokesForm form, F&& f) {
  switch (form) {
    case StokesForm::zero:
      return f(FormConstant<StokesForm::zero>{});
    case StokesForm::unpolarized:
      return f(FormConstant<StokesForm::unpolarized>{});
    default:
      return f(FormConstant<StokesForm::full>{});
  }
}
template <class F>
MALUS_INLINE constexpr decltype(auto) with_form(MuellerForm form, F&& f) {
  using enum MuellerForm;
  switch (form) {
    case zero:
      return f(FormConstant<zero>{});
    case plain:
      return f(FormConstant<plain>{});
    case partial:
      return f(FormConstant<partial>{});
    case depolarizing:
      return f(FormConstant<depolarizing>{});
    case depolarizing_enter:
      return f(FormConstant<depolarizing_enter>{});
    case depolarizing_exit:
      return f(FormConstant<depolarizing_exit>{});
    case block:
      return f(FormConstant<block>{});
    default:
      return f(FormConstant<full>{});
  }
}
template <class F>
MALUS_INLINE constexpr decltype(auto) with_form(ImportanceForm form, F&& f) {
  using enum ImportanceForm;
  switch (form) {
    case zero:
      return f(FormConstant<zero>{});
    case plain:
      return f(FormConstant<plain>{});
    case depolarizing:
      return f(FormConstant<depolarizing>{});
    default:
      return f(FormConstant<full>{});
  }
}

/// A form that is a template argument takes no storage; `dynamic` is one byte.
template <auto Form>
struct FormFlag {
  constexpr FormFlag() = default;
  constexpr explicit FormFlag(decltype(Form)) {}
  static constexpr auto value() { return Form; }
};
template <auto Form>
  requires(Form == decltype(Form)::dynamic)
struct FormFlag<Form> {
  decltype(Form) flag = decltype(Form)::zero;
  constexpr FormFlag() = default;
  constexpr explicit FormFlag(decltype(Form) f) : flag(f) {}
  constexpr auto value() const { return flag; }
};

}  // namespace detail
}  // namespace malus
