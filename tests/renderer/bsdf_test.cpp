// SPDX-License-Identifier: MIT
// Every BSDF by itself: what it draws is what it says it draws, and its matrix carries the weight
// that unpolarised light has.
#include <doctest/doctest.h>

#include <complex>
#include <vector>

#include "bsdf_support.hpp"
#include "bsdfs/material.hpp"
#include "scene/build.hpp"
#include "scene_files.hpp"

using namespace bsdf_test;

namespace {

std::vector<Named> all_kinds() {
  LinearPolarizer polarizer;
  polarizer.theta = 0.3f;
  LinearPolarizer grey = polarizer;
  grey.polarizing = false;
  LinearRetarder retarder;
  retarder.theta = 0.4f;
  retarder.delta = 1.1f;
  CircularPolarizer left;
  left.hand = malus::Handedness::left;
  std::vector<Named> all = smooth_kinds({0.2f});
  all.push_back(named("conductor", Conductor{gold_eta, gold_k, Rgb(0.9f, 0.8f, 1.0f)}));
  all.push_back(named("mirror", Conductor{}));
  all.push_back(named("dielectric", Dielectric{1.5f, Rgb(0.9f), Rgb(0.8f)}));
  all.push_back(named("bubble", Dielectric{1 / 1.33f, Rgb(1.0f), Rgb(1.0f)}));
  all.push_back(named("polarizer", polarizer));
  all.push_back(named("grey polarizer", grey));
  all.push_back(named("retarder", retarder));
  all.push_back(named("right circular", CircularPolarizer{}));
  all.push_back(named("left circular", left));
  all.push_back(named("null", NullSurface{}));
  return all;
}

/// The BSDF of a scene file's text, on line 2 of scene.xml.
Bsdf::Kind read_kind(const std::string& type, const std::string& content) {
  const auto scene = scene_test::read("<bsdf type=\"" + type + "\">" + content + "</bsdf>");
  const auto object = scene->only_child("bsdf");
  std::deque<Texture> none;
  TextureFactory textures(none);
  auto kind = make_bsdf_kind(*object, textures);
  object->reject_unknown();
  return kind;
}
std::string refusal(const std::string& type, const std::string& content) {
  return scene_test::error_of([&] { read_kind(type, content); });
}
std::string number(const std::string& name, const std::string& value) {
  return "<float name=\"" + name + "\" value=\"" + value + "\"/>";
}
std::string word(const std::string& name, const std::string& value) {
  return "<string name=\"" + name + "\" value=\"" + value + "\"/>";
}

}  // namespace

TEST_CASE("bsdf: the first component of every weight is the weight of unpolarised light") {
  Sampler sampler(1, 2, 3);
  for (const auto& [name, bsdf, roughness] : all_kinds())
    for (const Tracing tracing : both_tracings) {
      CAPTURE(name);
      int drawn = 0;
      for (int i = 0; i < 2000; ++i) {
        const Event e(sampler);
        BsdfSampleOf<Polarized> s;
        if (!bsdf.sample(e.hit, e.known, tracing, sampler, s)) continue;
        ++drawn;
        const Rgb u = bsdf.weight<Unpolarized>(e.hit, e.known, tracing, s);
        const auto m = bsdf.weight<Polarized>(e.hit, e.known, tracing, s);
        if (!close(u, m.m00(), 1e-4f) || !close(u, s.weight, 1e-6f) ||
            !(std::abs(glm::length(s.direction) - 1) < 1e-5f))
          FAIL_CHECK("m00 ", m.m00()[0], ", weight ", s.weight[0]);
      }
      CHECK(drawn > 700);
    }
}

