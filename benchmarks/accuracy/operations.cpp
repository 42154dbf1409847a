// SPDX-License-Identifier: MIT
// The operations as the library makes them, and the same with rotations that are found in other
// ways. Compiled once for each set of flags.
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <vector>

#include <malus/optics/fresnel.hpp>
#include <malus/product.hpp>
#include <malus/propagate.hpp>

#include "request.hpp"

namespace accuracy {
namespace {

using malus::MuellerForm;
using malus::StokesForm;
using malus::detail::Access;

template <class T>
using Rgb = malus::Spectrum<T, channels>;
template <class T>
using Light = malus::Stokes<Rgb<T>, malus::incident, malus::Frame<T>, StokesForm::full>;
template <class T>
using LightOut = malus::Stokes<Rgb<T>, malus::exitant, malus::Frame<T>, StokesForm::full>;
template <class T>
using Full = malus::FullMueller<Rgb<T>, malus::incident, malus::exitant, malus::Frame<T>>;
/// What the next matrix acts on: light that leaves, and has not arrived yet, fits no product.
template <class T>
using FullBack = malus::FullMueller<Rgb<T>, malus::exitant, malus::incident, malus::Frame<T>>;
template <class T>
using Block = malus::BlockMueller<Rgb<T>, malus::incident, malus::exitant, malus::Frame<T>>;
struct Plane {};
using Fixed = malus::StaticFrame<Plane>;

template <Turning How, class T>
MALUS_INLINE malus::Rotation<T> turn_between(const malus::Frame<T>& from,
                                             const malus::Frame<T>& to) {
  if constexpr (How == Turning::divided) {
    return malus::rotation(from, to);
  } else {
    const T c = glm::dot(from.x(), to.x()), s = glm::dot(from.y(), to.x());
    if constexpr (How == Turning::angles) return malus::Rotation<T>::by(std::atan2(s, c));
    const T cos2 = (c - s) * (c + s), sin2 = 2 * c * s, norm2 = c * c + s * s;
    if constexpr (How == Turning::quotients)
      return {norm2 > 0 ? cos2 / norm2 : T(1), norm2 > 0 ? sin2 / norm2 : T(0)};
    return {cos2, sin2};
  }
}

template <Turning How, class T>
MALUS_INLINE Light<T> express(const Light<T>& light, const malus::Frame<T>& frame) {
  if constexpr (How == Turning::divided)
    return light.expressed_in(frame);
  else
    return light.expressed_in(frame, turn_between<How>(light.frame(), frame));
}

template <Turning How, class T, MuellerForm Form>
MALUS_INLINE LightOut<T> apply(const malus::Mueller<Rgb<T>, malus::incident, malus::exitant,
                                                    malus::Frame<T>, malus::Frame<T>, Form>& m,
                               const Light<T>& light) {
  if constexpr (How == Turning::divided) {
    return m * light;
  } else {
    return malus::detail::combine<LightOut<T>>(
        m, light, [](auto, auto, const auto& a, const auto& b, auto& result) MALUS_INLINE_LAMBDA {
          const auto turn = turn_between<How>(Access::frame(b).get(), Access::enter(a).get());
          malus::detail::apply_turned<4, Form, StokesForm::full>(
              Access::values(a), turn, Access::values(b), Access::values(result));
          malus::detail::copy_frame(Access::frame(result), Access::exit(a));
        });
  }
}

template <Turning How, class T>
MALUS_INLINE auto multiply(const Full<T>& left, const FullBack<T>& right) {
  if constexpr (How == Turning::divided) {
    return left * right;
  } else {
    return malus::detail::combine<decltype(left * right)>(
        left, right,
        [](auto, auto, const auto& a, const auto& b, auto& result) MALUS_INLINE_LAMBDA {
          constexpr MuellerForm full = MuellerForm::full;
          const auto turn = turn_between<How>(Access::exit(b).get(), Access::enter(a).get());
          malus::detail::multiply_turned<full, full, full>(
              Access::values(a), turn, Access::values(b), Access::values(result));
          malus::detail::copy_frame(Access::enter(result), Access::enter(b));
          malus::detail::copy_frame(Access::exit(result), Access::exit(a));
        });
  }
}

// Operands in the precision at hand

template <class T>
Rgb<T> to_rgb(const double (&value)[channels]) {
  return {static_cast<T>(value[0]), static_cast<T>(value[1]), static_cast<T>(value[2])};
}
template <class T, std::size_t N>
std::array<Rgb<T>, N> to_rgbs(const double (&values)[N][channels]) {
  std::array<Rgb<T>, N> result;
  for (std::size_t i = 0; i < N; ++i) result[i] = to_rgb<T>(values[i]);
  return result;
}
template <class T>
malus::Frame<T> to_frame(const Axes& a) {
  return {a.x, a.y};
}
template <class M, class T>
M to_matrix(const double (&rows)[16][channels], const malus::Frame<T>& enter,
            const malus::Frame<T>& exit) {
  typename M::rows_type matrix;
  for (std::size_t i = 0; i < 16; ++i) matrix[i / 4][i % 4] = to_rgb<T>(rows[i]);
  return M::from_rows(matrix, enter, exit);
}

template <class T>
struct Operand {
  malus::Frame<T> from, to;
  Light<T> light;
  Full<T> left;
  FullBack<T> right;
  T cosine, eta;
  Rgb<T> metal_eta, metal_k;

