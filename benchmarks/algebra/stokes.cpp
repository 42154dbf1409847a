// SPDX-License-Identifier: MIT
// Rotations of light, and what matrices do to it.
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

template <class T>
void add_rotations() {
  const auto light = inputs::lights<T>(Place::first, 1);
  const auto frame = inputs::frames<T>(Place::first, 3);
  const auto fixed = inputs::as<Light<T, StokesForm::full>>(light);
  const auto flagged = inputs::flagged<Light<T, StokesForm::dynamic>>(fixed);

  std::vector<malus::Rotation<T>> turns;
  std::vector<glm::mat<4, 4, T>> turn_matrices;
  for (std::size_t i = 0; i < light.size(); ++i) {
    turns.push_back(malus::rotation(light[i].frame, frame[i]));
    turn_matrices.push_back(naive::rotation_matrix(light[i].frame, frame[i]));
  }
  const auto turn = inputs::kept(turns);
  const auto matrix = inputs::kept(turn_matrices);
  comparison::add_row<T>(
      "rotate a Stokes vector, coefficients given",
      [=](std::size_t i) { return naive::rotated(light[i], matrix[i], frame[i]); },
      [=](std::size_t i) { return flagged[i].expressed_in(frame[i], turn[i]); },
      [=](std::size_t i) { return fixed[i].expressed_in(frame[i], turn[i]); });
  comparison::add_row<T>(
      "rotate a Stokes vector, coefficients computed",
      [=](std::size_t i) { return naive::expressed_in(light[i], frame[i]); },
      [=](std::size_t i) { return flagged[i].expressed_in(frame[i]); },
      [=](std::size_t i) { return fixed[i].expressed_in(frame[i]); });
}

/// M·S where the frames are known to agree.
template <class T, MuellerForm Form>
void add_product_in_frame(std::string_view name) {
  const auto matrix = inputs::matrices<T>(Place::first, Place::second, 1, Form);
  const auto light = inputs::lights<T>(Place::first, 5);
  const auto fixed = inputs::as<Scatter<T, Form, Shared<T>>>(matrix);
  const auto flagged = inputs::flagged<Scatter<T, MuellerForm::dynamic, Shared<T>>>(fixed);
  const auto fixed_light = inputs::as<Light<T, StokesForm::full, Shared<T>>>(light);
  const auto flagged_light = inputs::flagged<Light<T, StokesForm::dynamic, Shared<T>>>(fixed_light);
  comparison::add_row<T>(
      name, [=](std::size_t i) { return naive::apply_in_frame(matrix[i], light[i]); },
      [=](std::size_t i) { return flagged[i] * flagged_light[i]; },
      [=](std::size_t i) { return fixed[i] * fixed_light[i]; });
}

/// M·S with run-time frames.
template <class T, MuellerForm Form>
void add_product(std::string_view name) {
  const auto matrix = inputs::matrices<T>(Place::first, Place::second, 1, Form);
  // A collinear matrix has no frames: the naive one has one frame, twice, and is given light in it.
  const auto random_light = inputs::lights<T>(Place::first, 5);
  std::vector<naive::Stokes<T>> fitting(random_light.begin(), random_light.end());
  if (malus::is_collinear(Form))
    for (std::size_t i = 0; i < fitting.size(); ++i) fitting[i].frame = matrix[i].enter;
  const auto light = inputs::kept(fitting);
  const auto fixed = inputs::as<Scatter<T, Form>>(matrix);
  const auto flagged = inputs::flagged<Scatter<T, MuellerForm::dynamic>>(fixed);
  const auto fixed_light = inputs::as<Light<T, StokesForm::full>>(light);
  const auto flagged_light = inputs::flagged<Light<T, StokesForm::dynamic>>(fixed_light);
  comparison::add_row<T>(
      name, [=](std::size_t i) { return matrix[i] * light[i]; },
      [=](std::size_t i) { return flagged[i] * flagged_light[i]; },
      [=](std::size_t i) { return fixed[i] * fixed_light[i]; });
}

