// SPDX-License-Identifier: MIT
// Importance and analyzers before light and matrices.
#include <malus/product.hpp>

#include "comparison.hpp"
#include "operations.hpp"
#include "types.hpp"

namespace operations {
namespace {

using namespace types;
using inputs::Place;

template <class T, ImportanceForm W, MuellerForm M>
void add_product(std::string_view name) {
  const auto w = inputs::importances<T>(Place::second, 1, W);
  const auto m = inputs::matrices<T>(Place::first, Place::second, 5, M);
  const auto fixed_w = inputs::as<Weight<T, W>>(w);
  const auto fixed_m = inputs::as<Scatter<T, M>>(m);
  const auto flagged_w = inputs::flagged<Weight<T, ImportanceForm::dynamic>>(fixed_w);
  const auto flagged_m = inputs::flagged<Scatter<T, MuellerForm::dynamic>>(fixed_m);
  comparison::add_row<T>(
      name, [=](std::size_t i) { return w[i] * m[i]; },
      [=](std::size_t i) { return flagged_w[i] * flagged_m[i]; },
      [=](std::size_t i) { return fixed_w[i] * fixed_m[i]; });
}

template <class T, ImportanceForm W>
void add_reading(std::string_view name) {
  const auto w = inputs::importances<T>(Place::second, 1, W);
  const auto s = inputs::lights<T>(Place::second, 5);
  const auto fixed_w = inputs::as<Weight<T, W>>(w);
  const auto fixed_s = inputs::as<Light<T, StokesForm::full, Moving<T>, exitant>>(s);
  const auto flagged_w = inputs::flagged<Weight<T, ImportanceForm::dynamic>>(fixed_w);
  const auto flagged_s =
      inputs::flagged<Light<T, StokesForm::dynamic, Moving<T>, exitant>>(fixed_s);
  comparison::add_row<T>(
      name, [=](std::size_t i) { return w[i] * s[i]; },
      [=](std::size_t i) { return flagged_w[i] * flagged_s[i]; },
      [=](std::size_t i) { return fixed_w[i] * fixed_s[i]; });
}

template <class T, MuellerForm M>
void add_filter(std::string_view name) {
  const auto row = inputs::lights<T>(Place::second, 1);
  const auto m = inputs::matrices<T>(Place::first, Place::second, 5, M);
  const auto fixed_row = inputs::as<Filter<T, StokesForm::full>>(row);
  const auto fixed_m = inputs::as<Scatter<T, M>>(m);
  const auto flagged_row = inputs::flagged<Filter<T, StokesForm::dynamic>>(fixed_row);
  const auto flagged_m = inputs::flagged<Scatter<T, MuellerForm::dynamic>>(fixed_m);
  comparison::add_row<T>(
      name, [=](std::size_t i) { return naive::filter(row[i], m[i]); },
      [=](std::size_t i) { return flagged_row[i] * flagged_m[i]; },
      [=](std::size_t i) { return fixed_row[i] * fixed_m[i]; });
}

}  // namespace

template <class T>
void add_importance_rows() {
  add_product<T, ImportanceForm::full, MuellerForm::full>("full importance × full");
  add_product<T, ImportanceForm::full, MuellerForm::block>("full importance × block");
  add_product<T, ImportanceForm::plain, MuellerForm::block>("plain importance × block");
  add_reading<T, ImportanceForm::full>("full importance × Stokes");
  add_reading<T, ImportanceForm::plain>("plain importance × Stokes");
  add_filter<T, MuellerForm::full>("analyzer × full");
  add_filter<T, MuellerForm::block>("analyzer × block");
}

template void add_importance_rows<float>();
template void add_importance_rows<double>();

}  // namespace operations
