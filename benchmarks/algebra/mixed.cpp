// SPDX-License-Identifier: MIT
// Light through matrices whose forms no branch predictor can foresee. Where forms are types, a
// program has the matrices sorted by form instead: the compile-time column does the same products
// without a flag, in the same mixture, form by form.
#include <cstdint>

#include <malus/product.hpp>

#include "comparison.hpp"
#include "operations.hpp"
#include "types.hpp"

namespace operations {
namespace {

using namespace types;
using inputs::Place;

/// Long enough that the predictor cannot learn the order by heart.
inline constexpr std::size_t draws = std::size_t{1} << 16;

template <class T>
struct Pool {
  std::span<const naive::Stokes<T>> light = inputs::lights<T>(Place::first, 5);
  std::span<const naive::Mueller<T>> naive_matrix[3];
  std::span<const Scatter<T, MuellerForm::block>> block;
  std::span<const Scatter<T, MuellerForm::depolarizing>> depolarizing;
  std::span<const Scatter<T, MuellerForm::full>> full;
  std::span<const Scatter<T, MuellerForm::dynamic>> flagged[3];

  Pool() {
    const MuellerForm forms[] = {MuellerForm::block, MuellerForm::depolarizing, MuellerForm::full};
    for (unsigned k = 0; k < 3; ++k)
      naive_matrix[k] = inputs::matrices<T>(Place::first, Place::second, 10 * k, forms[k]);
    block = inputs::as<Scatter<T, MuellerForm::block>>(naive_matrix[0]);
    depolarizing = inputs::as<Scatter<T, MuellerForm::depolarizing>>(naive_matrix[1]);
    full = inputs::as<Scatter<T, MuellerForm::full>>(naive_matrix[2]);
    flagged[0] = inputs::flagged<Scatter<T, MuellerForm::dynamic>>(block);
    flagged[1] = inputs::flagged<Scatter<T, MuellerForm::dynamic>>(depolarizing);
    flagged[2] = inputs::flagged<Scatter<T, MuellerForm::dynamic>>(full);
  }
};

/// Which matrix is drawn: its form, block, depolarizer or full, of which `others` in all are not
/// blocks.
std::span<const std::uint8_t> drawn_forms(double others) {
  std::mt19937 generator(1);
  std::vector<std::uint8_t> forms(draws);
  for (auto& form : forms) {
    const double u = inputs::random<double>(generator, 0, 1);
    form = u < others / 2 ? 1 : u < others ? 2 : 0;
  }
  return inputs::kept(std::move(forms));
}

template <class T>
void add_mixture(std::string_view name, double others) {
  static const Pool<T> pool;
  // Few enough of each form that all stay in the first-level cache.
  constexpr std::size_t mask = inputs::count<T> / 2 - 1;
  const auto fixed_light = inputs::as<Light<T, StokesForm::full>>(pool.light);
  const auto flagged_light = inputs::flagged<Light<T, StokesForm::dynamic>>(fixed_light);
  const auto order = drawn_forms(others);

  const std::string row = std::string(comparison::precision<T>) + "/" + std::string(name);
  const auto naive = [=](std::size_t i) {
    return pool.naive_matrix[order[i]][i & mask] * pool.light[i & mask];
  };
  const auto run_time = [=](std::size_t i) {
    return pool.flagged[order[i]][i & mask] * flagged_light[i & mask];
  };
  comparison::row_order().push_back(row);
  comparison::check_agreement(row, draws, run_time, naive);
  comparison::add_column(row, comparison::naive_column, draws, naive);
  comparison::add_column(row, comparison::run_time_column, draws, run_time);

  std::size_t share[3] = {};
  for (const auto form : order) ++share[form];
  benchmark::RegisterBenchmark(
      (row + "/" + comparison::compile_time_column).c_str(), [=](benchmark::State& state) {
        const auto all_of = [&](const auto& matrices, std::size_t n) {
          for (std::size_t i = 0; i < n; ++i) {
            alignas(1024) const auto result = matrices[i & mask] * fixed_light[i & mask];
            benchmark::DoNotOptimize(&result);
          }
        };
        while (state.KeepRunningBatch(static_cast<benchmark::IterationCount>(draws))) {
          all_of(pool.block, share[0]);
          all_of(pool.depolarizing, share[1]);
          all_of(pool.full, share[2]);
        }
      });
}

}  // namespace

template <class T>
void add_mixed_rows() {
  add_mixture<T>("block × Stokes, 5 % of other forms", 0.05);
  add_mixture<T>("block, depolarizer, full × Stokes at random", 2.0 / 3);
}

template void add_mixed_rows<float>();
template void add_mixed_rows<double>();

}  // namespace operations
