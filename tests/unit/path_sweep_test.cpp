// SPDX-License-Identifier: MIT
// The deferred evaluation of a camera path against the importance that is carried along it (paper,
// section 4.4) and against plain 4×4 matrices, over random paths of random forms.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <malus/deferred_sweep.hpp>
#include <malus/importance.hpp>
#include <malus/optics/extinction.hpp>
#include <malus/optics/polarizer.hpp>
#include <malus/optics/rotator.hpp>
#include <malus/path_sweep.hpp>
#include <malus/row_sweep.hpp>

#include "unit/path_sweep_support.hpp"

namespace {

using namespace path_sweep_test;

template <class V, class Sweep = malus::PathSweep<V>>
void check_random_paths(double tolerance, std::size_t lit) {
  Random random(90);
  Sweep sweep;
  for (int trial = 0; trial < 2000; ++trial) {
    CAPTURE(trial);
    const Path path = random_path(random, every_form, lit);
    sweep.begin();
    const auto light = swept<V>(path, sweep);
    const auto result = measured(light, path), expected = carried<V>(path);
    const auto naive = by_matrices(path);
    double apart = 0;
    for (std::size_t c = 0; c < malus::channel_count<V>; ++c) {
      Four e;
      for (std::size_t i = 0; i < 4; ++i)
        e[i] = static_cast<double>(malus::channel(expected[i], c));
      apart = worse(apart, deviation_of_four(result, e, c));
      apart = worse(apart, deviation_of_four(result, naive[c], c));
    }
    CHECK(apart <= tolerance);
  }
}

}  // namespace

TEST_CASE("the sweep is the carried importance and the product of full matrices, path by path") {
  check_random_paths<double>(1e-12, 6);
  check_random_paths<Double3>(1e-12, 6);
  check_random_paths<malus::Rgb>(2e-4, 6);
}

TEST_CASE("the sweep leaves tails without light out, and paths without any are no light") {
  for (const std::size_t lit : {std::size_t{0}, std::size_t{1}, std::size_t{2}})
    check_random_paths<double>(1e-12, lit);
}

TEST_CASE("matrices that are remembered give what the sweep does, path by path") {
  for (const std::size_t lit : {std::size_t{0}, std::size_t{1}, std::size_t{2}, std::size_t{6}}) {
    check_random_paths<double, RememberedMatrices<double>>(1e-12, lit);
    check_random_paths<Double3, RememberedMatrices<Double3>>(1e-12, lit);
  }
  check_random_paths<malus::Rgb, RememberedMatrices<malus::Rgb>>(2e-4, 6);
}

TEST_CASE("of a remembered path nothing is looked at behind its last light") {
  RememberedMatrices<double> path;
  const auto& sweep = path.sweep();
  const auto looked_at = [&] {
    std::size_t events = 0;
    static_cast<void>(sweep.result([&](const auto&, const auto& light, bool) {
      ++events;
      return light;
    }));
    return events;
  };
  CHECK(sweep.is_dark());
  // More than a path has room for from the beginning.
  for (int k = 0; k < 20; ++k) path.scatter(malus::Mueller<double>::plain(0.5));
  CHECK(looked_at() == 0);
  CHECK(path.result().form() == malus::StokesForm::zero);
  path.deposit(malus::Stokes<double>::unpolarized(1));
  CHECK_FALSE(sweep.is_dark());
  path.scatter(malus::Mueller<double>::depolarizing(0.5));
  path.scatter(malus::Mueller<double>::plain(0.5));
  CHECK(looked_at() == 20);
  CHECK(path.result()[0] == std::pow(0.5, 20));
  CHECK(sweep.scatterings() == 22);
  CHECK(sweep.evaluated() == 20);
}