TEST_CASE("bsdf: a sheet does to a shadow ray's light what it does to a path's") {
  Sampler sampler(4, 5, 6);
  for (const auto& [name, bsdf, roughness] : all_kinds())
    for (const Tracing tracing : both_tracings) {
      if (!bsdf.is_sheet()) continue;
      CAPTURE(name);
      const Event e(sampler);
      BsdfSampleOf<Polarized> s;
      REQUIRE(bsdf.sample(e.hit, e.known, tracing, sampler, s));
      CHECK(s.direction == -e.known);
      const auto a = bsdf.weight<Polarized>(e.hit, e.known, tracing, s);
      // The light goes towards the camera; away from what is known of it.
      const auto b =
          bsdf.transmit<Polarized>(e.hit, tracing == Tracing::from_camera ? e.known : -e.known);
      for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c) CHECK(a(r, c)[0] == b(r, c)[0]);
    }
}

TEST_CASE(
    "bsdf: a dielectric's matrices are Fresnel's, divided by the chance they are drawn with") {
  Sampler sampler(10, 11, 12);
  const Bsdf bsdf = named("", Dielectric{1.5f, Rgb(1.0f), Rgb(1.0f)}).bsdf;
  int reflections = 0, refractions = 0;
  for (int i = 0; i < 4000; ++i) {
    const Tracing tracing = both_tracings[i % 2];
    const Event e(sampler);
    BsdfSampleOf<Polarized> s;
    if (!bsdf.sample(e.hit, e.known, tracing, sampler, s)) continue;
    using Complex = std::complex<double>;
    const double cos_signed = static_cast<double>(glm::dot(e.hit.normal, e.known));
    const double c = std::abs(cos_signed), eta = cos_signed > 0 ? 1.5 : 1 / 1.5;
    const Complex q = std::sqrt(Complex(eta * eta - 1 + c * c));
    const Complex rs = (c - q) / (c + q), rp = (eta * eta * c - q) / (eta * eta * c + q);
    const auto m = bsdf.weight<Polarized>(e.hit, e.known, tracing, s);
    const bool reflected =
        static_cast<double>(glm::dot(e.hit.normal, s.direction)) * cos_signed > 0;
    (reflected ? reflections : refractions)++;
    double is, ip;
    Complex product;
    if (reflected) {
      is = std::norm(rs), ip = std::norm(rp), product = std::conj(rs) * rp;
    } else {
      // Powers transmitted; radiance out of the denser medium is 1/eta² of that within.
      const double ts = 2 * c / std::abs(c + q), tp = 2 * eta * c / std::abs(eta * eta * c + q);
      const double factor = q.real() / c / (tracing == Tracing::from_camera ? eta * eta : 1.0);
      is = ts * ts * factor, ip = tp * tp * factor, product = ts * tp * factor;
    }
    const double pdf = static_cast<double>(s.pdf);
    const auto at = [&](int r, int k) { return static_cast<double>(m(r, k)[0]) * pdf; };
    const double tolerance = c < 0.05 ? 5e-3 : 2e-4;
    if (std::abs(at(0, 0) - (is + ip) / 2) > tolerance ||
        std::abs(at(0, 1) - (is - ip) / 2) > tolerance ||
        std::abs(at(2, 2) - product.real()) > tolerance ||
        std::abs(at(3, 2) + product.imag()) > tolerance ||
        std::abs(at(2, 3) - product.imag()) > tolerance || at(0, 2) != 0 || at(3, 1) != 0)
      FAIL_CHECK("at the cosine ", cos_signed, reflected ? ", reflected" : ", refracted");
  }
  CHECK(reflections > 500);
  CHECK(refractions > 1000);
}

