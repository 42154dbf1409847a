// SPDX-License-Identifier: MIT
// The tables of forms at compile time: neutral elements, absorbing elements, symmetry, and what
// makers give by type.
#include <array>

#include <malus/malus.hpp>

namespace {

using namespace malus;
using enum MuellerForm;

constexpr std::array forms = {
    zero, plain, partial, depolarizing, depolarizing_enter, depolarizing_exit, block, full};

/// A law of all pairs of forms.
template <class Law>
constexpr bool for_all_pairs(Law law) {
  for (const MuellerForm n : forms)
    for (const MuellerForm m : forms)
      if (!law(n, m)) return false;
  return true;
}
template <class Law>
constexpr bool for_all_triples(Law law) {
  return for_all_pairs([&](MuellerForm a, MuellerForm b) {
    for (const MuellerForm c : forms)
      if (!law(a, b, c)) return false;
    return true;
  });
}

static_assert(for_all_pairs([](MuellerForm n, MuellerForm m) {
  return product_form(zero, m, true) == zero && product_form(n, zero, true) == zero &&
         sum_form(zero, m, true) == m && sum_form(n, zero, true) == n &&
         product_form(plain, m, false) == m && product_form(n, plain, false) == n;
}));

static_assert(for_all_pairs([](MuellerForm a, MuellerForm b) {
  return sum_form(a, b, true) == sum_form(b, a, true) &&
         sum_form(a, b, false) == sum_form(b, a, false);
}));

// (N M)ᵀ = Mᵀ Nᵀ, (M + N)ᵀ = Mᵀ + Nᵀ.
static_assert(for_all_pairs([](MuellerForm n, MuellerForm m) {
  return adjoint_form(product_form(n, m, false)) ==
             product_form(adjoint_form(m), adjoint_form(n), false) &&
         adjoint_form(sum_form(n, m, false)) == sum_form(adjoint_form(n), adjoint_form(m), false);
}));

static_assert(for_all_triples([](MuellerForm a, MuellerForm b, MuellerForm c) {
  return product_form(product_form(a, b, true), c, true) ==
             product_form(a, product_form(b, c, true), true) &&
         sum_form(sum_form(a, b, true), c, true) == sum_form(a, sum_form(b, c, true), true);
}));

static_assert(for_all_pairs([](MuellerForm n, MuellerForm m) {
  return product_form(n, dynamic, true) == dynamic && sum_form(dynamic, m, true) == dynamic;
}));

// Of two blocks only the coincidence of frames decides.
static_assert(product_form(block, block, true) == block &&
              product_form(block, block, false) == full);
static_assert(sum_form(block, block, true) == block && sum_form(block, block, false) == full);

}  // namespace
