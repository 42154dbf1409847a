// SPDX-License-Identifier: MIT
// The BSDFs that scatter to all sides: their draws, both ways of tracing; their energy; their
// matrices' reciprocity; Mitsuba's values for unpolarised light; and that the base of a plastic
// shines polarised through its coat.
#include <doctest/doctest.h>

#include <malus/analysis/physicality.hpp>
#include <malus/analysis/polarization_state.hpp>

#include "bsdf_support.hpp"
#include "bsdfs/conductor_terms.hpp"
#include "mitsuba_values.hpp"
#include "scene/conductor_data.hpp"

using namespace bsdf_test;

namespace {

using Full = malus::Mueller<Rgb, malus::incident, malus::exitant>;

bool transmits(const Bsdf& bsdf) { return std::holds_alternative<RoughDielectric>(bsdf.kind()); }

/// The index on the side of a direction over that on the normal's side.
float index_at(const Bsdf& bsdf, float cosine) {
  const auto* rough = std::get_if<RoughDielectric>(&bsdf.kind());
  return rough && cosine < 0 ? rough->eta : 1.0f;
}

std::vector<float> angles(const Bsdf& bsdf) {
  return transmits(bsdf) ? std::vector<float>{5, 45, 87, 91.5f, 130, 172}
                         : std::vector<float>{0, 50, 87};
}

bool all_finite(const Full& m) {
  for (int i = 0; i < 16; ++i)
    if (!malus::is_finite(m(i / 4, i % 4))) return false;
  return true;
}

/// Components of a conductor's block by the library's equations, in double precision.
std::array<double, 4> library_terms(double cosine, double eta, double k) {
  const auto f = malus::fresnel_conductor(cosine, eta, k);
  return {f.mean(), f.half_difference(), f.re, f.im};
}

}  // namespace

TEST_CASE("renderer: the terms of conductors are those of the library") {
  constexpr float indices[] = {0, 1e-4f, 0.05f, 0.5f, 0.999f, 1, 1.001f, 1.5f, 7, 100, 1e4f};
  constexpr float cosines[] = {1e-6f, 1e-3f, 0.1f, 0.3f, 0.707f, 0.9f, 0.999f, 1};
  for (const float eta : indices)
    for (const float k : indices)
      for (const float c : cosines) {
        if (eta * eta + k * k < 1.0f / 16) continue;
        CAPTURE(eta);
        CAPTURE(k);
        CAPTURE(c);
        const auto terms = renderer::conductor_terms(c, Rgb(eta), Rgb(k));
        const auto expected = library_terms(c, eta, k);
        CHECK(std::abs(terms.mean[1] - expected[0]) < 2e-6);
        CHECK(std::abs(terms.half_difference[1] - expected[1]) < 2e-6);
        CHECK(std::abs(terms.re[1] - expected[2]) < 2e-6);
        CHECK(std::abs(terms.im[1] - expected[3]) < 2e-6);
      }
}

TEST_CASE("bsdf: directions follow the density they claim, from the camera and from the light") {
  Sampler sampler(21, 22, 23);
  int tests = 0;
  for (const Named& which : smooth_kinds({0.15f, 0.6f}))
    for (const float theta : angles(which.bsdf))
      for (const Tracing tracing : both_tracings) {
        CAPTURE(which.name);
        CAPTURE(theta);
        CAPTURE(static_cast<int>(tracing));
        Event e(sampler);
        e.look_from(theta, 35);
        const DrawTest t = test_draws(which, e, tracing, sampler);
        // Some 150 tests, each beyond 4.5 standard deviations by chance once in 300,000.
        CHECK(t.deviations < 4.5);
        // At a facet's critical angle, rounding may show in one draw of many.
        CHECK(t.inconsistent <= 2);
        CHECK(t.density + t.discrete <= 1.01);
        const bool has_mirror = std::holds_alternative<Plastic>(which.bsdf.kind());
        CHECK((t.discrete > 0.01) == has_mirror);
        ++tests;
      }
  CHECK(tests > 100);
}

