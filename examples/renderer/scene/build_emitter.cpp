// SPDX-License-Identifier: MIT
#include "build.hpp"

namespace renderer {

namespace {

Rgb emission(const Object& o, std::string_view name) {
  const glm::dvec3 c = o.color_in(name, glm::dvec3(1), 0, 1e30);
  return to_rgb(c);
}

/// A position or direction is given by itself or by a transform, not by both.
void reject_both(const Object& o, std::string_view name) {
  if (o.has(name) && o.has("to_world"))
    o.fail(name, "give either \"" + std::string(name) + "\" or \"to_world\", not both");
}

PointLight make_point(const Object& o) {
  reject_both(o, "position");
  PointLight light;
  light.position = o.has("position") ? Vec3(o.point("position"))
                                     : transform_point(o.transform("to_world"), glm::dvec3(0));
  light.intensity = emission(o, "intensity");
  return light;
}

DirectionalLight make_directional(const Object& o) {
  reject_both(o, "direction");
  const glm::dvec3 d = o.has("direction")
                           ? o.vector("direction")
                           : transform_vector(o.transform("to_world"), glm::dvec3(0, 0, 1));
  if (!(glm::length(d) > 0)) o.fail("direction", "a direction is not (0, 0, 0)");
  return {Vec3(glm::normalize(d)), emission(o, "irradiance")};
}

}  // namespace

AreaLight make_area_light(const Object& o, const Geometry& geometry, std::uint32_t shape) {
  if (o.type() != "area") o.fail("a shape's emitter is of type \"area\", not \"" + o.type() + "\"");
  const Rgb radiance = emission(o, "radiance");
  o.reject_unknown();
  return AreaLight(geometry, shape, radiance);
}

Emitter make_light(const Object& o) {
  const auto make = [&]() -> Emitter {
    if (o.type() == "point") return make_point(o);
    if (o.type() == "directional") return make_directional(o);
    if (o.type() == "constant") return ConstantLight{emission(o, "radiance")};
    if (o.type() == "area") o.fail("an \"area\" emitter belongs into the <shape> that emits");
    fail_unknown_plugin(o, {"constant", "directional", "point", "and \"area\" within a shape"});
  };
  const Emitter light = make();
  o.reject_unknown();
  return light;
}

}  // namespace renderer
