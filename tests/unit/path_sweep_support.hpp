// SPDX-License-Identifier: MIT
// Random camera paths of random forms, and the light that comes along one by three ways: by the
// deferred evaluation, by the importance that is carried along (paper, section 4.4), and by plain
// 4×4 matrices.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>

#include <malus/deferred_sweep.hpp>
#include <malus/importance.hpp>
#include <malus/path_sweep.hpp>

#include "unit/optics_support.hpp"

namespace path_sweep_test {

using namespace optics_test;
using malus::exitant;
using malus::incident;
using malus::MuellerForm;

using Axes = malus::Frame<double>;
using Four = std::array<double, 4>;
using Rows = std::array<Four, 4>;

/// One scattering in plain numbers: what a vertex does to light of `enter`, leaving in `exit`.
struct Event {
  MuellerForm form;
  std::array<Rows, 3> rows;  // one a channel, in the frames below
  Axes enter, exit;
};
struct Deposit {
  bool polarized;
  std::array<Four, 3> stokes;
  Axes frame;
};
struct Path {
  std::vector<std::vector<Deposit>> deposits;  // one list a vertex
  std::vector<Event> events;                   // one fewer than vertices
  Axes sensor;                                 // about the first vertex's direction
};

inline Rows rows_of(MuellerForm form, Random& random) {
  Rows m{};
  const auto number = [&] { return random.between(-1, 1); };
  switch (form) {
    case MuellerForm::plain:
      m[0][0] = m[1][1] = m[2][2] = m[3][3] = random.unit();
      break;
    case MuellerForm::partial:
      m[0][0] = random.unit();
      m[1][1] = m[2][2] = m[3][3] = number();
      break;
    case MuellerForm::depolarizing:
      m[0][0] = random.unit();
      break;
    case MuellerForm::depolarizing_enter:
      for (auto& row : m) row[0] = number();
      break;
    case MuellerForm::depolarizing_exit:
      for (double& x : m[0]) x = number();
      break;
    case MuellerForm::block:
      for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t j = 0; j < 2; ++j) {
          m[i][j] = number();
          m[2 + i][2 + j] = number();
        }
      break;
    case MuellerForm::full:
      for (auto& row : m)
        for (double& x : row) x = number();
      break;
    default:
      break;
  }
  return m;
}

inline Axes turned_by_chance(const Axes& axes, Random& random) {
  return random.unit() < 0.3 ? axes : axes.turned(random.between(0, 2 * pi));
}

inline Deposit random_deposit(const Axes& axes, Random& random) {
  Deposit d{random.unit() < 0.6, {}, turned_by_chance(axes, random)};
  for (auto& s : d.stokes) {
    s[0] = random.between(0, 2);
    if (d.polarized)
      for (std::size_t i = 1; i < 4; ++i) s[i] = random.between(-1, 1);
  }
  return d;
}

/// A path of up to six vertices, scattered by the given forms alone; no light after `lit` vertices.
inline Path random_path(Random& random, const std::vector<MuellerForm>& forms, std::size_t lit) {
  Path path;
  Axes here = random.frame();
  path.sensor = turned_by_chance(here, random);
  const std::size_t vertices = 1 + random.below(6);
  for (std::size_t k = 0; k < vertices; ++k) {
    path.deposits.emplace_back();
    if (k < lit)
      for (std::size_t count = random.below(3); count-- > 0;)
        path.deposits.back().push_back(random_deposit(here, random));
    if (k + 1 == vertices) break;
    const MuellerForm form = forms[random.below(forms.size())];
    const Axes next = malus::is_collinear(form) ? here : random.frame();
    Event event{form, {}, turned_by_chance(next, random), turned_by_chance(here, random)};
    // Light that goes on as it came leaves in the frame it came in.
    if (malus::is_collinear(form)) event.exit = event.enter;
    for (Rows& rows : event.rows) rows = rows_of(form, random);
    path.events.push_back(event);
    here = next;
  }
  return path;
}

// the same in the library's types

template <class T>
malus::Frame<T> frame_of(const Axes& a) {
  return malus::Frame<T>(a.x(), a.y());
}

template <class V>
V value_of(double r, double g, double b) {
  using T = malus::scalar_t<V>;
  if constexpr (std::is_floating_point_v<V>)
    return static_cast<T>(r);
  else
    return V(static_cast<T>(r), static_cast<T>(g), static_cast<T>(b));
}

template <class V>
malus::Stokes<V> light_of(const Deposit& d) {
  const auto& s = d.stokes;
  const auto at = [&](std::size_t i) { return value_of<V>(s[0][i], s[1][i], s[2][i]); };
  if (!d.polarized) return malus::Stokes<V>::unpolarized(at(0));
  return {at(0), at(1), at(2), at(3), frame_of<malus::scalar_t<V>>(d.frame)};
}

