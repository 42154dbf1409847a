// SPDX-License-Identifier: MIT
// The tables of forms against arithmetic: of generic operands, the product or sum has the zeros and
// equal components of the table's form, and of no narrower one.
#include <doctest/doctest.h>

#include "property/operands.hpp"

using namespace test;

namespace {

/// Generic numbers: no two alike, no accidental zero in a product.
std::vector<double> generic(double seed) {
  std::vector<double> numbers;
  for (int i = 0; i < 16; ++i) numbers.push_back(std::sin(seed + 2.7 * i * i) + 1.5);
  return numbers;
}

/// The narrowest of the forms, given from narrow to wide, whose pattern a matrix has.
template <class Forms>
auto narrowest(const reference::Matrix& m, const Forms& forms) {
  for (const auto form : forms) {
    std::vector<double> drawn;
    for (std::size_t i = 0; i < 16; ++i) drawn.push_back(m[i / 4][i % 4]);
    if (name(form) == "partial") drawn[1] = m[1][1];
    const auto kept = masked_matrix(form, drawn, 0);
    double off = 0;
    for (std::size_t i = 0; i < 16; ++i)
      off = std::max(off, std::abs(kept[i / 4][i % 4] - m[i / 4][i % 4]));
    if (off < 1e-12) return form;
  }
  FAIL("a matrix of no form");
  return forms.back();
}

constexpr std::array narrow_to_wide = {
    MuellerForm::zero,
    MuellerForm::depolarizing,
    MuellerForm::plain,
    MuellerForm::partial,
    MuellerForm::depolarizing_enter,
    MuellerForm::depolarizing_exit,
    MuellerForm::block,
    MuellerForm::full,
};

const reference::Matrix anyhow = reference::rotation(0.3);
const reference::Matrix coincident = reference::rotation(0);

}  // namespace

TEST_CASE("the product's form is the narrowest that holds the product") {
  for (const MuellerForm fn : all_mueller_forms)
    for (const MuellerForm fm : all_mueller_forms) {
      const auto n = masked_matrix(fn, generic(1), 0), m = masked_matrix(fm, generic(2), 0);
      CAPTURE(name(fn));
      CAPTURE(name(fm));
      CHECK(name(malus::product_form(fn, fm, true)) ==
            name(narrowest(n * coincident * m, narrow_to_wide)));
      // Between a collinear matrix and another no frames meet.
      const bool meet = needs_enter_frame(fn) && needs_exit_frame(fm);
      CHECK(name(malus::product_form(fn, fm, false)) ==
            name(narrowest(n * (meet ? anyhow : coincident) * m, narrow_to_wide)));
    }
}

TEST_CASE("the sum's form is the narrowest that holds the sum") {
  for (const MuellerForm fa : all_mueller_forms)
    for (const MuellerForm fb : all_mueller_forms) {
      const auto a = masked_matrix(fa, generic(1), 0), b = masked_matrix(fb, generic(2), 0);
      CAPTURE(name(fa));
      CAPTURE(name(fb));
      CHECK(name(malus::sum_form(fa, fb, true)) == name(narrowest(a + b, narrow_to_wide)));
      // Frames meet where both have some; a collinear matrix has one that turns on its way.
      const auto meets = [](MuellerForm f) {
        return f != MuellerForm::zero && f != MuellerForm::depolarizing;
      };
      auto turned = b;
      if (meets(fa) && meets(fb) && !(is_collinear(fa) && is_collinear(fb))) {
        turned = anyhow * turned;
        if (!is_collinear(fb)) turned = turned * reference::rotation(0.8);
      }
      CHECK(name(malus::sum_form(fa, fb, false)) == name(narrowest(a + turned, narrow_to_wide)));
    }
}

TEST_CASE("the forms of importance are the narrowest that hold products and sums") {
  for (const ImportanceForm fw : all_importance_forms) {
    const auto w = masked_matrix(fw, generic(1), 0);
    for (const MuellerForm fm : all_mueller_forms) {
      CAPTURE(name(fw));
      CAPTURE(name(fm));
      const auto m = masked_matrix(fm, generic(2), 0);
      const bool meet = needs_frame(fw) && needs_exit_frame(fm);
      CHECK(name(malus::product_form(fw, fm)) ==
            name(narrowest(w * (meet ? anyhow : coincident) * m, all_importance_forms)));
    }
    for (const ImportanceForm fv : all_importance_forms) {
      CAPTURE(name(fw));
      CAPTURE(name(fv));
      const auto v = masked_matrix(fv, generic(3), 0);
      CHECK(name(malus::sum_form(fw, fv, true)) == name(narrowest(w + v, all_importance_forms)));
      const bool meet = needs_frame(fw) && needs_frame(fv);
      CHECK(name(malus::sum_form(fw, fv, false)) ==
            name(narrowest(w + v * (meet ? anyhow : coincident), all_importance_forms)));
    }
  }
}

TEST_CASE("a form stores as many values as its pattern has different ones") {
  for (const MuellerForm f : all_mueller_forms) {
    const std::string p = pattern(f);
    std::size_t count = 0;
    for (const char kind : p) count += kind == '*';
    count += p.find('a') != std::string::npos;
    count += p.find('b') != std::string::npos;
    CAPTURE(name(f));
    CHECK(value_count(f) == count);
    for (int i = 0; i < 16; ++i)
      CHECK((malus::detail::slot(f, i / 4, i % 4) >= 0) == (p[static_cast<std::size_t>(i)] != '.'));
  }
}