TEST_CASE(
    "what a scattering is remembered by can be filled in before it is known, and stays there") {
  struct Number {
    double factor = 0;
  };
  malus::DeferredSweep<double, Number> path;
  const auto scaled = [](const Number& n, const malus::Stokes<double>& light, bool) {
    return malus::Stokes<double>::unpolarized(n.factor * light.intensity());
  };
  for (int trial = 0; trial < 3; ++trial) {  // the second path finds the places of the first
    path.begin();
    double expected = 1;
    std::vector<const Number*> places;
    for (int k = 0; k < 20; ++k) {
      Number& number = path.event();
      number.factor = 1 + 0.1 * k + trial;
      expected *= number.factor;
      CHECK(&path.scatter() == &number);
      places.push_back(&number);
    }
    path.event().factor = 1e9;  // the path ends before it
    path.deposit(malus::Stokes<double>::unpolarized(1));
    CHECK(places.front()->factor == doctest::Approx(1 + trial));
    CHECK(path.result(scaled).intensity() == doctest::Approx(expected));
  }
}

TEST_CASE("where the intensity alone is read, remembered matrices are told") {
  Random random(99);
  const auto frame = random.frame();
  RememberedMatrices<double> path;
  CHECK(path.sweep().reads_polarization());
  path.scatter(malus::Mueller<double>::depolarizing(0.5));
  CHECK_FALSE(path.sweep().reads_polarization());
  path.scatter(malus::linear_polarizer(1.0, frame));
  CHECK(path.sweep().reads_polarization());
  path.deposit({1, 1, 0, 0, frame});
  CHECK(path.result().form() == malus::StokesForm::unpolarized);
  CHECK(path.result()[0] == doctest::Approx(0.5));
}

TEST_CASE("a path that was only begun is no light and carries all") {
  malus::PathSweep<double> sweep;
  CHECK(sweep.result().form() == malus::StokesForm::zero);
  CHECK(sweep.throughput() == 1);
  sweep.scatter(malus::Mueller<double>::depolarizing(0.5));
  sweep.scatter(malus::Mueller<double>::depolarizing(0.25));
  CHECK(sweep.result().form() == malus::StokesForm::zero);
  CHECK(sweep.throughput() == 0.125);
  sweep.deposit({});
  CHECK(sweep.result().form() == malus::StokesForm::zero);
}

TEST_CASE("light deposited only at the end passes every element, the nearest to the sensor last") {
  Random random(91);
  const auto frame = random.frame();
  malus::PathSweep<double> sweep;
  const malus::Mueller<double> polarizer = malus::linear_polarizer(1.0, frame);
  const malus::Mueller<double> turner = malus::rotator(1.0, pi / 2, frame);
  // Light polarised along y: turned along x and passed. The other way round it would be blocked.
  sweep.scatter(polarizer);
  sweep.scatter(turner);
  sweep.deposit({1, -1, 0, 0, frame});
  CHECK(deviation_of_four(sweep.result().expressed_in(frame), Four{1, 1, 0, 0}) <= 1e-14);
  sweep.begin();
  sweep.scatter(turner);
  sweep.scatter(polarizer);
  sweep.deposit({1, -1, 0, 0, frame});
  CHECK(std::abs(sweep.result()[0]) <= 1e-14);
}

TEST_CASE("a deposit at the vertex where a path ends counts, with all that was put there before") {
  Random random(92);
  const auto frame = random.frame();
  malus::PathSweep<double> sweep;
  sweep.scatter(malus::Mueller<double>::depolarizing(0.5));
  sweep.deposit(malus::Stokes<double>::unpolarized(2));
  sweep.deposit({4, 0, 1, 0, frame});
  CHECK(sweep.result()[0] == 3);
  CHECK(sweep.result().form() == malus::StokesForm::unpolarized);
}

TEST_CASE("a scattering of the form zero cuts off what lies behind it, and nothing before") {
  malus::PathSweep<double> sweep;
  sweep.deposit(malus::Stokes<double>::unpolarized(1));
  sweep.scatter({});
  sweep.deposit(malus::Stokes<double>::unpolarized(5));
  CHECK(sweep.result()[0] == 1);
  CHECK(sweep.throughput() == 0);
}