TEST_CASE("bsdf: the matrix of two directions has the value's m00, and is physical") {
  Sampler sampler(24, 25, 26);
  for (const auto& [name, bsdf, roughness] : smooth_kinds({0.05f, 0.4f})) {
    CAPTURE(name);
    int lit = 0;
    for (int i = 0; i < 3000; ++i) {
      const Event e(sampler);
      BsdfSampleOf<Polarized> s;
      if (!bsdf.sample(e.hit, e.known, Tracing::from_camera, sampler, s) || s.is_delta) continue;
      const auto v = bsdf.value<Polarized>(e.hit, s.direction, e.known);
      if (!(v.m00[0] > 0)) continue;
      const Full m = bsdf.scattering<Polarized>(e.hit, s.direction, e.known, v);
      ++lit;
      if (!close(v.m00, m.m00(), 1e-4f)) FAIL_CHECK("m00 ", m.m00()[0], " of ", v.m00[0]);
      if (!(v.pdf_incident > 0) || !(v.pdf_exitant > 0)) FAIL_CHECK("a density is 0");
      if (!malus::is_physical(m, 1e-4f * malus::max_channel(v.m00) + 1e-6f))
        FAIL_CHECK("not physical");
      const auto u = bsdf.scattering<Unpolarized>(e.hit, s.direction, e.known, v);
      if (!(u == v.m00)) FAIL_CHECK("unpolarised");
    }
    CHECK(lit > 500);
  }
}

TEST_CASE(
    "bsdf: rough surfaces' matrices are the library's, however the surface lies in the world") {
  Sampler sampler(48, 49, 50);
  const Facets facets(MicrofacetShape::ggx, 0.2f, 0.6f);
  const Rgb one(1.0f);
  const Bsdf conductor = named("", RoughConductor{facets, gold_eta, gold_k, one}).bsdf;
  const Bsdf dielectric = named("", RoughDielectric{facets, 1.5f, one, one}).bsdf;
  int conducted = 0, reflected = 0, refracted = 0;
  for (int i = 0; i < 4000; ++i) {
    const bool conducting = i % 2 == 0;
    const Bsdf& bsdf = conducting ? conductor : dielectric;
    const Event e(sampler);
    BsdfSampleOf<Polarized> s;
    if (!bsdf.sample(e.hit, e.known, Tracing::from_camera, sampler, s)) continue;
    const Vec3 &incident = s.direction, &exitant = e.known;
    const LocalSpace space{Basis(e.hit.tangent, glm::cross(e.hit.normal, e.hit.tangent)),
                           e.hit.normal};
    const Vec3 wi = space.from_world(incident), wo = space.from_world(exitant);
    if (std::min(std::abs(wi.z), std::abs(wo.z)) < 0.02f) continue;
    const auto in = MuellerFrame::toward(-incident, Vec3(0.3f, 0.5f, 0.8f));
    const auto out = MuellerFrame::toward(exitant, Vec3(-0.2f, 0.9f, 0.1f));
    const auto local = [&](const MuellerFrame& f) {
      return MuellerFrame(space.from_world(f.x()), space.from_world(f.y()));
    };
    const auto v = bsdf.value<Polarized>(e.hit, incident, exitant);
    const Full world =
        Full(bsdf.scattering<Polarized>(e.hit, incident, exitant, v)).expressed_in(in, out);
    const Full library = Full(conducting ? malus::conductor_facets(facets, wi, wo, gold_eta, gold_k)
                                         : malus::dielectric_facets<Rgb>(facets, wi, wo, 1.5f))
                             .expressed_in(local(in), local(out));
    (conducting ? conducted : wi.z * wo.z > 0 ? reflected : refracted)++;
    const float scale = malus::max_channel(library.m00());
    for (int r = 0; r < 4; ++r)
      for (int c = 0; c < 4; ++c)
        if (!close(library(r, c) / scale, world(r, c) / scale, 1e-3f, 1.0f))
          FAIL_CHECK("component ", r, " ", c, ": ", world(r, c)[0], ", ", library(r, c)[0]);
  }
  CHECK(conducted > 500);
  CHECK(reflected > 100);
  CHECK(refracted > 500);
}

