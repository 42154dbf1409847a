// SPDX-License-Identifier: MIT
// What the coats of plastics keep and leave out: terms that are found once for value and matrix,
// and a product with light that makes no matrix.
#include <doctest/doctest.h>

#include "bsdf_support.hpp"

using namespace bsdf_test;

namespace {

using Full = malus::FullMueller<Rgb, malus::incident, malus::exitant, MuellerFrame>;
using Scattered = malus::Stokes<Rgb, malus::exitant, MuellerFrame>;
template <malus::StokesForm Form>
using Arriving = malus::Stokes<Rgb, malus::incident, MuellerFrame, Form>;

/// The largest difference of components, both in `frame`, over the intensity.
template <class A, class B>
float difference(const A& a, const B& b, const MuellerFrame& frame) {
  const auto x = a.expressed_in(frame);
  const auto y = b.expressed_in(frame);
  float most = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      most = std::max(most, std::abs(x[i][k] - y[i][k]) / y[0][k]);
  return most;
}

}  // namespace

TEST_CASE("coat: a coat over a base times light is its matrix times that light") {
  Sampler sampler(61, 62, 63);
  for (int i = 0; i < 500; ++i) {
    const Event e(sampler);
    const Vec3 incident = e.direction(0.05f + 0.9f * sampler.next_1d(), 6.2f * sampler.next_1d());
    const Vec3 exitant = e.direction(0.05f + 0.9f * sampler.next_1d(), 6.2f * sampler.next_1d());
    const auto random = [&] { return sampler.next_1d(); };
    const CoatOverBase m{{random(), random(), random() - 0.5f, random() - 0.5f},
                         Rgb(random(), random(), random()),
                         facet_frames(incident, exitant),
                         BasePolarization(e.hit.normal, incident, exitant, {random(), random()},
                                          {random(), random()}),
                         Rgb(random(), random(), random())};
    const Full matrix = m;
    const auto frame = MuellerFrame::toward(exitant, Vec3(0.3f, 0.5f, 0.8f));

    const Rgb s0(1.0f + random(), 1.5f, 1.0f + random());
    const auto plain = Arriving<malus::StokesForm::unpolarized>::unpolarized(s0);
    CHECK(difference(m * plain, Scattered(matrix * plain), frame) < 2e-5f);
    const Arriving<malus::StokesForm::full> light(
        s0, Rgb(random(), -random(), 0.2f), Rgb(0.1f, random(), -random()), Rgb(random(), 0.3f, 0),
        MuellerFrame::toward(-incident, Vec3(0.8f, -0.2f, 0.1f)));
    CHECK(difference(m * light, matrix * light, frame) < 2e-5f);
  }
}

TEST_CASE("coat: what is followed of light changes no bit of a value or a draw, of any kind") {
  for (const auto& [name, bsdf, roughness] : smooth_kinds({0.2f})) {
    CAPTURE(name);
    Sampler sampler(64, 65, 66);
    for (int i = 0; i < 200; ++i) {
      const Event e(sampler);
      const Vec3 other = e.direction(2 * sampler.next_1d() - 1, 6.2f * sampler.next_1d());
      const BsdfValue a = bsdf.value<Polarized>(e.hit, other, e.known);
      const BsdfValue b = bsdf.value<Unpolarized>(e.hit, other, e.known);
      CHECK((a.m00 == b.m00 && a.pdf_incident == b.pdf_incident && a.pdf_exitant == b.pdf_exitant));

      Sampler again = sampler;
      BsdfSampleOf<Polarized> s;
      BsdfSampleOf<Unpolarized> t;
      const Tracing tracing = both_tracings[i % 2];
      const bool drawn = bsdf.sample(e.hit, e.known, tracing, sampler, s);
      REQUIRE(drawn == bsdf.sample(e.hit, e.known, tracing, again, t));
      if (!drawn) continue;
      CHECK((s.direction == t.direction && s.weight == t.weight && s.pdf == t.pdf &&
             s.reverse_pdf == t.reverse_pdf));
    }
  }
}