TEST_CASE("begin() forgets a path: the same sweep gives what a new one does") {
  Random random(93);
  malus::PathSweep<double> used;
  for (int trial = 0; trial < 200; ++trial) {
    const Path path = random_path(random, every_form, 6);
    used.begin();
    malus::PathSweep<double> fresh;
    const auto a = swept<double>(path, used), b = swept<double>(path, fresh);
    CHECK(a.form() == b.form());
    CHECK(used.throughput() == fresh.throughput());
    for (std::size_t i = 0; i < 4; ++i) CHECK(a[i] == b[i]);
  }
}

TEST_CASE("results can be asked for along the way and change nothing") {
  Random random(94);
  for (int trial = 0; trial < 50; ++trial) {
    const Path path = random_path(random, every_form, 6);
    malus::PathSweep<double> asked, quiet;
    for (std::size_t k = 0; k < path.deposits.size(); ++k) {
      for (const Deposit& d : path.deposits[k]) asked.deposit(light_of<double>(d));
      static_cast<void>(asked.result());
      if (k < path.events.size()) asked.scatter(mueller_of<double>(path.events[k]));
    }
    CHECK(asked.result()[0] == swept<double>(path, quiet)[0]);
  }
}

TEST_CASE("where nothing polarises, the sum of intensities is the sweep, throughput and all") {
  Random random(95);
  malus::PathSum<Double3> sum;
  malus::PathSweep<Double3> sweep;
  for (int trial = 0; trial < 500; ++trial) {
    Path path = random_path(
        random,
        {MuellerForm::plain, MuellerForm::partial, MuellerForm::depolarizing, MuellerForm::zero},
        6);
    sum.begin();
    for (std::size_t k = 0; k < path.deposits.size(); ++k) {
      for (Deposit& d : path.deposits[k]) {
        d.polarized = false;
        sum.deposit(Double3(d.stokes[0][0], d.stokes[1][0], d.stokes[2][0]));
      }
      if (k < path.events.size()) sum.scatter(mueller_of<Double3>(path.events[k]).m00());
    }
    sweep.begin();
    const auto light = swept<Double3>(path, sweep);
    CHECK(sweep.throughput() == sum.throughput());
    CHECK(light.form() != malus::StokesForm::full);
    for (std::size_t c = 0; c < 3; ++c)
      CHECK(light[0][c] == doctest::Approx(sum.result()[c]).epsilon(1e-13));
  }
}

TEST_CASE("the sum of intensities starts from nothing, and begins anew") {
  malus::PathSum<double> sum;
  CHECK(sum.result() == 0);
  CHECK(sum.throughput() == 1);
  sum.deposit(1);
  sum.scatter(0.5);
  sum.deposit(4);
  CHECK(sum.result() == 3);
  CHECK(sum.throughput() == 0.5);
  sum.begin();
  CHECK(sum.result() == 0);
  CHECK(sum.throughput() == 1);
}

TEST_CASE("what is lost on the way is lost by all that comes after, and by nothing before") {
  Random random(96);
  for (int trial = 0; trial < 200; ++trial) {
    const Path path = random_path(random, every_form, 6);
    malus::PathSweep<double> attenuated, scattered;
    RememberedMatrices<double> remembered;
    malus::PathSum<double> sum, expected_sum;
    for (std::size_t k = 0; k < path.deposits.size(); ++k) {
      // Light of a medium itself comes before, between and after.
      for (const Deposit& d : path.deposits[k]) {
        const double left = random.unit();
        attenuated.deposit(light_of<double>(d));
        attenuated.attenuate(left);
        remembered.deposit(light_of<double>(d));
        remembered.attenuate(left);
        scattered.deposit(light_of<double>(d));
        scattered.scatter(malus::Mueller<double>::plain(left));
        sum.deposit(d.stokes[0][0]);
        sum.attenuate(left);
        expected_sum.deposit(d.stokes[0][0]);
        expected_sum.scatter(left);
      }
      if (k == path.events.size()) break;
      attenuated.scatter(mueller_of<double>(path.events[k]));
      remembered.scatter(mueller_of<double>(path.events[k]));
      scattered.scatter(mueller_of<double>(path.events[k]));
    }
    attenuated.deposit(malus::Stokes<double>::unpolarized(1));
    remembered.deposit(malus::Stokes<double>::unpolarized(1));
    scattered.deposit(malus::Stokes<double>::unpolarized(1));
    CHECK(attenuated.throughput() == doctest::Approx(scattered.throughput()));
    CHECK(sum.result() == expected_sum.result());
    const auto a = measured(attenuated.result(), path), b = measured(scattered.result(), path);
    const auto c = measured(remembered.result(), path);
    for (std::size_t i = 0; i < 4; ++i) {
      CHECK(a[i] == doctest::Approx(b[i]).epsilon(1e-12));
      CHECK(c[i] == doctest::Approx(b[i]).epsilon(1e-12));
    }
  }
}

