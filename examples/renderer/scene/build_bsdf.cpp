// SPDX-License-Identifier: MIT
#include <array>
#include <numbers>
#include <string_view>
#include <utility>

#include "build.hpp"
#include "conductor_data.hpp"
#include "text.hpp"

namespace renderer {

namespace {

float radians(double degrees) { return static_cast<float>(degrees * std::numbers::pi / 180); }

Rgb reflectance(const Object& o, std::string_view name, double otherwise = 1) {
  return to_rgb(o.color_in(name, glm::dvec3(otherwise), 0, 1));
}

/// Indices of refraction at 589 nm that scene files give by name: Mitsuba's table.
constexpr std::array<std::pair<std::string_view, double>, 20> named_indices{{
    {"vacuum", 1.0},      {"helium", 1.000036},        {"hydrogen", 1.000132},
    {"air", 1.000277},    {"carbon dioxide", 1.00045}, {"water", 1.3330},
    {"acetone", 1.36},    {"ethanol", 1.361},          {"carbon tetrachloride", 1.461},
    {"glycerol", 1.4729}, {"benzene", 1.501},          {"silicone oil", 1.52045},
    {"bromine", 1.661},   {"water ice", 1.31},         {"fused quartz", 1.458},
    {"pyrex", 1.470},     {"acrylic glass", 1.49},     {"polypropylene", 1.49},
    {"bk7", 1.5046},      {"diamond", 2.419},
}};

}  // namespace

double index_of_refraction(const Object& o, std::string_view name, std::string_view otherwise) {
  if (o.has(name) && o.kind_of(name) != ValueKind::string) {
    const double index = o.number(name);
    if (index > 0) return index;
    o.fail(name, "the parameter " + in_quotes(name) + " is " + shown(index) +
                     "; allowed: an index of refraction above 0, or a material's name");
  }
  const std::string material = o.string(name, otherwise);
  for (const auto& [known, index] : named_indices)
    if (known == material) return index;
  std::string list;
  for (const auto& entry : named_indices)
    list += (list.empty() ? "" : ", ") + std::string(entry.first);
  o.fail(name, "unknown material \"" + material + "\"; give a number or one of " + list);
}

namespace {

Bsdf::Kind make_diffuse(const Object& o, TextureFactory& textures) {
  return Diffuse{textures.color(o, "reflectance", 0.5)};
}

/// eta and k, or a material's name; of nothing, an ideal mirror.
ConductorIndex conductor_index(const Object& o) {
  const std::string name = o.string("material", "none");
  const bool given = o.has("eta") || o.has("k");
  const glm::dvec3 eta = o.color_in("eta", glm::dvec3(0), 0, 1e4);
  const glm::dvec3 k = o.color_in("k", glm::dvec3(1), 0, 1e4);
  const ConductorIndex index{to_rgb(eta), to_rgb(k)};
  for (int i = 0; i < 3; ++i) {
    const auto channel = static_cast<std::size_t>(i);
    if (index.eta[channel] == 0 && index.k[channel] == 0)
      o.fail("k", "eta and k are both 0 in the channel " + std::string(1, "RGB"[i]) +
                      ", as single precision holds " + shown(eta[i]) + " and " + shown(k[i]) +
                      "; allowed: one of them above 0");
  }
  if (name == "none") return index;
  if (given)
    o.fail("material", "a conductor is given by its material or by eta and k, not by both");
  const auto known = conductor_by_name(name);
  if (!known)
    o.fail("material", "unknown material \"" + name + "\"; allowed: none, " + conductor_names());
  return *known;
}

Bsdf::Kind make_conductor(const Object& o, TextureFactory& textures) {
  const ConductorIndex index = conductor_index(o);
  return Conductor{index.eta, index.k, textures.color(o, "specular_reflectance", 1)};
}

/// In between, a coat over a white base takes and makes no light beyond 2e-4, by single precision;
/// farther out, what gets out of a plastic's coat is the difference of two numbers that are nearly
/// the same.
constexpr double smallest_ratio = 0.01, largest_ratio = 100;

float relative_index(const Object& o, std::string_view inner) {
  const double inside = index_of_refraction(o, "int_ior", inner);
  const double outside = index_of_refraction(o, "ext_ior", "air");
  const double ratio = inside / outside;
  if (ratio >= smallest_ratio && ratio <= largest_ratio) return static_cast<float>(ratio);
  o.fail(o.has("int_ior") ? "int_ior" : "ext_ior",
         "the index inside, " + shown(inside) + ", over that outside, " + shown(outside) + ", is " +
             shown(ratio) + "; allowed: " + shown(smallest_ratio) + " to " + shown(largest_ratio));
}

/// All draws are of visible facets, whatever sample_visible says: it changes the noise alone.
Facets facets_of(const Object& o) {
  constexpr double smoothest = 1e-4, roughest = 10;
  const bool ggx = o.one_of("distribution", "beckmann", {"beckmann", "ggx"}) == "ggx";
  o.boolean("sample_visible", true);
  const bool along_x = o.has("alpha_u"), along_y = o.has("alpha_v");
  if (along_x != along_y)
    o.fail(along_x ? "alpha_u" : "alpha_v", "alpha_u and alpha_v are given both or neither");
  if (along_x && o.has("alpha"))
    o.fail("alpha", "the roughness is given by alpha or by alpha_u and alpha_v, not by both");
  const double alpha = o.number_in("alpha", 0.1, smoothest, roughest);
  const double u = o.number_in("alpha_u", alpha, smoothest, roughest);
  const double v = o.number_in("alpha_v", alpha, smoothest, roughest);
  return {ggx ? malus::MicrofacetShape::ggx : malus::MicrofacetShape::beckmann,
          static_cast<float>(u), static_cast<float>(v)};
}

Bsdf::Kind make_rough_conductor(const Object& o, TextureFactory& textures) {
  const ConductorIndex index = conductor_index(o);
  return RoughConductor{facets_of(o), index.eta, index.k,
                        textures.color(o, "specular_reflectance", 1)};
}

Bsdf::Kind make_rough_dielectric(const Object& o, TextureFactory& textures) {
  const float eta = relative_index(o, "bk7");
  if (eta == 1) o.fail("int_ior", "int_ior and ext_ior are equal: there is no interface");
  return RoughDielectric{facets_of(o), eta, textures.color(o, "specular_reflectance", 1),
                         textures.color(o, "specular_transmittance", 1)};
}

Bsdf::Kind make_plastic(const Object& o, TextureFactory& textures) {
  Plastic plastic(relative_index(o, "polypropylene"), o.boolean("nonlinear", false));
  plastic.diffuse_reflectance = textures.color(o, "diffuse_reflectance", 0.5);
  plastic.specular_reflectance = textures.color(o, "specular_reflectance", 1);
  return plastic;
}

Bsdf::Kind make_polarized_plastic(const Object& o, TextureFactory& textures) {
  return PolarizedPlastic{facets_of(o), relative_index(o, "polypropylene"),
                          textures.color(o, "diffuse_reflectance", 0.5),
                          textures.color(o, "specular_reflectance", 1)};
}

Bsdf::Kind make_dielectric(const Object& o, TextureFactory& textures) {
  Dielectric d;
  d.eta = relative_index(o, "bk7");
  d.specular_reflectance = textures.color(o, "specular_reflectance", 1);
  d.specular_transmittance = textures.color(o, "specular_transmittance", 1);
  return d;
}

Bsdf::Kind make_polarizer(const Object& o) {
  LinearPolarizer p;
  p.theta = radians(o.uniform("theta", 0));
  p.transmittance = reflectance(o, "transmittance");
  p.polarizing = o.boolean("polarizing", true);
  return p;
}

Bsdf::Kind make_retarder(const Object& o) {
  LinearRetarder r;
  r.theta = radians(o.uniform("theta", 0));
  r.delta = radians(o.uniform("delta", 90));
  r.transmittance = reflectance(o, "transmittance");
  return r;
}

Bsdf::Kind make_circular(const Object& o) {
  CircularPolarizer c;
  c.transmittance = reflectance(o, "transmittance");
  if (o.boolean("left_handed", false)) c.hand = malus::Handedness::left;
  return c;
}

}  // namespace

Bsdf::Kind make_bsdf_kind(const Object& o, TextureFactory& textures) {
  if (o.type() == "diffuse") return make_diffuse(o, textures);
  if (o.type() == "conductor") return make_conductor(o, textures);
  if (o.type() == "dielectric") return make_dielectric(o, textures);
  if (o.type() == "roughconductor") return make_rough_conductor(o, textures);
  if (o.type() == "roughdielectric") return make_rough_dielectric(o, textures);
  if (o.type() == "plastic") return make_plastic(o, textures);
  if (o.type() == "pplastic") return make_polarized_plastic(o, textures);
  if (o.type() == "polarizer") return make_polarizer(o);
  if (o.type() == "retarder") return make_retarder(o);
  if (o.type() == "circular") return make_circular(o);
  if (o.type() == "null") return NullSurface{};
  fail_unknown_plugin(o, {"bumpmap", "circular", "conductor", "dielectric", "diffuse", "mask",
                          "normalmap", "null", "plastic", "polarizer", "pplastic", "retarder",
                          "roughconductor", "roughdielectric", "twosided"});
}

}  // namespace renderer