/// Into the block's enter frame, through it, and from its exit frame into a given one.
template <class T>
void add_product_in_both_frames() {
  const auto matrix = inputs::matrices<T>(Place::first, Place::second, 1, MuellerForm::block);
  const auto light = inputs::lights<T>(Place::first, 5);
  const auto frame = inputs::frames<T>(Place::second, 7);
  const auto fixed = inputs::as<Scatter<T, MuellerForm::block>>(matrix);
  const auto flagged = inputs::flagged<Scatter<T, MuellerForm::dynamic>>(fixed);
  const auto fixed_light = inputs::as<Light<T, StokesForm::full>>(light);
  const auto flagged_light = inputs::flagged<Light<T, StokesForm::dynamic>>(fixed_light);
  comparison::add_row<T>(
      "rotate into a block's frame, apply it, rotate out",
      [=](std::size_t i) { return naive::expressed_in(matrix[i] * light[i], frame[i]); },
      [=](std::size_t i) { return (flagged[i] * flagged_light[i]).expressed_in(frame[i]); },
      [=](std::size_t i) { return (fixed[i] * fixed_light[i]).expressed_in(frame[i]); });
}

template <class T>
void add_unpolarized_product() {
  const auto matrix = inputs::matrices<T>(Place::first, Place::second, 1, MuellerForm::block);
  const auto light = inputs::lights<T>(Place::first, 5, StokesForm::unpolarized);
  const auto fixed = inputs::as<Scatter<T, MuellerForm::block>>(matrix);
  const auto flagged = inputs::flagged<Scatter<T, MuellerForm::dynamic>>(fixed);
  const auto fixed_light = inputs::as<Light<T, StokesForm::unpolarized>>(light);
  const auto flagged_light = inputs::flagged<Light<T, StokesForm::dynamic>>(fixed_light);
  comparison::add_row<T>(
      "block × unpolarised light", [=](std::size_t i) { return matrix[i] * light[i]; },
      [=](std::size_t i) { return flagged[i] * flagged_light[i]; },
      [=](std::size_t i) { return fixed[i] * fixed_light[i]; });
}

template <class T>
void add_sums() {
  const auto a = inputs::lights<T>(Place::first, 1), b = inputs::lights<T>(Place::first, 5);
  const auto fixed_a = inputs::as<Light<T, StokesForm::full>>(a);
  const auto fixed_b = inputs::as<Light<T, StokesForm::full>>(b);
  const auto flagged_a = inputs::flagged<Light<T, StokesForm::dynamic>>(fixed_a);
  const auto flagged_b = inputs::flagged<Light<T, StokesForm::dynamic>>(fixed_b);
  comparison::add_row<T>(
      "Stokes + Stokes", [=](std::size_t i) { return a[i] + b[i]; },
      [=](std::size_t i) { return flagged_a[i] + flagged_b[i]; },
      [=](std::size_t i) { return fixed_a[i] + fixed_b[i]; });
  comparison::add_row<T>(
      "inner product of two Stokes vectors",
      [=](std::size_t i) { return naive::inner_product(a[i], b[i]); },
      [=](std::size_t i) { return malus::inner_product(flagged_a[i], flagged_b[i]); },
      [=](std::size_t i) { return malus::inner_product(fixed_a[i], fixed_b[i]); });
}

/// The naive column has no sides: it copies, which is what a change of side may cost at most.
template <class T>
void add_propagation() {
  const auto light = inputs::lights<T>(Place::first, 1);
  const auto fixed = inputs::as<Light<T, StokesForm::full, Moving<T>, exitant>>(light);
  const auto flagged = inputs::flagged<Light<T, StokesForm::dynamic, Moving<T>, exitant>>(fixed);
  comparison::add_row<T>(
      "propagate a Stokes vector", [=](std::size_t i) { return light[i]; },
      [=](std::size_t i) { return malus::propagate(flagged[i]); },
      [=](std::size_t i) { return malus::propagate(fixed[i]); });
}

}  // namespace

template <class T>
void add_stokes_rows() {
  add_rotations<T>();
  add_product_in_frame<T, MuellerForm::block>("Fresnel block × Stokes, one frame");
  add_product_in_frame<T, MuellerForm::full>("full × Stokes, one frame");
  add_product<T, MuellerForm::block>("rotate into a block's frame and apply it");
  add_product_in_both_frames<T>();
  add_unpolarized_product<T>();
  add_product<T, MuellerForm::depolarizing>("depolarizer × Stokes");
  add_product<T, MuellerForm::plain>("plain × Stokes");
  add_product<T, MuellerForm::full>("full × Stokes");
  add_sums<T>();
  add_propagation<T>();
}

template void add_stokes_rows<float>();
template void add_stokes_rows<double>();

}  // namespace operations
