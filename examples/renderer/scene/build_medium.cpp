// SPDX-License-Identifier: MIT
#include "build_medium.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "../media/read_grid_volume.hpp"
#include "build.hpp"
#include "text.hpp"

namespace renderer {

namespace {

constexpr double densest = 1e10;  // by unit of length

using Exact = malus::Spectrum<double, 3>;
using Polarizing = malus::UniaxialExtinction<Exact>;
constexpr std::array<std::string_view, 5> polarizing_parameters{
    "axis", "linear_dichroism", "circular_dichroism", "linear_birefringence", "optical_rotation"};

double largest(const glm::dvec3& v) { return std::max({v.x, v.y, v.z}); }

/// Mitsuba's switches between ways to render the same; there is one here, for every value.
void read_switches(const Object& o) {
  o.boolean("sample_emitters", true);
  o.boolean("has_spectral_extinction", true);
}

double scale_of(const Object& o) { return o.number_in("scale", 1, 0, densest); }

void check_scaled(const Object& o, std::string_view name, double value) {
  if (!(std::abs(value) <= densest))
    o.fail("scale", in_quotes(name) + " times \"scale\" is " + shown(value) +
                        " by unit of length; allowed: magnitudes up to " + shown(densest));
}

Exact rate(const Object& o, std::string_view name) {
  const glm::dvec3 c = o.color_in(name, glm::dvec3(0), -densest, densest);
  return {c.x, c.y, c.z};
}

/// The extinction by polarisation as the file has it, not scaled.
Polarizing read_polarizing(const Object& o) {
  const glm::dvec3 axis = o.vector("axis", glm::dvec3(0, 0, 1));
  if (!(glm::length(axis) > 0)) o.fail("axis", "an axis is not (0, 0, 0)");
  Polarizing p;
  p.axis = glm::normalize(axis);
  p.linear_dichroism = rate(o, "linear_dichroism");
  p.circular_dichroism = rate(o, "circular_dichroism");
  constexpr double degree = std::numbers::pi / 180;
  p.linear_birefringence = rate(o, "linear_birefringence") * degree;
  p.optical_rotation = rate(o, "optical_rotation") * degree;
  return p;
}

void check_passive(const Object& o, const Polarizing& p, const glm::dvec3& absorption) {
  const Exact least = p.least_absorption();
  for (std::size_t i = 0; i < 3; ++i) {
    const double found = absorption[static_cast<int>(i)];
    // 1 − albedo rounds.
    if (found >= least[i] * (1 - 1e-6)) continue;
    o.fail(o.has("sigma_a") ? "sigma_a" : "sigma_t",
           "light of one polarisation would gain by the dichroism: the absorption, sigma_a or "
           "sigma_t (1 - albedo), is " +
               shown(found) + "; allowed: " + shown(least[i]) + " or more");
  }
}

malus::UniaxialExtinction<Rgb> scaled(const Object& o, const Polarizing& p, const Rgb& extinction,
                                      double scale) {
  const auto rounded = [&](std::string_view name, const Exact& c) {
    for (std::size_t i = 0; i < 3; ++i) check_scaled(o, name, c[i] * scale);
    return to_rgb({c[0] * scale, c[1] * scale, c[2] * scale});
  };
  return {.axis = Vec3(p.axis),
          .extinction = extinction,
          .linear_dichroism = rounded("linear_dichroism", p.linear_dichroism),
          .circular_dichroism = rounded("circular_dichroism", p.circular_dichroism),
          .linear_birefringence = rounded("linear_birefringence", p.linear_birefringence),
          .optical_rotation = rounded("optical_rotation", p.optical_rotation)};
}

void refuse_polarizing(const Object& o) {
  for (const auto name : polarizing_parameters)
    if (o.has(name))
      o.fail(name, "extinction by polarisation, " + in_quotes(name) +
                       ", is not known of media whose density varies; allowed: in a <medium "
                       "type=\"homogeneous\">");
}

Rgb emission_of(const Object& o) {
  return to_rgb(o.color_in("emission", glm::dvec3(0), 0, densest));
}

/// From the unit cube: by the volume's transform, or by the file's box and then that.
glm::dmat4 grid_to_world(const Object& o, const GridVolume& volume) {
  const glm::dmat4 to_world = o.transform("to_world");
  if (!o.boolean("use_grid_bbox", false)) return to_world;
  glm::dmat4 box(1.0);
  for (int i = 0; i < 3; ++i) {
    const double low = volume.lowest[i], high = volume.highest[i];
    if (!is_finite(low) || !is_finite(high) || !(low < high))
      o.fail("use_grid_bbox", "the file's bounding box is from " + shown(low) + " to " +
                                  shown(high) + "; allowed: finite, and not empty");
    box[i][i] = high - low;
    box[3][i] = low;
  }
  return to_world * box;
}

DensityGrid make_grid(const Object& o, DensityGrid::Outside outside) {
  GridVolume volume = read_grid_volume(o.file("filename"), o.location());
  const auto filter = o.one_of("filter_type", "trilinear", {"nearest", "trilinear"}) == "nearest"
                          ? DensityGrid::Filter::nearest
                          : DensityGrid::Filter::trilinear;
  o.one_of("wrap_mode", "clamp", {"clamp"});
  // Of Mitsuba's workings, without effect on the values.
  o.boolean("raw", false);
  o.boolean("accel", true);
  o.number("max_value", 0);
  const glm::dmat4 to_world = grid_to_world(o, volume);
  o.reject_unknown();
  return DensityGrid(std::move(volume.grid), to_world, filter, outside);
}

}  // namespace

MediumFactory::Grid MediumFactory::grid(const Object::Pointer& object,
                                        DensityGrid::Outside outside) {
  Grid& made = grids_[{object.get(), outside}];
  if (!made) made = std::make_shared<const DensityGrid>(make_grid(*object, outside));
  return made;
}

MediumFactory::Volume MediumFactory::read_volume(const Object::Pointer& object, double highest,
                                                 DensityGrid::Outside outside) {
  Volume result;
  if (object->type() == "gridvolume") {
    result.grid = grid(object, outside);
  } else if (object->type() == "constvolume") {
    result.value = object->color_in("value", glm::dvec3(1), 0, highest);
    result.to_world = object->transform("to_world");
    object->reject_unknown();
  } else {
    fail_unknown_plugin(*object, {"constvolume", "gridvolume"});
  }
  return result;
}

MediumFactory::Volume MediumFactory::volume(const Object& o, std::string_view name,
                                            double otherwise, double highest,
                                            DensityGrid::Outside outside) {
  const auto nested = o.kind_of(name) ? nullptr : o.child(name, "volume");
  if (!nested) return {o.color_in(name, glm::dvec3(otherwise), 0, highest)};
  const Volume v = read_volume(nested, highest, outside);
  if (!v.grid) return v;
  const auto most = static_cast<double>(v.grid->maximum());
  // The maximum is rounded up.
  if (most > highest * (1 + 2e-6))
    o.fail(name, "the volume " + in_quotes(name) + " has the value " + shown(most) +
                     "; allowed: 0 to " + shown(highest));
  return v;
}

glm::dvec3 MediumFactory::constant(const Object& o, std::string_view name, double otherwise,
                                   double highest) {
  const Volume v = volume(o, name, otherwise, highest, DensityGrid::Outside::nothing);
  if (v.grid)
    o.fail(name, in_quotes(name) + " varies; allowed: in a <medium type=\"heterogeneous\">");
  return v.value;
}

const PhaseFunction& MediumFactory::phase(const Object::Pointer& object) {
  const auto found = phases_.find(object.get());
  if (found != phases_.end()) return found->second;
  return phases_.emplace(object.get(), make_phase(*object)).first->second;
}

PhaseFunction MediumFactory::phase_of(const Object& medium) {
  const auto object = medium.only_child("phase");
  return object ? phase(object) : PhaseFunction();
}

MediumFactory::Coefficients MediumFactory::coefficients(const Object& o) {
  const bool by_absorption = o.has("sigma_a"), by_scattering = o.has("sigma_s");
  if (!by_absorption && !by_scattering) {
    const glm::dvec3 extinction = constant(o, "sigma_t", 1, densest);
    const glm::dvec3 albedo = constant(o, "albedo", 0.75, 1);
    return {extinction, albedo, extinction * (glm::dvec3(1) - albedo)};
  }
  for (const auto name : {"sigma_t", "albedo"})
    if (o.has(name))
      o.fail(name,
             "a medium is given by sigma_t and albedo or by sigma_a and sigma_s, not by both");
  if (by_absorption != by_scattering)
    o.fail(by_absorption ? "sigma_a" : "sigma_s", "sigma_a and sigma_s are given both or neither");
  const glm::dvec3 absorption = constant(o, "sigma_a", 0, densest);
  const glm::dvec3 scattering = constant(o, "sigma_s", 0, densest);
  Coefficients c{absorption + scattering, glm::dvec3(0), absorption};
  for (int i = 0; i < 3; ++i)
    if (c.extinction[i] > 0) c.albedo[i] = scattering[i] / c.extinction[i];
  return c;
}

Medium::Description MediumFactory::describe_homogeneous(const Object& o) {
  const Coefficients c = coefficients(o);
  const double scale = scale_of(o);
  check_scaled(o, "sigma_t", largest(c.extinction) * scale);
  const Polarizing polarizing = read_polarizing(o);
  check_passive(o, polarizing, c.absorption);

  Medium::Description d;
  d.extinction = to_rgb(c.extinction * scale);
  d.albedo = to_rgb(c.albedo);
  d.emission = emission_of(o);
  d.phase = phase_of(o);
  const auto by_polarization = scaled(o, polarizing, d.extinction, scale);
  if (by_polarization.polarizes()) d.polarizing = by_polarization;
  return d;
}

Medium::Description MediumFactory::describe_heterogeneous(const Object& o) {
  refuse_polarizing(o);
  const Volume density = volume(o, "sigma_t", 1, densest, DensityGrid::Outside::nothing);
  const Volume albedo = volume(o, "albedo", 0.75, 1, DensityGrid::Outside::nearest);
  const double scale = scale_of(o);

  Medium::Description d;
  d.density = density.grid;
  if (!d.density) {
    warn(scene_, o,
         "the same sigma_t everywhere fills the unit cube (by the constvolume's to_world), as "
         "in Mitsuba; one that goes on everywhere is \"homogeneous\"");
    const Rgb v = to_rgb(density.value);
    d.density = std::make_shared<const DensityGrid>(
        GridValues{glm::ivec3(1), 3, {v[0], v[1], v[2]}}, density.to_world);
  }
  check_scaled(o, "sigma_t", static_cast<double>(d.density->maximum()) * scale);
  d.extinction = Rgb(static_cast<float>(scale));
  d.albedo = to_rgb(albedo.value);
  d.albedo_grid = albedo.grid;
  d.emission = emission_of(o);
  d.phase = phase_of(o);
  return d;
}

Medium::Description MediumFactory::describe(const Object& o) {
  if (o.type() != "homogeneous" && o.type() != "heterogeneous")
    fail_unknown_plugin(o, {"heterogeneous", "homogeneous"});
  read_switches(o);
  auto description =
      o.type() == "homogeneous" ? describe_homogeneous(o) : describe_heterogeneous(o);
  o.reject_unknown();
  return description;
}

const Medium* MediumFactory::make(const Object::Pointer& object) {
  if (!object) return nullptr;
  const Medium*& made = media_[object.get()];
  if (!made) {
    made = &scene_.media.emplace_back(describe(*object));
    scene_.polarizes |= made->polarizes();
    scene_.draws_by_polarization |= made->scatters() && made->phase().polarizes();
    scene_.medium_names[made] =
        object->id().empty() ? "the medium of line " + std::to_string(object->location().line)
                             : in_quotes(object->id());
  }
  return made;
}

void MediumFactory::check_unused(const Object& root) {
  for (const auto& medium : root.children("medium"))
    if (!media_.count(medium.get())) describe(*medium);
  for (const auto& p : root.children("phase")) phase(p);
  for (const auto& v : root.children("volume"))
    read_volume(v, densest, DensityGrid::Outside::nothing);
}

}  // namespace renderer