  explicit Operand(const Operands& o)
      : from(to_frame<T>(o.from)),
        to(to_frame<T>(o.to)),
        left(to_matrix<Full<T>>(o.left, to, from)),
        right(to_matrix<FullBack<T>>(o.right, to, from)),
        cosine(static_cast<T>(o.cosine)),
        eta(static_cast<T>(o.eta)),
        metal_eta(to_rgb<T>(o.metal_eta)),
        metal_k(to_rgb<T>(o.metal_k)) {
    const auto s = to_rgbs<T>(o.light);
    light = Light<T>(s[0], s[1], s[2], s[3], from);
  }
};

// Results as numbers

template <class T>
void store(const malus::Rotation<T>& r, double* out) {
  out[0] = static_cast<double>(r.cos2);
  out[1] = static_cast<double>(r.sin2);
}
template <class Q>
  requires malus::StokesType<Q> || malus::MuellerType<Q>
void store(const Q& q, double* out) {
  const auto* values = Access::values(q);
  constexpr std::size_t count = malus::value_count(Q::static_form);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t c = 0; c < channels; ++c)
      out[channels * i + c] = static_cast<double>(values[i][c]);
}

// Timing

/// The compiler has to assume that what the pointer points to is read.
inline void escape(const void* pointer) { asm volatile("" : : "g"(pointer) : "memory"); }

/// Calls pass() for so many seconds and gives the nanoseconds of one call: the least of batches
/// that are shorter than other programs' turns on the processor.
template <class Pass>
double time_passes(double seconds, Pass&& pass) {
  using Clock = std::chrono::steady_clock;
  const auto batch = [&](std::size_t passes) {
    const auto start = Clock::now();
    for (std::size_t i = 0; i < passes; ++i) pass();
    return std::chrono::duration<double>(Clock::now() - start).count();
  };
  constexpr double shortest = 30e-6;
  std::size_t passes = 1;
  while (batch(passes) < shortest) passes *= 2;
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  double least = batch(passes);
  while (Clock::now() < end) least = std::min(least, batch(passes));
  return least / static_cast<double>(passes) * 1e9;
}

/// Few enough for the first-level cache, too many for the compiler to know.
constexpr std::size_t timed = 16;

template <class T, class Compute>
double measure_each(const Request& request, const Compute& compute) {
  const std::size_t count = request.results ? request.count : std::min(timed, request.count);
  std::vector<Operand<T>> list(request.shift, Operand<T>(request.operands[0]));
  for (std::size_t i = 0; i < count; ++i) list.emplace_back(request.operands[i]);
  const Operand<T>* operands = list.data() + request.shift;
  if (request.results)
    for (std::size_t i = 0; i < count; ++i)
      store(compute(operands[i]), request.results + i * result_count(request.operation));
  if (!(request.seconds > 0)) return 0;
  const std::size_t n = std::min(timed, count);
  return time_passes(request.seconds,
                     [&] {
                       for (std::size_t i = 0; i < n; ++i) {
                         // Never across two pages, which would cost more than most operations.
                         alignas(1024) const auto result = compute(operands[i]);
                         escape(&result);
                       }
                     }) /
         static_cast<double>(n);
}

template <Turning How, class T>
Light<T> run_chain(const Light<T>& light, const Block<T>* elements, std::size_t length) {
  Light<T> s = light;
  for (std::size_t i = 0; i < length; ++i) s = malus::propagate(apply<How>(elements[i], s));
  return s;
}

template <Turning How, class T>
double measure_chains(const Request& request) {
  const std::size_t length = request.chain_length;
  const std::size_t chains = request.results ? request.count : 1;
  std::vector<Block<T>> list(request.shift);
  for (std::size_t i = 0; i < chains * length; ++i) {
    const Element& e = request.elements[i];
    list.push_back(Block<T>::block(to_rgbs<T>(e.upper), to_rgbs<T>(e.lower), to_frame<T>(e.enter),
                                   to_frame<T>(e.exit)));
  }
  const Block<T>* elements = list.data() + request.shift;
  const auto run = [&](std::size_t chain) {
    const Operand<T> start(request.operands[chain]);
    // Light starts where its chain does.
    const Light<T> light(start.light[0], start.light[1], start.light[2], start.light[3],
                         elements[chain * length].enter());
    return run_chain<How>(light, elements + chain * length, length);
  };
  if (request.results)
    for (std::size_t i = 0; i < chains; ++i)
      store(run(i), request.results + i * result_count(request.operation));
  if (!(request.seconds > 0)) return 0;
  const Operand<T> start(request.operands[0]);
  const Light<T> light(start.light[0], start.light[1], start.light[2], start.light[3],
                       elements[0].enter());
  return time_passes(request.seconds,
                     [&] {
                       alignas(1024) const Light<T> result =
                           run_chain<How>(light, elements, length);
                       escape(&result);
                     }) /
         static_cast<double>(length);
}

template <Turning How, class T>
double measure(const Request& request) {
  const auto each = [&](auto compute) { return measure_each<T>(request, compute); };
  using Given = const Operand<T>&;
  switch (request.operation) {
    case Operation::coefficients:
      return each([](Given o) { return turn_between<How>(o.from, o.to); });
    case Operation::rotate_stokes:
      return each([](Given o) { return express<How>(o.light, o.to); });
    case Operation::mueller_stokes:
      return each([](Given o) { return apply<How>(o.left, o.light); });
    case Operation::mueller_mueller:
      return each([](Given o) { return multiply<How>(o.left, o.right); });
    case Operation::chain:
      return measure_chains<How, T>(request);
    default:
      break;
  }
  // These turn nothing.
  if constexpr (How == Turning::divided) {
    if (request.operation == Operation::dielectric)
      return each([](Given o) {
        return malus::dielectric_reflection<Rgb<T>>(o.cosine, o.eta, Fixed{}, Fixed{});
      });
    return each([](Given o) {
      return malus::conductor_reflection(o.cosine, o.metal_eta, o.metal_k, Fixed{}, Fixed{});
    });
  }
  return 0;
}

template <class T>
double measure_in(const Request& request) {
  switch (request.turning) {
    case Turning::divided:
      return measure<Turning::divided, T>(request);
    case Turning::quotients:
      return measure<Turning::quotients, T>(request);
    case Turning::undivided:
      return measure<Turning::undivided, T>(request);
    default:
      return measure<Turning::angles, T>(request);
  }
}

}  // namespace
}  // namespace accuracy

extern "C" __attribute__((visibility("default"))) double MALUS_ACCURACY_ENTRY(
    const accuracy::Request& request) {
  return request.is_double ? accuracy::measure_in<double>(request)
                           : accuracy::measure_in<float>(request);
}
