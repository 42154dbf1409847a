// SPDX-License-Identifier: MIT
// What the quantities are made of and give back: components by rows, GLM's columns, neutral
// elements, equality modulo frame, static frames changed by a stated rotation.
#include <doctest/doctest.h>

#include <array>
#include <limits>
#include <numbers>

#include <glm/gtc/matrix_access.hpp>

#include <malus/malus.hpp>

using malus::exitant;
using malus::incident;
using malus::Rgb;

namespace {

using Frame = malus::Frame<double>;
using Light = malus::Stokes<double>;
using M = malus::Mueller<double>;

const Frame bench(glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0));
const Frame tilted = bench.turned(0.4);

/// Component (r, c) is 10 r + c.
M numbered() {
  return M::from_rows({{{0, 1, 2, 3}, {10, 11, 12, 13}, {20, 21, 22, 23}, {30, 31, 32, 33}}}, bench,
                      tilted);
}

}  // namespace

TEST_CASE("matrices are written and read by rows") {
  const auto m = numbered();
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c) CHECK(m(r, c) == 10 * r + c);
  CHECK(m.enter().x() == bench.x());
  CHECK(m.exit().x() == tilted.x());

  const auto b = M::block({1, 2, 3, 4}, {5, 6, 7, 8}, bench, bench);
  const double expected[4][4] = {{1, 2, 0, 0}, {3, 4, 0, 0}, {0, 0, 5, 6}, {0, 0, 7, 8}};
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c) CHECK(b(r, c) == expected[r][c]);
}

TEST_CASE("GLM's matrix and vector are the same ones, so that their product is the product") {
  const auto m = propagate(numbered());
  const malus::Stokes<double, incident> s(1, 2, 3, 4, bench);
  const glm::dvec4 product = m.to_mat4() * s.to_vec4();
  const auto light = m * s;
  for (int i = 0; i < 4; ++i) CHECK(product[i] == light[static_cast<std::size_t>(i)]);
  CHECK(glm::row(m.to_mat4(), 1) == glm::dvec4(10, 11, 12, 13));

  const auto back = M::from_mat4(numbered().to_mat4(), bench, tilted);
  CHECK(back == numbered());
  CHECK(Light::from_vec4(glm::dvec4(1, 2, 3, 4), bench) == Light(1, 2, 3, 4, bench));

  const malus::Stokes<Rgb> colored(Rgb(1.f, 2.f, 3.f), Rgb(4.f, 5.f, 6.f), Rgb(7.f, 8.f, 9.f),
                                   Rgb(-1.f, -2.f, -3.f),
                                   malus::Frame<float>::about(glm::vec3(0, 0, 1)));
  CHECK(colored.to_vec4(1) == glm::vec4(2, 5, 8, -2));
}

TEST_CASE("a frame takes any vector of x, y, z members, x(), y(), z() functions or operator[]") {
  struct Members {
    float x, y, z;
  };
  struct Functions {
    double v[3];
    double x() const { return v[0]; }
    double y() const { return v[1]; }
    double z() const { return v[2]; }
  };
  const Frame a(Members{0, 1, 0}, Functions{{0, 0, 1}});
  const Frame b(std::array<double, 3>{0, 1, 0}, glm::vec3(0, 0, 1));
  CHECK(a.x() == b.x());
  CHECK(a.y() == b.y());
  CHECK(a.direction() == glm::dvec3(1, 0, 0));
}

TEST_CASE("default-constructed quantities are neutral in sums and nothing in products") {
  const Light s(1, 0.5, -0.25, 0.125, bench);
  CHECK(Light() + s == s);
  CHECK(s + Light() == s);
  CHECK((M() * malus::Stokes<double, incident>(1, 0, 0, 0, bench)).form() ==
        malus::StokesForm::zero);
  CHECK(Light()[0] == 0);
  CHECK(Light().intensity() == 0);
  CHECK(M().m00() == 0);
  CHECK(M()(2, 3) == 0);
  CHECK(malus::Measurement<double>()[3] == 0);
  CHECK(malus::UnpolarizedStokes<double>().intensity() == 0);
}

