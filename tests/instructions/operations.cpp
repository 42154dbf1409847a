// SPDX-License-Identifier: MIT
// The operations that renderers spend their time in, each in a function of its own, over operands
// that the compiler knows nothing about. Under callgrind the functions' instructions are counted
// (compare.sh); by itself this program only checks that it runs.
#include <malus/deferred_sweep.hpp>
#include <malus/optics/fresnel.hpp>
#include <malus/path_sweep.hpp>
#include <malus/product.hpp>
#include <malus/propagate.hpp>

#include "types.hpp"

namespace {

using namespace types;
using inputs::Place;
using Value = inputs::Rgb<float>;

struct Operands {
  std::span<const naive::Stokes<float>> naive_light = inputs::lights<float>(Place::first, 5);
  std::span<const naive::Mueller<float>> naive_block =
      inputs::matrices<float>(Place::first, Place::second, 1, MuellerForm::block);
  std::span<const naive::Mueller<float>> naive_full =
      inputs::matrices<float>(Place::first, Place::second, 1, MuellerForm::full);

  std::span<const malus::Frame<float>> frame = inputs::frames<float>(Place::first, 3);
  std::span<const malus::Frame<float>> turned_frame = inputs::frames<float>(Place::first, 8);
  std::span<const malus::Frame<float>> next_frame = inputs::frames<float>(Place::second, 7);
  std::span<const Light<float, StokesForm::full>> light =
      inputs::as<Light<float, StokesForm::full>>(naive_light);
  std::span<const Light<float, StokesForm::dynamic>> flagged_light =
      inputs::flagged<Light<float, StokesForm::dynamic>>(light);
  std::span<const Scatter<float, MuellerForm::block>> block =
      inputs::as<Scatter<float, MuellerForm::block>>(naive_block);
  std::span<const Scatter<float, MuellerForm::full>> full =
      inputs::as<Scatter<float, MuellerForm::full>>(naive_full);
  std::span<const Transmit<float, MuellerForm::full>> next_full =
      inputs::as<Transmit<float, MuellerForm::full>>(
          inputs::matrices<float>(Place::second, Place::third, 5, MuellerForm::full));
  std::span<const Scatter<float, MuellerForm::dynamic>> flagged_full =
      inputs::flagged<Scatter<float, MuellerForm::dynamic>>(full);
  std::span<const Transmit<float, MuellerForm::dynamic>> flagged_next_full =
      inputs::flagged<Transmit<float, MuellerForm::dynamic>>(next_full);
  std::span<const Weight<float, ImportanceForm::full>> weight =
      inputs::as<Weight<float, ImportanceForm::full>>(
          inputs::importances<float>(Place::second, 1, ImportanceForm::full));
  std::span<const naive::Value<float>> numbers = inputs::values<float>(9);
};

/// The result is in memory, as a renderer would store it.
template <class Operation>
[[gnu::always_inline]] inline void over_all(const Operation& operation) {
  for (std::size_t i = 0; i < inputs::count<float>; ++i) {
    const auto result = operation(i);
    asm volatile("" : : "r"(&result) : "memory");
  }
}

}  // namespace

// What is counted: compare.sh looks for the namespace.
namespace counted {

#define COUNTED [[gnu::noinline, gnu::used]] void

COUNTED rotate_stokes(const Operands& o) {
  over_all([&](std::size_t i) { return o.light[i].expressed_in(o.frame[i]); });
}
COUNTED block_times_stokes(const Operands& o) {
  over_all([&](std::size_t i) { return o.block[i] * o.light[i]; });
}
COUNTED rotate_block_rotate(const Operands& o) {
  over_all([&](std::size_t i) { return (o.block[i] * o.light[i]).expressed_in(o.next_frame[i]); });
}
COUNTED full_times_stokes(const Operands& o) {
  over_all([&](std::size_t i) { return o.full[i] * o.light[i]; });
}
COUNTED flagged_full_times_stokes(const Operands& o) {
  over_all([&](std::size_t i) { return o.flagged_full[i] * o.flagged_light[i]; });
}
COUNTED full_times_full(const Operands& o) {
  over_all([&](std::size_t i) { return o.next_full[i] * o.full[i]; });
}
COUNTED flagged_full_times_full(const Operands& o) {
  over_all([&](std::size_t i) { return o.flagged_next_full[i] * o.flagged_full[i]; });
}
COUNTED importance_times_block(const Operands& o) {
  over_all([&](std::size_t i) { return o.weight[i] * o.block[i]; });
}
COUNTED importance_times_full(const Operands& o) {
  over_all([&](std::size_t i) { return o.weight[i] * o.full[i]; });
}
COUNTED importance_times_stokes(const Operands& o) {
  over_all([&](std::size_t i) { return (o.weight[i] * o.block[i]) * o.light[i]; });
}
COUNTED dielectric_reflection(const Operands& o) {
  over_all([&](std::size_t i) {
    return malus::dielectric_reflection<Value>(o.numbers[i][0], 1.5F, o.frame[i], o.next_frame[i]);
  });
}
COUNTED conductor_reflection(const Operands& o) {
  over_all([&](std::size_t i) {
    const Value eta(o.numbers[i][0], o.numbers[i][1], o.numbers[i][2]);
    return malus::conductor_reflection(o.numbers[i][1], eta, eta + eta, o.frame[i],
                                       o.next_frame[i]);
  });
}
/// A path of three mirrors that ends in a light.
COUNTED path_sweep(const Operands& o) {
  malus::PathSweep<Value> sweep;
  over_all([&](std::size_t i) {
    sweep.begin();
    // Where the light goes counts for nothing: it goes on straight, its frame turned at each.
    const auto mirror =
        malus::dielectric_reflection<Value>(o.numbers[i][0], 1.5F, o.frame[i], o.turned_frame[i]);
    for (int bounce = 0; bounce < 3; ++bounce) sweep.scatter(mirror);
    sweep.deposit(malus::Stokes<Value, exitant>::unpolarized(Value(1.0F)));
    return sweep.result();
  });
}

/// The same with its mirrors remembered.
COUNTED deferred_sweep(const Operands& o) {
  using Light = malus::Stokes<Value, exitant>;
  using Mirror = decltype(malus::dielectric_reflection<Value>(0.0F, 1.5F, o.frame[0], o.frame[0]));
  malus::DeferredSweep<Value, Mirror> sweep;
  over_all([&](std::size_t i) {
    sweep.begin();
    const auto mirror =
        malus::dielectric_reflection<Value>(o.numbers[i][0], 1.5F, o.frame[i], o.turned_frame[i]);
    for (int bounce = 0; bounce < 3; ++bounce) sweep.scatter() = mirror;
    sweep.deposit(Light::unpolarized(Value(1.0F)));
    return sweep.result([](const Mirror& m, const Light& light, bool) -> Light {
      return m * malus::propagate(light);
    });
  });
}

#undef COUNTED

}  // namespace counted

int main() {
  const Operands operands;
  counted::rotate_stokes(operands);
  counted::block_times_stokes(operands);
  counted::rotate_block_rotate(operands);
  counted::full_times_stokes(operands);
  counted::flagged_full_times_stokes(operands);
  counted::full_times_full(operands);
  counted::flagged_full_times_full(operands);
  counted::importance_times_block(operands);
  counted::importance_times_full(operands);
  counted::importance_times_stokes(operands);
  counted::dielectric_reflection(operands);
  counted::conductor_reflection(operands);
  counted::path_sweep(operands);
  counted::deferred_sweep(operands);
}