TEST_CASE("bsdf: what is not a front reflects nothing, and a twosided material flips to be one") {
  Sampler sampler(1, 1, 1);
  Hit hit;
  hit.normal = hit.geometric_normal = Vec3(0, 0, 1);
  hit.tangent = Vec3(1, 0, 0);
  const Vec3 below = glm::normalize(Vec3(0.3f, 0.2f, -1));
  BsdfSampleOf<Polarized> s;
  for (const auto& [name, bsdf, roughness] : smooth_kinds({0.2f})) {
    if (std::holds_alternative<RoughDielectric>(bsdf.kind())) continue;
    CAPTURE(name);
    for (const Tracing tracing : both_tracings)
      CHECK_FALSE(bsdf.sample(hit, below, tracing, sampler, s));
    for (const Vec3& other : {below, -below})
      for (const BsdfValue& v :
           {bsdf.value<Polarized>(hit, below, other), bsdf.value<Polarized>(hit, other, below)}) {
        CHECK(v.pdf_incident == 0);
        CHECK(v.pdf_exitant == 0);
        CHECK(v.m00[0] == 0);
      }
  }

  const Bsdf front = named("", Diffuse{Rgb(0.25f)}).bsdf, back = named("", Conductor{}).bsdf;
  const Material both{&front, &back};
  Hit seen = hit;
  CHECK(&both.facing(seen, -below) == &front);
  CHECK(seen.normal == hit.normal);
  CHECK(&both.facing(seen, below) == &back);
  CHECK(seen.normal == -hit.normal);
  CHECK(back.sample(seen, below, Tracing::from_camera, sampler, s));
  CHECK(glm::dot(s.direction, seen.normal) > 0);
}

TEST_CASE("bsdf: scene files' rough and plastic BSDFs have Mitsuba's names and defaults") {
  const auto plain = std::get<RoughConductor>(read_kind("roughconductor", ""));
  CHECK(plain.facets.shape() == MicrofacetShape::beckmann);
  CHECK(plain.facets.alpha_x() == 0.1f);
  CHECK(plain.eta == Rgb(0.0f));
  CHECK(plain.k == Rgb(1.0f));
  const auto brushed = std::get<RoughConductor>(
      read_kind("roughconductor", word("material", "Al") + word("distribution", "ggx") +
                                      number("alpha_u", "0.05") + number("alpha_v", "0.3") +
                                      "<boolean name=\"sample_visible\" value=\"false\"/>"));
  CHECK(brushed.facets.shape() == MicrofacetShape::ggx);
  CHECK(brushed.facets.alpha_x() == 0.05f);
  CHECK(brushed.facets.alpha_y() == 0.3f);
  CHECK(brushed.needs_tangent());
  CHECK(brushed.k == Rgb(9.22381f, 6.2695f, 4.837f));
  CHECK(std::get<Conductor>(read_kind("conductor", word("material", "Au"))).eta ==
        Rgb(0.143036f, 0.375307f, 1.44205f));
  CHECK(std::get<RoughDielectric>(read_kind("roughdielectric", "")).eta ==
        doctest::Approx(1.5046 / 1.000277));
  const auto pplastic = std::get<PolarizedPlastic>(read_kind("pplastic", number("alpha", "0.2")));
  CHECK(pplastic.eta == doctest::Approx(1.49 / 1.000277));
  CHECK(pplastic.diffuse_reflectance.constant == Rgb(0.5f));
  CHECK(pplastic.facets.alpha_y() == 0.2f);
  const auto plastic = std::get<Plastic>(read_kind(
      "plastic", "<rgb name=\"diffuse_reflectance\" value=\"0.1, 0.27, 0.36\"/>" +
                     number("int_ior", "1.9") + "<boolean name=\"nonlinear\" value=\"true\"/>"));
  CHECK(plastic.diffuse_reflectance.constant == Rgb(0.1f, 0.27f, 0.36f));
}