TEST_CASE("stretches of medium act in the light's order, the first one met last") {
  Random random(97);
  const auto frame = random.frame();
  const auto direction = frame.direction();
  // Passes what is polarised across x alone, and turns the plane by a right angle.
  const auto dichroic =
      malus::UniaxialExtinction<double>{.axis = frame.x(), .linear_dichroism = 80}.transmittance(
          direction, 1);
  const auto sugar =
      malus::UniaxialExtinction<double>{.optical_rotation = pi / 2}.transmittance(direction, 1);
  for (const double s1 : {1.0, -1.0}) {
    malus::PathSweep<double> sweep;
    sweep.transmit(dichroic);
    sweep.transmit(sugar);
    sweep.deposit({1, s1, 0, 0, frame});
    CHECK(sweep.result()[0] == doctest::Approx(s1 > 0 ? 1 : 0));
    sweep.begin();
    sweep.transmit(sugar);
    sweep.transmit(dichroic);
    sweep.deposit({1, s1, 0, 0, frame});
    CHECK(sweep.result()[0] == doctest::Approx(s1 > 0 ? 0 : 1));
  }
}

TEST_CASE(
    "the row is what the carried importance reads intensity by, and the light is the sweep's") {
  using Carried = malus::Importance<double, incident>;
  Random random(98);
  malus::RowSweep<double> row;
  for (int trial = 0; trial < 500; ++trial) {
    const Path path = random_path(random, every_form, 6);
    malus::PathSweep<double> sweep;
    row.begin();
    Carried w = Carried::plain(1, path.sensor);
    for (std::size_t k = 0; k < path.deposits.size(); ++k) {
      for (const Deposit& d : path.deposits[k]) {
        sweep.deposit(light_of<double>(d));
        row.deposit(light_of<double>(d));
        // The reading of the intensity of this light, by both.
        const auto light = light_of<double>(d);
        CHECK(row.row() * light ==
              doctest::Approx((w * malus::propagate(light))[0]).epsilon(1e-10).scale(1));
      }
      CHECK(row.throughput() ==
            doctest::Approx((w * malus::propagate(malus::Stokes<double>::unpolarized(1)))[0])
                .epsilon(1e-10)
                .scale(1));
      if (k == path.events.size()) break;
      const auto f = mueller_of<double>(path.events[k]);
      const double left = random.unit();
      sweep.scatter(f);
      sweep.attenuate(left);
      row.scatter(f);
      row.attenuate(left);
      w = malus::propagate(w) * f * left;
    }
    const auto a = row.result(), b = sweep.result();
    CHECK(a.form() == b.form());
    for (std::size_t i = 0; i < 4; ++i) CHECK(a[i] == b[i]);
  }
  // A medium that turns the plane: what was read along x is read along the other axis.
  const auto frame = random.frame();
  const auto sugar =
      malus::UniaxialExtinction<double>{.extinction = 1, .optical_rotation = pi / 2}.transmittance(
          frame.direction(), 1);
  row.begin();
  row.scatter(malus::linear_polarizer(1.0, frame));
  row.transmit(sugar);
  CHECK(row.row() * malus::Stokes<double>(1, -1, 0, 0, frame) == doctest::Approx(std::exp(-1.0)));
  row.begin(false);
  row.scatter(malus::linear_polarizer(1.0, frame));
  CHECK(row.throughput() == 0.5);
  CHECK(row.row().form() == malus::StokesForm::unpolarized);
}
