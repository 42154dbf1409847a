// SPDX-License-Identifier: MIT
// MALUS_CHECK_FRAMES: every operation that meets frames of different directions reports both to the
// handler; where the check is compiled out, none does.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include <malus/malus.hpp>

namespace {

using malus::exitant;
using malus::incident;
using Frame = malus::Frame<double>;
using M = malus::Mueller<double>;

std::vector<malus::FrameMismatch> reported;

/// Counts mismatches while it lives.
class Counting {
 public:
  Counting()
      : before_(malus::set_frame_mismatch_handler(
            [](const malus::FrameMismatch& m) { reported.push_back(m); })) {
    reported.clear();
  }
  ~Counting() { malus::set_frame_mismatch_handler(before_); }
  Counting(const Counting&) = delete;
  Counting& operator=(const Counting&) = delete;

 private:
  malus::FrameMismatchHandler before_;
};

// Two frames about z, one of them turned, and one about x.
const Frame along_z(glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0));
const Frame along_z_too = along_z.turned(0.7);
const Frame along_x(glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1));

/// One operation with operands in two frames.
struct Operation {
  const char* name;
  void (*meet)(const Frame&, const Frame&);
};

M full(const Frame& enter, const Frame& exit) {
  return M::from_rows({{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}}, enter, exit);
}
auto light(const Frame& f) { return malus::Stokes<double, incident>(1, 0, 0, 0, f); }
auto row(const Frame& f) { return malus::Analyzer<double, exitant>(1, 0, 0, 0, f); }
auto importance(const Frame& f) { return malus::Importance<double, exitant>::plain(1, f); }

template <class T>
void use(const T&) {}

const Operation operations[] = {
    {"Mueller * Stokes", [](const Frame& f, const Frame& g) { use(full(f, along_z) * light(g)); }},
    {"Mueller * Mueller",
     [](const Frame& f, const Frame& g) { use(full(f, along_z) * propagate(full(along_z, g))); }},
    {"Importance * Mueller",
     [](const Frame& f, const Frame& g) { use(importance(f) * full(along_z, g)); }},
    {"Importance * Stokes",
     [](const Frame& f, const Frame& g) {
       use(malus::Importance<double, incident>::plain(1, f) * light(g));
     }},
    {"Analyzer * Mueller", [](const Frame& f, const Frame& g) { use(row(f) * full(along_z, g)); }},
    {"Analyzer * Stokes",
     [](const Frame& f, const Frame& g) {
       use(malus::Analyzer<double, incident>(1, 0, 0, 0, f) * light(g));
     }},
    {"inner_product",
     [](const Frame& f, const Frame& g) { use(inner_product(light(f), light(g))); }},
    {"Stokes + Stokes", [](const Frame& f, const Frame& g) { use(light(f) + light(g)); }},
    {"Analyzer + Analyzer", [](const Frame& f, const Frame& g) { use(row(f) + row(g)); }},
    {"Importance + Importance",
     [](const Frame& f, const Frame& g) { use(importance(f) + importance(g)); }},
    {"Mueller + Mueller",
     [](const Frame& f, const Frame& g) { use(full(f, along_z) + full(g, along_z)); }},
    {"Mueller + Mueller",
     [](const Frame& f, const Frame& g) { use(full(along_z, f) + full(along_z, g)); }},
    {"Stokes::expressed_in", [](const Frame& f, const Frame& g) { use(light(g).expressed_in(f)); }},
    {"Mueller::expressed_in",
     [](const Frame& f, const Frame& g) { use(full(g, along_z).expressed_in(f, along_z)); }},
    {"Mueller::expressed_in",
     [](const Frame& f, const Frame& g) { use(full(along_z, g).expressed_in(along_z, f)); }},
    {"Importance::expressed_in",
     [](const Frame& f, const Frame& g) { use(importance(g).expressed_in(f)); }},
    {"Analyzer::expressed_in", [](const Frame& f, const Frame& g) { use(row(g).expressed_in(f)); }},
    {"rotation", [](const Frame& f, const Frame& g) { use(rotation(g, f)); }},
};

}  // namespace

#if MALUS_CHECK_FRAMES

namespace {

struct Mismatch {};

bool is(const double (&x)[3], const double (&y)[3], const Frame& frame) {
  for (int i = 0; i < 3; ++i)
    if (x[i] != frame.x()[i] || y[i] != frame.y()[i]) return false;
  return true;
}

}  // namespace

TEST_CASE("every operation reports frames of different directions, both of them and its own name") {
  const Counting counting;
  for (const Operation& operation : operations) {
    CAPTURE(operation.name);
    reported.clear();
    operation.meet(along_z_too, along_x);
    REQUIRE(reported.size() == 1);
    const auto& m = reported[0];
    CHECK(std::string(m.operation) == operation.name);
    const bool right_to_left = is(m.from_x, m.from_y, along_x) && is(m.to_x, m.to_y, along_z_too);
    const bool left_to_right = is(m.from_x, m.from_y, along_z_too) && is(m.to_x, m.to_y, along_x);
    CHECK((right_to_left || left_to_right));
  }
}

TEST_CASE("a direction and its opposite are different directions") {
  const Counting counting;
  const Frame backwards(along_z.x(), -along_z.y());
  for (const Operation& operation : operations) {
    CAPTURE(operation.name);
    reported.clear();
    operation.meet(along_z, backwards);
    CHECK(reported.size() == 1);
  }
}

TEST_CASE("a collinear matrix beside light that turns is reported") {
  const Counting counting;
  use(full(along_z, along_x) + M::plain(1));
  CHECK(reported.size() == 1);
}

TEST_CASE("a handler may throw out of an operation") {
  const auto before =
      malus::set_frame_mismatch_handler([](const malus::FrameMismatch&) { throw Mismatch(); });
  CHECK_THROWS_AS(use(light(along_z) + light(along_x)), Mismatch);
  malus::set_frame_mismatch_handler(before);
}

#else

TEST_CASE("no operation checks frames where the check is compiled out") {
  const Counting counting;
  for (const Operation& operation : operations) operation.meet(along_z, along_x);
  CHECK(reported.empty());
}

#endif

TEST_CASE("frames of one direction are never reported") {
  const Counting counting;
  for (const Operation& operation : operations) {
    CAPTURE(operation.name);
    operation.meet(along_z, along_z_too);
    operation.meet(along_z, {1000. * along_z_too.x(), 1000. * along_z_too.y()});
  }
  CHECK(reported.empty());
}

TEST_CASE("operands without a frame are never reported") {
  const Counting counting;
  const auto unpolarized = malus::Stokes<double, incident>::unpolarized(1);
  use(full(along_z, along_x) * unpolarized);
  use(light(along_x) + unpolarized);
  use(M::depolarizing(1) * light(along_x));
  use(full(along_z, along_x) + M::depolarizing(1));
  use(M::plain(1) * light(along_x));
  use(importance(along_z) * M::depolarizing_exit({1, 0, 0, 0}, along_x));
  use(malus::Stokes<double, incident>() + light(along_x));
  CHECK(reported.empty());
}

TEST_CASE("setting a handler returns the one before") {
  const auto first = [](const malus::FrameMismatch&) {};
  const malus::FrameMismatchHandler handler = first;
  const auto before = malus::set_frame_mismatch_handler(handler);
  CHECK((malus::set_frame_mismatch_handler(before) == handler));
}
