// SPDX-License-Identifier: MIT
#include "../core/affine.hpp"
#include "../image/finite.hpp"
#include "../textures/read_texels.hpp"
#include "build.hpp"
#include "read_for.hpp"
#include "text.hpp"

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
  light.position =
      Vec3(o.has("position") ? o.point("position")
                             : transform_point(o.transform("to_world"), glm::dvec3(0)));
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

/// A rotation, perhaps with a mirroring: what is left of a transform for directions. Throws where
/// it would also shear or stretch them.
glm::mat3 rotation_of(const Object& o) {
  const glm::dmat3 m(o.transform("to_world"));
  const double scale = glm::length(m[0]);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (std::abs(glm::dot(m[i], m[j]) - (i == j ? scale * scale : 0)) > 1e-6 * scale * scale)
        o.fail("to_world",
               "the parameter \"to_world\" shears or stretches; an environment can only be turned "
               "or mirrored");
  return glm::mat3(m / scale);
}

EnvironmentLight make_environment_map(const Object& o, std::uint64_t held) {
  const auto path = o.file("filename");
  const auto scale = static_cast<float>(o.number_in("scale", 1, 0, 1e30));
  Texels texels =
      read_for(o.location(), [&] { return read_texels(path, false, o.location(), held); });
  const auto fail = [&](const std::string& problem) {
    o.fail("filename", "the file " + in_quotes(path.string()) + " " + problem);
  };
  if (texels.width < 2 || texels.height < 3)
    fail("has " + std::to_string(texels.width) + " x " + std::to_string(texels.height) +
         " pixels; allowed: 2 x 3 or more");
  for (Rgb& c : texels.values) {
    c *= scale;
    for (std::size_t i = 0; i < 3; ++i)
      if (!(c[i] >= 0 && is_finite(c[i])))
        fail("has the radiance " + shown(static_cast<double>(c[i])) + "; allowed: 0 or more");
  }
  return {EnvironmentMap(std::move(texels), rotation_of(o))};
}

}  // namespace

AreaLight make_area_light(const Object& o, const Geometry& geometry, std::uint32_t shape) {
  if (o.type() != "area") o.fail("a shape's emitter is of type \"area\", not \"" + o.type() + "\"");
  const Rgb radiance = emission(o, "radiance");
  o.reject_unknown();
  AreaLight light(geometry, shape, radiance);
  // What is sampled by area has its inverse for a density.
  constexpr double smallest = 1e-30, largest = 1e30;
  const auto area = static_cast<double>(light.area());
  if (!(area >= smallest && area <= largest))
    o.fail("the shape has an area of " + shown(area) + "; allowed for a light: " + shown(smallest) +
           " to " + shown(largest));
  return light;
}

Emitter make_light(const Object& o, std::uint64_t held) {
  const auto make = [&]() -> Emitter {
    if (o.type() == "point") return make_point(o);
    if (o.type() == "directional") return make_directional(o);
    if (o.type() == "constant") return ConstantLight{emission(o, "radiance")};
    if (o.type() == "envmap") return make_environment_map(o, held);
    if (o.type() == "area") o.fail("an \"area\" emitter belongs into the <shape> that emits");
    fail_unknown_plugin(
        o, {"constant", "directional", "envmap", "point", "and \"area\" within a shape"});
  };
  Emitter light = make();
  o.reject_unknown();
  return light;
}

}  // namespace renderer