TEST_CASE("bsdf: reversed light takes the transposed matrix, n² weighed") {
  // Axes x, y become x, −y: M' = Q Mᵀ Q, Q = diag(1, 1, −1, 1) (derived with the library's test).
  Sampler sampler(27, 28, 29);
  constexpr float q[4] = {1, 1, -1, 1};
  for (const auto& [name, bsdf, roughness] : smooth_kinds({0.2f, 0.7f})) {
    CAPTURE(name);
    int lit = 0, refracted = 0, polarized = 0;
    for (int i = 0; i < 2000; ++i) {
      const Event e(sampler);
      BsdfSampleOf<Polarized> s;
      if (!bsdf.sample(e.hit, e.known, Tracing::from_light, sampler, s) || s.is_delta) continue;
      const Vec3 &a = e.known, &b = s.direction;
      const float cos_a = glm::dot(e.hit.normal, a), cos_b = glm::dot(e.hit.normal, b);
      if (std::min(std::abs(cos_a), std::abs(cos_b)) < 0.02f) continue;
      const auto there = bsdf.value<Polarized>(e.hit, a, b),
                 back = bsdf.value<Polarized>(e.hit, b, a);
      const auto in = MuellerFrame::toward(-a, Vec3(0.3f, 0.5f, 0.8f));
      const auto out = MuellerFrame::toward(b, Vec3(-0.2f, 0.9f, 0.1f));
      const Full m = Full(bsdf.scattering<Polarized>(e.hit, a, b, there)).expressed_in(in, out);
      const Full r = Full(bsdf.scattering<Polarized>(e.hit, b, a, back))
                         .expressed_in({out.x(), -out.y()}, {in.x(), -in.y()});
      ++lit;
      if (cos_a * cos_b < 0) ++refracted;
      const float n2 = std::pow(index_at(bsdf, cos_a) / index_at(bsdf, cos_b), 2.0f);
      const float scale = malus::max_channel(back.m00);
      for (int k = 0; k < 4; ++k)
        for (int l = 0; l < 4; ++l)
          for (std::size_t c = 0; c < 3; ++c)
            if (!(std::abs(r(k, l)[c] - n2 * q[k] * q[l] * m(l, k)[c]) <= 1e-3f * scale + 1e-6f))
              FAIL_CHECK("component ", k, " ", l, ": ", r(k, l)[c], ", ", n2 * m(l, k)[c]);
      if (std::abs(m(1, 2)[0]) > 0.02f * scale) ++polarized;
    }
    CHECK(lit > 500);
    if (transmits(bsdf)) CHECK(refracted > 200);
    if (bsdf.polarizes() && !std::holds_alternative<Plastic>(bsdf.kind())) CHECK(polarized > 20);
  }
}

