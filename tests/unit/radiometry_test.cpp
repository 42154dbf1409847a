// SPDX-License-Identifier: MIT
// The two families give one integrator two meanings: intensities alone, or polarised light whose
// intensity agrees with them wherever nothing polarises.
#include <doctest/doctest.h>

#include <array>
#include <concepts>

#include <malus/equality.hpp>
#include <malus/optics/polarizer.hpp>
#include <malus/optics/rotator.hpp>
#include <malus/radiometry.hpp>

#include "unit/optics_support.hpp"

namespace {

using namespace optics_test;
using Four = std::array<double, 4>;

template <class R, class V>
concept Radiometry = requires(typename R::Light light, typename R::Scattering f, V v,
                              typename R::CameraPath path, malus::Frame<malus::scalar_t<V>> frame) {
  requires std::same_as<typename R::Value, V>;
  requires std::same_as<typename R::CameraPath::Light, typename R::Light>;
  requires std::same_as<typename R::CameraPath::Scattering, typename R::Scattering>;
  requires std::same_as<decltype(R::polarized), const bool>;
  { R::unpolarized(v) } -> std::same_as<typename R::Light>;
  { R::scatter(f, light) } -> std::convertible_to<typename R::Light>;
  { R::depolarizer(v) } -> std::convertible_to<typename R::Scattering>;
  { R::plain(v) } -> std::same_as<typename R::Scattering>;
  { light* v } -> std::convertible_to<typename R::Light>;
  { f* v } -> std::convertible_to<typename R::Scattering>;
  { R::m00(f) } -> std::convertible_to<V>;
  { R::importance(v, frame) } -> std::same_as<typename R::Importance>;
  { R::measure(R::importance(v, frame), light) } -> std::same_as<malus::Measurement<V>>;
  path.begin();
  path.deposit(light);
  path.scatter(f);
  { path.throughput() } -> std::convertible_to<V>;
  { path.result() } -> std::convertible_to<typename R::Light>;
};
static_assert(Radiometry<malus::Unpolarized<malus::Rgb>, malus::Rgb>);
static_assert(Radiometry<malus::Polarized<malus::Rgb>, malus::Rgb>);
static_assert(Radiometry<malus::Unpolarized<double>, double>);
static_assert(Radiometry<malus::Polarized<double>, double>);
static_assert(!malus::Unpolarized<malus::Rgb>::polarized &&
              malus::Polarized<malus::Rgb>::polarized);
static_assert(sizeof(malus::Unpolarized<float>::Light) == sizeof(float));

/// A path of two diffuse vertices seen through a grey filter, with a lamp seen from both, written
/// once.
template <class R>
malus::Measurement<double> two_bounces(const malus::Frame<double>& sensor) {
  typename R::CameraPath path;
  path.begin();
  path.scatter(R::plain(0.5));
  path.deposit(R::scatter(R::depolarizer(0.5), R::unpolarized(3)));
  path.scatter(R::depolarizer(0.5));
  path.deposit(R::scatter(R::depolarizer(0.25) * 2.0, R::unpolarized(4)) * 0.25);
  return R::measure(R::importance(1, sensor), path.result());
}

}  // namespace

TEST_CASE("one integrator reads the same intensity in both families where nothing polarises") {
  Random random(100);
  const auto sensor = random.frame();
  const Four expected{0.5 * (1.5 + 0.5 * 0.5), 0, 0, 0};
  CHECK(deviation_of_four(two_bounces<malus::Unpolarized<double>>(sensor), expected) == 0);
  CHECK(deviation_of_four(two_bounces<malus::Polarized<double>>(sensor), expected) == 0);
}

TEST_CASE("a polarised measurement is the four components in the sensor's frame") {
  Random random(101);
  using R = malus::Polarized<double>;
  for (int i = 0; i < 100; ++i) {
    const auto frame = random.frame();
    const malus::Stokes<double> light(1, 0.3, -0.2, 0.5, frame.turned(random.between(0, 6)));
    const auto expected = light.expressed_in(frame);
    const Four four{2 * expected[0], 2 * expected[1], 2 * expected[2], 2 * expected[3]};
    CHECK(deviation_of_four(R::measure(R::importance(2, frame), light), four) <= 1e-14);
  }
}

TEST_CASE(
    "polarised scattering is scattering of light that propagated, in the forms it is made in") {
  Random random(102);
  using R = malus::Polarized<Double3>;
  const auto frame = random.frame();
  const R::Scattering f = malus::rotator(Double3(0.5), Double3(0.2, 0.3, 0.4), frame);
  const R::Light light(Double3(1), Double3(0.5), Double3(0), Double3(0.1), frame);
  CHECK(malus::is_close(R::scatter(f, light), f * malus::propagate(light), 1e-15));
  CHECK(R::m00(f) == Double3(0.5));
  CHECK(R::unpolarized(Double3(2)).form() == malus::StokesForm::unpolarized);
  CHECK(R::depolarizer(Double3(2)).form() == malus::MuellerForm::depolarizing);
  CHECK(R::plain(Double3(2)).form() == malus::MuellerForm::plain);
}
