// SPDX-License-Identifier: MIT
#include <array>
#include <numbers>
#include <string_view>
#include <utility>

#include "build.hpp"

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

double index_of_refraction(const Object& o, std::string_view name, std::string_view otherwise) {
  if (o.has(name) && o.kind_of(name) != ValueKind::string) {
    const double index = o.number(name);
    if (!(index > 0)) o.fail(name, "an index of refraction is above 0");
    return index;
  }
  const std::string material = o.string(name, otherwise);
  for (const auto& [known, index] : named_indices)
    if (known == material) return index;
  std::string list;
  for (const auto& entry : named_indices)
    list += (list.empty() ? "" : ", ") + std::string(entry.first);
  o.fail(name, "unknown material \"" + material + "\"; give a number or one of " + list);
}

Bsdf::Kind make_diffuse(const Object& o) { return Diffuse{reflectance(o, "reflectance", 0.5)}; }

Bsdf::Kind make_conductor(const Object& o) {
  Conductor c;
  if (o.string("material", "none") != "none")
    o.fail("material", "conductors are given by eta and k; the one name known is \"none\"");
  c.eta = to_rgb(o.color_in("eta", glm::dvec3(0), 0, 1e4));
  c.k = to_rgb(o.color_in("k", glm::dvec3(1), 0, 1e4));
  c.specular_reflectance = reflectance(o, "specular_reflectance");
  for (std::size_t i = 0; i < 3; ++i)
    if (c.eta[i] == 0 && c.k[i] == 0) o.fail("k", "eta and k are both 0 in a channel");
  return c;
}

Bsdf::Kind make_dielectric(const Object& o) {
  Dielectric d;
  d.eta = static_cast<float>(index_of_refraction(o, "int_ior", "bk7") /
                             index_of_refraction(o, "ext_ior", "air"));
  d.specular_reflectance = reflectance(o, "specular_reflectance");
  d.specular_transmittance = reflectance(o, "specular_transmittance");
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

Bsdf::Kind make_kind(const Object& o) {
  if (o.type() == "diffuse") return make_diffuse(o);
  if (o.type() == "conductor") return make_conductor(o);
  if (o.type() == "dielectric") return make_dielectric(o);
  if (o.type() == "polarizer") return make_polarizer(o);
  if (o.type() == "retarder") return make_retarder(o);
  if (o.type() == "circular") return make_circular(o);
  if (o.type() == "null") return NullSurface{};
  fail_unknown_plugin(o, {"circular", "conductor", "dielectric", "diffuse", "null", "polarizer",
                          "retarder", "twosided"});
}

}  // namespace

const Bsdf* MaterialFactory::make_bsdf(const Object::Pointer& object) {
  bsdfs_.emplace_back(make_kind(*object));
  object->reject_unknown();
  return &bsdfs_.back();
}

Material MaterialFactory::make_two_sided(const Object& object) {
  const auto sides = object.children("bsdf");
  if (sides.empty() || sides.size() > 2)
    object.fail("a twosided BSDF holds one or two <bsdf>, not " + std::to_string(sides.size()));
  Material material;
  for (const auto& side : sides) {
    const Material inner = make(side, false);
    if (side->type() == "twosided") side->fail("twosided BSDFs don't nest");
    if (inner.front->is_sheet() || std::holds_alternative<Dielectric>(inner.front->kind()))
      side->fail("a twosided BSDF holds BSDFs that reflect alone; \"" + side->type() +
                 "\" transmits");
    (material.front ? material.back : material.front) = inner.front;
  }
  if (!material.back) material.back = material.front;
  object.reject_unknown();
  return material;
}

Material MaterialFactory::make(const Object::Pointer& object, bool emits) {
  if (!object) {
    const Bsdf*& shared = emits ? default_of_emitters_ : default_;
    if (!shared) shared = &bsdfs_.emplace_back(Diffuse{Rgb(emits ? 0.0f : 0.5f)});
    return {shared, nullptr};
  }
  if (const auto found = made_.find(object.get()); found != made_.end()) return found->second;
  const Material material =
      object->type() == "twosided" ? make_two_sided(*object) : Material{make_bsdf(object), nullptr};
  return made_[object.get()] = material;
}

}  // namespace renderer