TEST_CASE("bsdf: no more light leaves than came, and draws bring as much as there is") {
  Sampler sampler(30, 31, 32);
  for (const auto& [name, bsdf, roughness] : smooth_kinds({0.2f, 0.7f}))
    for (const float theta : angles(bsdf))
      for (const Tracing tracing : both_tracings) {
        CAPTURE(name);
        CAPTURE(theta);
        Event e(sampler);
        e.look_from(theta, 35);
        constexpr int samples = 20000;
        double sum = 0, sum2 = 0, mirrored = 0;
        for (int i = 0; i < samples; ++i) {
          BsdfSampleOf<Polarized> s;
          if (!bsdf.sample(e.hit, e.known, tracing, sampler, s)) continue;
          if (s.is_delta) {
            mirrored = static_cast<double>(s.weight[1] * s.pdf);
            continue;
          }
          // Radiance is less by n² on the thinner side of a refraction; undo that.
          const float n2 = tracing == Tracing::from_camera ? s.eta * s.eta : 1.0f;
          const auto w = static_cast<double>(s.weight[1] * n2);
          sum += w, sum2 += w * w;
        }
        const double mean = sum / samples;
        const double error = std::sqrt((sum2 / samples - mean * mean) / samples);
        double albedo = 0;
        for (const double part : integrate_by_bins(
                 [&](float z, float phi) {
                   const Vec3 w = e.direction(z, phi);
                   const Flow flow(e.known, w, tracing);
                   const float n =
                       index_at(bsdf, z) / index_at(bsdf, glm::dot(e.hit.normal, e.known));
                   return bsdf.value<Polarized>(e.hit, flow.incident, flow.exitant).m00[1] *
                          std::abs(z) * (tracing == Tracing::from_camera ? n * n : 1.0f);
                 },
                 1e-5))
          albedo += part;
        CHECK(std::abs(mean - albedo) < 5 * error + 2e-3);
        CHECK(albedo + mirrored <= 1.0005);
      }
}

TEST_CASE("bsdf: a white base under a coat that absorbs nothing gives all light back") {
  Sampler sampler(33, 34, 35);
  for (const float eta : {1.2f, 1.5f, 2.4f, 0.7f}) {
    const Bsdf bsdf = plastic(eta, true, Rgb(1.0f)).bsdf;
    for (const float theta : {0.0f, 30.0f, 60.0f, 80.0f}) {
      Event e(sampler);
      e.look_from(theta, 35);
      if (eta < 1 && std::sin(theta * pi / 180) > eta) continue;  // nothing gets in at all
      const double c = std::cos(static_cast<double>(theta * pi / 180));
      double albedo = malus::fresnel_dielectric(c, static_cast<double>(eta)).mean();
      for (const double part : integrate_by_bins(
               [&](float z, float phi) {
                 return bsdf.value<Polarized>(e.hit, e.direction(z, phi), e.known).m00[0] *
                        std::abs(z);
               },
               1e-6))
        albedo += part;
      CAPTURE(eta);
      CHECK(albedo == doctest::Approx(1).epsilon(1e-3));
    }
  }
}

TEST_CASE("bsdf: that is so up to the ends of the indices that are allowed") {
  Sampler sampler(33, 34, 35);
  for (const float eta : {0.01f, 100.0f}) {
    CAPTURE(eta);
    const Bsdf bsdf = plastic(eta, true, Rgb(1.0f)).bsdf;
    Event e(sampler);
    e.look_from(0, 0);
    double albedo = malus::fresnel_dielectric(1.0, static_cast<double>(eta)).mean();
    // No light leaves a rarer coat but near the normal: cosines from there on, in even steps.
    const double lowest = eta < 1 ? std::sqrt(1 - static_cast<double>(eta) * eta) : 0;
    constexpr int steps = 512;
    for (int i = 0; i < steps; ++i) {
      const double z = lowest + (1 - lowest) * (i + 0.5) / steps;
      const auto value =
          bsdf.value<Unpolarized>(e.hit, e.direction(static_cast<float>(z), 1.0f), e.known);
      albedo += static_cast<double>(value.m00[0]) * z * (1 - lowest) / steps * 2 *
                static_cast<double>(pi);
    }
    CHECK(albedo == doctest::Approx(1).epsilon(1e-3));
  }
}