TEST_CASE("readings are summed and scaled") {
  const malus::Measurement<double> a(1, 2, 3, 4), b(10, 20, 30, 40);
  CHECK(a + b == malus::Measurement<double>(11, 22, 33, 44));
  CHECK(2. * a == malus::Measurement<double>(2, 4, 6, 8));
  CHECK(a * 2. == 2. * a);
  auto sum = a;
  sum += b;
  sum *= 0.5;
  CHECK(sum == malus::Measurement<double>(5.5, 11, 16.5, 22));
  CHECK_FALSE(a == b);
  CHECK(a.to_vec4() == glm::dvec4(1, 2, 3, 4));
}

TEST_CASE("sums are expressed in the left one's frames, and where it has none in the right one's") {
  const Light s(1, 0.5, -0.25, 0.125, bench), t(1, 0.5, -0.25, 0.125, tilted);
  CHECK((s + t).frame().x() == bench.x());
  CHECK((t + s).frame().x() == tilted.x());
  CHECK((Light::unpolarized(1) + t).frame().x() == tilted.x());

  const auto m = numbered(), n = numbered().expressed_in(tilted, bench);
  CHECK((m + n).enter().x() == bench.x());
  CHECK((m + n).exit().x() == tilted.x());
  CHECK((n + m).enter().x() == tilted.x());
  CHECK((M::depolarizing(1) + n).exit().x() == bench.x());

  const auto w = malus::Importance<double>::plain(1, bench),
             v = malus::Importance<double>::plain(1, tilted);
  CHECK((w + v).frame().x() == bench.x());
  CHECK((malus::Importance<double>::depolarizing({1, 0, 0, 0}) + v).frame().x() == tilted.x());
}

TEST_CASE("equality is modulo frame") {
  const Light s(1, 0.5, -0.25, 0.125, bench);
  CHECK(s == s.expressed_in(tilted));
  CHECK_FALSE(s == Light(1, 0.5, -0.25, 0.125, tilted));
  CHECK(numbered() == numbered().expressed_in(tilted, bench));
  CHECK_FALSE(numbered() ==
              M::from_rows({{{0, 1, 2, 3}, {10, 11, 12, 13}, {20, 21, 22, 23}, {30, 31, 32, 33}}},
                           tilted, bench));
  // Forms need not agree.
  CHECK(Light::unpolarized(2) == Light(2, 0, 0, 0, tilted));
  CHECK(M::depolarizing(2) == M::from_rows({{{2}}}, bench, tilted));
  CHECK_FALSE(Light::unpolarized(2) == s);
}

TEST_CASE("nothing is equal to what is not a number") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t bad = 0; bad < 4; ++bad) {
    std::array<double, 4> v = {1, 0.5, -0.25, 0.125};
    v[bad] = nan;
    const Light s(v[0], v[1], v[2], v[3], bench);
    CAPTURE(bad);
    CHECK_FALSE(s == s);
    CHECK_FALSE(is_close(s, Light(1, 0.5, -0.25, 0.125, bench), 1e10));
  }
}

TEST_CASE("is_close tells a part in a thousand from one in a million") {
  const Light s(1, 0.5, -0.25, 0.125, bench);
  const Light off(1, 0.5 + 1e-5, -0.25, 0.125, bench);
  CHECK(is_close(s, off, 1e-4));
  CHECK_FALSE(is_close(s, off, 1e-6));
  CHECK_FALSE(s == off);
}

TEST_CASE("a change of static frames is the rotation that the user states") {
  struct Lab;
  struct Turned;
  using InLab = malus::StaticFrame<Lab>;
  using InTurned = malus::StaticFrame<Turned>;
  const malus::Stokes<double, exitant, InLab> horizontal(1, 1, 0, 0);
  const auto turn = malus::Rotation<double>::by(std::numbers::pi / 4);
  const malus::Stokes<double, exitant, InTurned> seen =
      malus::change_frame<InTurned>(horizontal, turn);
  CHECK(seen[0] == 1);
  CHECK(seen[1] == doctest::Approx(0));
  CHECK(seen[2] == doctest::Approx(-1));
}

TEST_CASE("the importance of the four components reads the four components") {
  const malus::Stokes<double, incident> s(1, 0.5, -0.25, 0.125, bench);
  const auto sensor = malus::Importance<double, incident>::plain(2, bench);
  CHECK(sensor * s == malus::Measurement<double>(2, 1, -0.5, 0.25));
  const auto intensity = malus::Analyzer<double, incident>::intensity(3);
  CHECK(intensity * s == 3);
}
