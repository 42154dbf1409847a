// SPDX-License-Identifier: MIT
// Products, sums, adjoints and scalings of Mueller matrices.
#include <malus/adjoint.hpp>
#include <malus/product.hpp>
#include <malus/propagate.hpp>
#include <malus/sum.hpp>

#include "comparison.hpp"
#include "operations.hpp"
#include "types.hpp"

namespace operations {
namespace {

using namespace types;
using inputs::Place;

/// N·M where N's enter frame is known to be M's exit frame.
template <class T, MuellerForm Form>
void add_product_in_frame(std::string_view name) {
  const auto m = inputs::matrices<T>(Place::first, Place::second, 1, Form);
  const auto n = inputs::matrices<T>(Place::second, Place::third, 5, Form);
  const auto fixed_m = inputs::as<Scatter<T, Form, Shared<T>>>(m);
  const auto fixed_n = inputs::as<Transmit<T, Form, Shared<T>>>(n);
  const auto flagged_m = inputs::flagged<Scatter<T, MuellerForm::dynamic, Shared<T>>>(fixed_m);
  const auto flagged_n = inputs::flagged<Transmit<T, MuellerForm::dynamic, Shared<T>>>(fixed_n);
  comparison::add_row<T>(
      name, [=](std::size_t i) { return naive::multiply_in_frame(n[i], m[i]); },
      [=](std::size_t i) { return flagged_n[i] * flagged_m[i]; },
      [=](std::size_t i) { return fixed_n[i] * fixed_m[i]; });
}

/// N·M with run-time frames.
template <class T, MuellerForm N, MuellerForm M>
void add_product(std::string_view name) {
  const auto m = inputs::matrices<T>(Place::first, Place::second, 1, M);
  const auto n = inputs::matrices<T>(Place::second, Place::third, 5, N);
  const auto fixed_m = inputs::as<Scatter<T, M>>(m);
  const auto fixed_n = inputs::as<Transmit<T, N>>(n);
  const auto flagged_m = inputs::flagged<Scatter<T, MuellerForm::dynamic>>(fixed_m);
  const auto flagged_n = inputs::flagged<Transmit<T, MuellerForm::dynamic>>(fixed_n);
  comparison::add_row<T>(
      name, [=](std::size_t i) { return n[i] * m[i]; },
      [=](std::size_t i) { return flagged_n[i] * flagged_m[i]; },
      [=](std::size_t i) { return fixed_n[i] * fixed_m[i]; });
}

template <class T, MuellerForm A, MuellerForm B>
void add_sum(std::string_view name) {
  const auto a = inputs::matrices<T>(Place::first, Place::second, 1, A);
  const auto b = inputs::matrices<T>(Place::first, Place::second, 5, B);
  const auto fixed_a = inputs::as<Scatter<T, A>>(a);
  const auto fixed_b = inputs::as<Scatter<T, B>>(b);
  const auto flagged_a = inputs::flagged<Scatter<T, MuellerForm::dynamic>>(fixed_a);
  const auto flagged_b = inputs::flagged<Scatter<T, MuellerForm::dynamic>>(fixed_b);
  comparison::add_row<T>(
      name, [=](std::size_t i) { return a[i] + b[i]; },
      [=](std::size_t i) { return flagged_a[i] + flagged_b[i]; },
      [=](std::size_t i) { return fixed_a[i] + fixed_b[i]; });
}

/// What concerns one matrix. The naive column of propagate is a copy: it has no sides.
template <class T, MuellerForm Form>
void add_unary(const std::string& name) {
  const auto m = inputs::matrices<T>(Place::first, Place::second, 1, Form);
  const auto k = inputs::values<T>(5);
  const auto fixed = inputs::as<Scatter<T, Form>>(m);
  const auto flagged = inputs::flagged<Scatter<T, MuellerForm::dynamic>>(fixed);
  std::vector<inputs::Rgb<T>> factors;
  for (const auto& x : k) factors.push_back(inputs::spectrum<T>(x));
  const auto factor = inputs::kept(factors);
  comparison::add_row<T>(
      "adjoint of a " + name, [=](std::size_t i) { return naive::adjoint(m[i]); },
      [=](std::size_t i) { return malus::adjoint(flagged[i]); },
      [=](std::size_t i) { return malus::adjoint(fixed[i]); });
  comparison::add_row<T>(
      "scale a " + name, [=](std::size_t i) { return m[i] * k[i]; },
      [=](std::size_t i) { return flagged[i] * factor[i]; },
      [=](std::size_t i) { return fixed[i] * factor[i]; });
  comparison::add_row<T>(
      "propagate a " + name, [=](std::size_t i) { return m[i]; },
      [=](std::size_t i) { return malus::propagate(flagged[i]); },
      [=](std::size_t i) { return malus::propagate(fixed[i]); });
}

}  // namespace

template <class T>
void add_mueller_rows() {
  add_product_in_frame<T, MuellerForm::full>("full × full, one frame");
  add_product_in_frame<T, MuellerForm::block>("block × block, one frame");
  add_product<T, MuellerForm::full, MuellerForm::full>("full × full");
  add_product<T, MuellerForm::full, MuellerForm::block>("full × block");
  add_product<T, MuellerForm::block, MuellerForm::block>("block × block");
  add_product<T, MuellerForm::depolarizing, MuellerForm::block>("depolarizer × block");
  add_product<T, MuellerForm::depolarizing, MuellerForm::depolarizing>("depolarizer × depolarizer");
  add_sum<T, MuellerForm::full, MuellerForm::full>("full + full");
  add_sum<T, MuellerForm::block, MuellerForm::block>("block + block");
  add_sum<T, MuellerForm::depolarizing, MuellerForm::depolarizing>("depolarizer + depolarizer");
  add_unary<T, MuellerForm::full>("full matrix");
  add_unary<T, MuellerForm::depolarizing>("depolarizer");
}

template void add_mueller_rows<float>();
template void add_mueller_rows<double>();

}  // namespace operations