TEST_CASE("bsdf: values stay finite from alpha = 0.001 to 1 and at grazing directions") {
  Sampler sampler(36, 37, 38);
  int directions_drawn = 0;
  for (const auto& [name, bsdf, roughness] : smooth_kinds({0.001f, 0.03f, 1.0f}))
    for (const float theta : {0.0f, 0.01f, 45.0f, 89.9f, 89.9999f, 90.001f, 135.0f, 180.0f})
      for (const Tracing tracing : both_tracings) {
        CAPTURE(name);
        CAPTURE(theta);
        Event e(sampler);
        e.look_from(theta, 35);
        for (int i = 0; i < 300; ++i) {
          BsdfSampleOf<Polarized> s;
          s.direction =
              e.direction(i % 3 ? 2 * sampler.next_1d() - 1 : 1e-5f, 6 * sampler.next_1d());
          const bool drawn = bsdf.sample(e.hit, e.known, tracing, sampler, s);
          const Flow flow(e.known, s.direction, tracing);
          const auto v = bsdf.value<Polarized>(e.hit, flow.incident, flow.exitant);
          const Full m = bsdf.scattering<Polarized>(e.hit, flow.incident, flow.exitant, v);
          bool good = malus::is_finite(v.m00) && malus::is_finite(v.pdf_incident) &&
                      malus::is_finite(v.pdf_exitant) && v.pdf_incident >= 0 &&
                      v.pdf_exitant >= 0 && all_finite(m);
          directions_drawn += drawn;
          if (drawn)
            good = good && malus::is_finite(s.weight) && s.pdf > 0 && malus::is_finite(s.pdf) &&
                   malus::is_finite(s.reverse_pdf) && s.weight[0] >= 0 &&
                   all_finite(bsdf.weight<Polarized>(e.hit, e.known, tracing, s));
          if (!good) FAIL_CHECK("m00 ", v.m00[0], " pdfs ", v.pdf_incident, " ", v.pdf_exitant);
        }
      }
  CHECK(directions_drawn > 10000);
}

TEST_CASE("bsdf: unpolarised light finds Mitsuba's values") {
  const auto metal = [](std::string_view name) { return *conductor_by_name(name); };
  const auto beckmann = MicrofacetShape::beckmann, ggx = MicrofacetShape::ggx;
  const Rgb one(1.0f), base(0.2f, 0.5f, 0.8f);
  // Mitsuba masks Gaussian slopes by a fit of 0.35 % a direction, and has the mean reflectance of
  // plastic's coat by one of 0.2 %; the rest is exact.
  struct Case {
    Named named;
    float tolerance;
  };
  const Case cases[] = {
      {named("", RoughConductor{{ggx, 0.3f, 0.3f}, metal("Au").eta, metal("Au").k, one}), 1e-4f},
      {named("",
             RoughConductor{
                 {ggx, 0.1f, 0.4f}, metal("Cu").eta, metal("Cu").k, Rgb(0.9f, 0.8f, 0.7f)}),
       1e-4f},
      {named("", RoughConductor{{beckmann, 0.2f, 0.2f}, metal("Ag").eta, metal("Ag").k, one}),
       7e-3f},
      {named("", RoughDielectric{{ggx, 0.3f, 0.3f}, 1.5f, one, one}), 1e-4f},
      {named("", RoughDielectric{{beckmann, 0.5f, 0.25f}, 1.33f, one, one}), 7e-3f},
      {plastic(1.5f, false, base), 2e-3f},
      {plastic(1.9f, true, base), 2e-3f},
      {named("", PolarizedPlastic{{ggx, 0.25f, 0.25f}, 1.5f, base, one}), 1e-4f},
      {named(
           "",
           PolarizedPlastic{{beckmann, 0.1f, 0.1f}, 1.49f / 1.000277f, Rgb(0.1f, 0.1f, 0.9f), one}),
       7e-3f},
  };
  Sampler sampler(39, 40, 41);
  for (const MitsubaRow& row : mitsuba_rows) {
    CAPTURE(row.which);
    CAPTURE(row.theta_o);
    CAPTURE(row.theta_i);
    Event e(sampler);
    e.look_from(row.theta_i, row.phi_i);
    const Vec3 incident = e.known;
    e.look_from(row.theta_o, row.phi_o);
    const Case& c = cases[row.which];
    const Rgb f = c.named.bsdf.value<Polarized>(e.hit, incident, e.known).m00;
    for (std::size_t i = 0; i < 3; ++i)
      CHECK(std::abs(f[i] - row.value[i]) <= c.tolerance * row.value[i]);
  }
}