template <class V>
malus::Mueller<V> mueller_of(const Event& e) {
  using M = malus::Mueller<V>;
  const auto at = [&](std::size_t r, std::size_t c) {
    return value_of<V>(e.rows[0][r][c], e.rows[1][r][c], e.rows[2][r][c]);
  };
  const auto enter = frame_of<malus::scalar_t<V>>(e.enter);
  const auto exit = frame_of<malus::scalar_t<V>>(e.exit);
  switch (e.form) {
    case MuellerForm::plain:
      return M::plain(at(0, 0));
    case MuellerForm::partial:
      return M::partial(at(0, 0), at(1, 1));
    case MuellerForm::depolarizing:
      return M::depolarizing(at(0, 0));
    case MuellerForm::depolarizing_enter:
      return M::depolarizing_enter({at(0, 0), at(1, 0), at(2, 0), at(3, 0)}, exit);
    case MuellerForm::depolarizing_exit:
      return M::depolarizing_exit({at(0, 0), at(0, 1), at(0, 2), at(0, 3)}, enter);
    case MuellerForm::block:
      return M::block({at(0, 0), at(0, 1), at(1, 0), at(1, 1)},
                      {at(2, 2), at(2, 3), at(3, 2), at(3, 3)}, enter, exit);
    case MuellerForm::full: {
      typename M::rows_type rows;
      for (std::size_t r = 0; r < 4; ++r)
        for (std::size_t c = 0; c < 4; ++c) rows[r][c] = at(r, c);
      return M::from_rows(rows, enter, exit);
    }
    default:
      return {};
  }
}

/// A DeferredSweep of matrices, told of a path as a PathSweep is.
template <class V>
class RememberedMatrices {
  using Light = malus::Stokes<V>;
  using Matrix = malus::Mueller<V>;

 public:
  void begin() { sweep_.begin(); }
  void deposit(const Light& light) { sweep_.deposit(light); }
  void scatter(const Matrix& m) {
    if (m.form() == MuellerForm::depolarizing)
      sweep_.depolarize(m.m00());
    else
      sweep_.scatter() = m;
  }
  void attenuate(const V& transmittance) { sweep_.attenuate(transmittance); }
  Light result() const {
    return sweep_.result([](const Matrix& m, const Light& light, bool reads_polarization) {
      const Light scattered = m * malus::propagate(light);
      return reads_polarization ? scattered : Light::unpolarized(scattered.intensity());
    });
  }
  const auto& sweep() const { return sweep_; }

 private:
  malus::DeferredSweep<V, Matrix> sweep_;
};

template <class V, class Sweep>
malus::Stokes<V> swept(const Path& path, Sweep& sweep) {
  for (std::size_t k = 0; k < path.deposits.size(); ++k) {
    for (const Deposit& d : path.deposits[k]) sweep.deposit(light_of<V>(d));
    if (k < path.events.size()) sweep.scatter(mueller_of<V>(path.events[k]));
  }
  return sweep.result();
}

template <class V>
malus::Measurement<V> measured(const malus::Stokes<V>& light, const Path& path) {
  const auto sensor = frame_of<malus::scalar_t<V>>(path.sensor);
  return malus::Importance<V, incident>::plain(V(1), sensor) * malus::propagate(light);
}

/// W·G·d₀ + W·G·f₀·G·d₁ + …: the importance carried from the sensor.
template <class V>
malus::Measurement<V> carried(const Path& path) {
  using Carried = malus::Importance<V, incident>;
  Carried w = Carried::plain(V(1), frame_of<malus::scalar_t<V>>(path.sensor));
  malus::Measurement<V> sum;
  for (std::size_t k = 0; k < path.deposits.size(); ++k) {
    for (const Deposit& d : path.deposits[k]) sum += w * malus::propagate(light_of<V>(d));
    if (k < path.events.size()) w = malus::propagate(w) * mueller_of<V>(path.events[k]);
  }
  return sum;
}

// the same in plain 4×4 matrices, every rotation a full one by its angle

inline Rows product(const Rows& a, const Rows& b) {
  Rows m{};
  for (std::size_t r = 0; r < 4; ++r)
    for (std::size_t c = 0; c < 4; ++c)
      for (std::size_t k = 0; k < 4; ++k) m[r][c] += a[r][k] * b[k][c];
  return m;
}

/// R(φ) that expresses in `to` what is expressed in `from`.
inline Rows turn(const Axes& from, const Axes& to) {
  const double phi = std::atan2(glm::dot(from.y(), to.x()), glm::dot(from.x(), to.x()));
  const double c = std::cos(2 * phi), s = std::sin(2 * phi);
  return {{{1, 0, 0, 0}, {0, c, s, 0}, {0, -s, c, 0}, {0, 0, 0, 1}}};
}

inline std::array<Four, 3> by_matrices(const Path& path) {
  std::array<Four, 3> readings{};
  for (std::size_t channel = 0; channel < 3; ++channel) {
    Rows chain{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
    Axes frame = path.sensor;
    for (std::size_t k = 0; k < path.deposits.size(); ++k) {
      for (const Deposit& d : path.deposits[k]) {
        const Rows m = product(chain, turn(d.frame, frame));
        for (std::size_t r = 0; r < 4; ++r)
          for (std::size_t c = 0; c < 4; ++c)
            readings[channel][r] += m[r][c] * d.stokes[channel][c];
      }
      if (k == path.events.size()) break;
      const Event& e = path.events[k];
      chain = product(product(chain, turn(e.exit, frame)), e.rows[channel]);
      frame = e.enter;
    }
  }
  return readings;
}

inline const std::vector<MuellerForm> every_form = {
    MuellerForm::zero,    MuellerForm::plain,
    MuellerForm::partial, MuellerForm::depolarizing,
    MuellerForm::block,   MuellerForm::depolarizing_enter,
    MuellerForm::full,    MuellerForm::depolarizing_exit,
    MuellerForm::block,   MuellerForm::full};

}  // namespace path_sweep_test