TEST_CASE("bsdf: scene files' reflectances and transmittances go where they are named") {
  const std::string mirror = number("specular_reflectance", "0.25"),
                    window = number("specular_transmittance", "0.75");
  const auto smooth = std::get<Dielectric>(read_kind("dielectric", mirror + window));
  CHECK(smooth.specular_reflectance.constant == Rgb(0.25f));
  CHECK(smooth.specular_transmittance.constant == Rgb(0.75f));
  const auto rough = std::get<RoughDielectric>(read_kind("roughdielectric", mirror + window));
  CHECK(rough.specular_reflectance.constant == Rgb(0.25f));
  CHECK(rough.specular_transmittance.constant == Rgb(0.75f));
  CHECK(std::get<Conductor>(read_kind("conductor", mirror)).specular_reflectance.constant ==
        Rgb(0.25f));
  CHECK(
      std::get<RoughConductor>(read_kind("roughconductor", mirror)).specular_reflectance.constant ==
      Rgb(0.25f));
  const std::string base = number("diffuse_reflectance", "0.125");
  const auto plastic = std::get<Plastic>(read_kind("plastic", mirror + base));
  CHECK(plastic.specular_reflectance.constant == Rgb(0.25f));
  CHECK(plastic.diffuse_reflectance.constant == Rgb(0.125f));
  const auto pplastic = std::get<PolarizedPlastic>(read_kind("pplastic", mirror + base));
  CHECK(pplastic.specular_reflectance.constant == Rgb(0.25f));
  CHECK(pplastic.diffuse_reflectance.constant == Rgb(0.125f));
}

TEST_CASE(
    "bsdf: what a rough or plastic BSDF cannot be is told with its line and what is allowed") {
  const auto has = [](const std::string& message, std::initializer_list<std::string_view> parts) {
    for (const auto part : parts) CHECK_MESSAGE(message.find(part) != std::string::npos, message);
  };
  has(refusal("roughconductor", word("material", "Unobtainium")),
      {"scene.xml:2", "Unobtainium", "allowed: none, Ag, Al", "Cu", "W"});
  has(refusal("conductor", word("material", "Cu") + number("k", "2")),
      {"scene.xml:2", "not by both"});
  has(refusal("roughconductor", number("k", "0")), {"eta and k are both 0"});
  has(refusal("roughconductor", word("distribution", "phong")), {"phong", "beckmann", "ggx"});
  has(refusal("roughdielectric", number("alpha", "0")), {"alpha", "allowed: 1e-04 to 10"});
  has(refusal("roughdielectric", number("alpha_u", "0.2")), {"both or neither"});
  has(refusal("pplastic",
              number("alpha", "0.2") + number("alpha_u", "0.2") + number("alpha_v", "0.2")),
      {"not by both"});
  has(refusal("roughdielectric", number("int_ior", "1.5") + number("ext_ior", "1.5")),
      {"no interface"});
  has(refusal("plastic", number("alpha", "0.2")), {"unknown parameter \"alpha\"", "nonlinear"});
  has(refusal("plastic", number("diffuse_reflectance", "1.2")), {"diffuse_reflectance", "1.2"});
  has(refusal("ruffconductor", ""), {"known are", "roughconductor", "pplastic"});
}

TEST_CASE("bsdf: indices of refraction are above 0 and of a ratio that single precision holds") {
  for (const std::string type : {"dielectric", "roughdielectric", "plastic", "pplastic"}) {
    CAPTURE(type);
    const auto error = [&](const std::string& inner, const std::string& outer) {
      return refusal(type, number("int_ior", inner) + number("ext_ior", outer));
    };
    CHECK(error("100", "1") == "no error");
    CHECK(error("0.02", "2") == "no error");
    CHECK_MESSAGE_HAS(error("0", "1"), "scene.xml:2: ", "\"int_ior\" is 0; allowed:", "above 0");
    CHECK_MESSAGE_HAS(error("1", "-1.5"), "\"ext_ior\" is -1.5; allowed:");
    CHECK_MESSAGE_HAS(error("150", "1"), "scene.xml:2: ", "inside, 150,", "outside, 1,", "is 150; ",
                      "allowed: 0.01 to 100");
    CHECK_MESSAGE_HAS(error("1e-9", "1"), "1e-09", "allowed: 0.01 to 100");
    CHECK_MESSAGE_HAS(error("1e30", "1e-300"), "allowed: 0.01 to 100");
    CHECK_MESSAGE_HAS(refusal(type, number("ext_ior", "1e4")), "outside, 10000,", "0.01 to 100");
  }
}