TEST_CASE("bsdf: polarised light finds Mitsuba's matrices") {
  const auto ggx = MicrofacetShape::ggx;
  const Rgb one(1.0f);
  const Bsdf bsdfs[] = {
      named("", RoughConductor{{ggx, 0.3f, 0.3f}, Rgb(0.2f), Rgb(3.9f), one}).bsdf,
      named("", PolarizedPlastic{{ggx, 0.25f, 0.25f}, 1.5f, Rgb(0.5f), one}).bsdf};
  Hit hit;
  hit.normal = hit.geometric_normal = Vec3(0, 0, 1);
  for (const MitsubaMatrix& row : mitsuba_matrices) {
    const Bsdf& bsdf = bsdfs[row.which];
    const auto v = bsdf.value<Polarized>(hit, row.incident, row.exitant);
    const Full m = Full(bsdf.scattering<Polarized>(hit, row.incident, row.exitant, v))
                       .expressed_in(MuellerFrame::from_direction_and_x(-row.incident, row.enter_x),
                                     MuellerFrame::from_direction_and_x(row.exitant, row.exit_x));
    for (int r = 0; r < 4; ++r)
      for (int c = 0; c < 4; ++c) CHECK(std::abs(m(r, c)[0] - row.m[r][c]) <= 1e-5f * row.m[0][0]);
  }
}

TEST_CASE(
    "bsdf: a facet of a rough dielectric reflects and refracts as a smooth dielectric there") {
  Sampler sampler(51, 52, 53);
  for (const float eta : {1.5f, 1 / 1.33f}) {
    const Bsdf bsdf = rough_dielectric(MicrofacetShape::beckmann, 0.5f, 0.5f, eta).bsdf;
    int reflected = 0, refracted = 0;
    for (int i = 0; i < 3000; ++i) {
      const Event e(sampler);
      BsdfSampleOf<Polarized> s;
      if (!bsdf.sample(e.hit, e.known, Tracing::from_camera, sampler, s)) continue;
      const Vec3 &incident = s.direction, &exitant = e.known;
      const float cos_i = glm::dot(e.hit.normal, incident);
      const bool refracts = cos_i * glm::dot(e.hit.normal, exitant) < 0;
      // Indices before and behind the interface, for the light.
      const float behind = cos_i > 0 ? eta : 1 / eta;
      Vec3 h = glm::normalize(refracts ? incident + behind * exitant : incident + exitant);
      if (glm::dot(h, incident) < 0) h = -h;
      const float c = std::min(glm::dot(h, incident), 1.0f);
      if (c < 0.05f || (refracts && malus::refracted_cosine(c, behind) < 0.1f)) continue;
      const auto frames = specular_frames(h, incident, exitant);
      const auto t =
          refracts ? malus::fresnel_transmission(c, behind) : malus::fresnel_dielectric(c, behind);
      const auto v = bsdf.value<Polarized>(e.hit, incident, exitant);
      const Full m = bsdf.scattering<Polarized>(e.hit, incident, exitant, v);
      const Full smooth = malus::fresnel_block<Rgb>(t, frames.enter, frames.exit);
      const Full there = m.expressed_in(frames.enter, frames.exit);
      (refracts ? refracted : reflected)++;
      for (int r = 0; r < 4; ++r)
        for (int k = 0; k < 4; ++k)
          if (!close(there(r, k) / there.m00(), smooth(r, k) / smooth.m00(), 3e-3f, 1.0f))
            FAIL_CHECK("component ", r, " ", k, ": ", there(r, k)[0] / there.m00()[0], ", ",
                       smooth(r, k)[0] / smooth.m00()[0]);
    }
    CHECK(reflected > 50);
    CHECK(refracted > 500);
  }
}

TEST_CASE("bsdf: the light of a plastic's base is polarised by the coat that it leaves through") {
  // T_out · D · T_in: unpolarised light comes back polarised along the plane of emission, by as
  // much as refraction out of the coat does that; its azimuth doesn't matter, nor does its
  // polarisation but for how much of it gets in.
  Sampler sampler(42, 43, 44);
  const Bsdf smooth = plastic(1.5f, false, Rgb(0.5f)).bsdf;
  const Bsdf rough =
      named("", PolarizedPlastic{{MicrofacetShape::ggx, 0.1f, 0.1f}, 1.5f, Rgb(0.5f), Rgb(0.0f)})
          .bsdf;
  for (const Bsdf& bsdf : {smooth, rough})
    for (const float theta : {20.0f, 60.0f, 80.0f})
      for (const float theta_in : {0.0f, 56.31f, 75.0f}) {
        CAPTURE(theta);
        CAPTURE(theta_in);
        Event e(sampler);
        e.look_from(theta_in, 250);
        const Vec3 incident = e.known;
        e.look_from(theta, 35);
        const auto v = bsdf.value<Polarized>(e.hit, incident, e.known);
        const auto s_out = glm::normalize(glm::cross(e.hit.normal, e.known));
        const auto s_in =
            glm::normalize(glm::cross(theta_in > 0 ? e.hit.normal : e.hit.tangent, incident));
        const Full m = Full(bsdf.scattering<Polarized>(e.hit, incident, e.known, v))
                           .expressed_in(MuellerFrame::from_direction_and_x(-incident, s_in),
                                         MuellerFrame::from_direction_and_x(e.known, s_out));
        const auto t = [](float degrees) {
          return malus::fresnel_transmission(std::cos(degrees * pi / 180), 1.5f);
        };
        const auto out = t(theta), in = t(theta_in);
        const float d_out = (out.s - out.p) / (out.s + out.p), d_in = (in.s - in.p) / (in.s + in.p);
        CHECK(d_out < 0);
        const float expected[4][4] = {
            {1, d_in, 0, 0}, {d_out, d_out * d_in, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}};
        for (int r = 0; r < 4; ++r)
          for (int c = 0; c < 4; ++c)
            CHECK(std::abs(m(r, c)[1] / m.m00()[1] - expected[r][c]) < 2e-4f);
      }
}

TEST_CASE("bsdf: what a plastic's coat mirrors is Fresnel's, whichever way it is traced") {
  Sampler sampler(45, 46, 47);
  const Bsdf bsdf = plastic(1.5f, false, Rgb(0.5f)).bsdf;
  for (const Tracing tracing : both_tracings) {
    Event e(sampler);
    e.look_from(50, 35);
    int mirrored = 0;
    for (int i = 0; i < 1000; ++i) {
      BsdfSampleOf<Polarized> s;
      REQUIRE(bsdf.sample(e.hit, e.known, tracing, sampler, s));
      if (!s.is_delta) continue;
      ++mirrored;
      const Flow flow(e.known, s.direction, tracing);
      const Full m = bsdf.weight<Polarized>(e.hit, e.known, tracing, s);
      const auto f = malus::fresnel_dielectric(std::cos(50 * pi / 180), 1.5f);
      CHECK(std::abs(s.weight[0] * s.pdf - f.mean()) < 1e-5f);
      CHECK(s.reverse_pdf == s.pdf);
      CHECK(std::abs(m(0, 0)[0] * s.pdf - f.mean()) < 1e-5f);
      CHECK(std::abs(m(0, 1)[0] * s.pdf - (f.s - f.p) / 2) < 1e-5f);
      CHECK(std::abs(m(2, 2)[0] * s.pdf - f.re) < 1e-5f);
      CHECK(glm::length(s.direction - reflect_about(e.known, e.hit.normal)) < 1e-5f);
      CHECK(glm::length(m.exit().direction() / glm::length(m.exit().direction()) - flow.exitant) <
            1e-4f);
      CHECK(glm::length(m.enter().direction() / glm::length(m.enter().direction()) +
                        flow.incident) < 1e-4f);
    }
    CHECK(mirrored > 50);
  }
}
