// SPDX-License-Identifier: MIT
#include <charconv>
#include <cmath>
#include <numbers>

#include "build.hpp"
#include "text.hpp"

namespace renderer {

namespace {

constexpr long long largest_film = 1 << 16;

ReconstructionFilter make_filter(const Object::Pointer& o) {
  using Kind = ReconstructionFilter::Kind;
  if (!o) return ReconstructionFilter();
  const auto make = [&] {
    if (o->type() == "box")
      return ReconstructionFilter(Kind::box, static_cast<float>(o->positive("radius", 0.5)));
    if (o->type() == "tent")
      return ReconstructionFilter(Kind::tent, static_cast<float>(o->positive("radius", 1)));
    if (o->type() == "gaussian")
      return ReconstructionFilter(Kind::gaussian, static_cast<float>(o->positive("stddev", 0.5)));
    fail_unknown_plugin(*o, {"box", "gaussian", "tent"});
  };
  const ReconstructionFilter filter = make();
  o->reject_unknown();
  return filter;
}

FilmSettings make_film(const Object& o, std::vector<std::string>& warnings) {
  if (o.type() != "hdrfilm") fail_unknown_plugin(o, {"hdrfilm"});
  FilmSettings film;
  film.where = o.location();
  film.width = static_cast<int>(o.integer_in("width", 768, 1, largest_film));
  film.height = static_cast<int>(o.integer_in("height", 576, 1, largest_film));
  film.crop_x = static_cast<int>(o.integer_in("crop_offset_x", 0, 0, film.width - 1));
  film.crop_y = static_cast<int>(o.integer_in("crop_offset_y", 0, 0, film.height - 1));
  const int most_x = film.width - film.crop_x, most_y = film.height - film.crop_y;
  film.crop_width = static_cast<int>(o.integer_in("crop_width", most_x, 1, most_x));
  film.crop_height = static_cast<int>(o.integer_in("crop_height", most_y, 1, most_y));
  film.filter = make_filter(o.only_child("rfilter"));
  // The output is always an EXR of 32-bit RGB and Stokes channels; what says otherwise is told so.
  o.one_of("file_format", "openexr", {"openexr"});
  if (o.one_of("pixel_format", "rgb", {"rgb", "rgba"}) == "rgba")
    warnings.push_back(o.location().file + ": the film's alpha channel is not written");
  o.one_of("component_format", "float16", {"float16", "float32"});
  o.boolean("sample_border", false);
  o.boolean("compensate", false);
  o.reject_unknown();
  return film;
}

void read_sampler(const Object& o, Scene& scene) {
  scene.samples_per_pixel = static_cast<int>(o.integer_in("sample_count", 4, 1, 1 << 30));
  scene.seed = static_cast<std::uint64_t>(o.integer_in("seed", 0, 0, (1LL << 62)));
  // All estimate the same picture: which numbers do it is the command line's choice.
  if (o.type() == "independent") {
    o.reject_unknown();
    return;
  }
  for (const auto known : {"stratified", "multijitter", "orthogonal", "ldsampler"})
    if (o.type() == known) {
      o.boolean("jitter", true);
      o.integer("strength", 2);
      o.reject_unknown();
      return;
    }
  fail_unknown_plugin(o, {"independent", "ldsampler", "multijitter", "orthogonal", "stratified"});
}

/// "50mm", of a full-frame camera.
double focal_length(const Object& o) {
  std::string text = o.string("focal_length", "50mm");
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || std::string_view(end) != "mm" || !(value > 0) ||
      !std::isfinite(value))
    o.fail("focal_length", "\"" + text + "\" is not a length such as \"50mm\"");
  return value;
}

/// The tangents of half the field of view across and down the film.
Vec2 half_extent(const Object& o, const FilmSettings& film) {
  const double w = film.width, h = film.height, diagonal = std::hypot(w, h);
  double half_angle = 0;
  std::string axis = o.one_of("fov_axis", "x", {"x", "y", "diagonal", "smaller", "larger"});
  if (o.has("fov")) {
    const double fov = o.number("fov");
    if (!(fov > 0 && fov < 180))
      o.fail("fov", "the parameter \"fov\" is " + shown(fov) +
                        "; allowed: more than 0 and less than 180 degrees");
    if (o.has("focal_length")) o.fail("focal_length", "give either fov or focal_length, not both");
    half_angle = fov * std::numbers::pi / 360;
  } else {
    half_angle = std::atan(std::hypot(36.0, 24.0) / 2 / focal_length(o));
    axis = "diagonal";
  }
  double across = w;
  if (axis == "y" || (axis == "smaller" && h < w) || (axis == "larger" && h > w)) across = h;
  if (axis == "diagonal") across = diagonal;
  const double per_pixel = std::tan(half_angle) / across;
  return {static_cast<float>(per_pixel * w), static_cast<float>(per_pixel * h)};
}

Sensor make_perspective(const Object& o, const FilmSettings& film) {
  Sensor::Lens lens;
  lens.half_extent = half_extent(o, film);
  lens.principal_point = {static_cast<float>(o.number("principal_point_offset_x", 0)),
                          static_cast<float>(o.number("principal_point_offset_y", 0))};
  const double near_clip = o.positive("near_clip", 1e-2), far_clip = o.positive("far_clip", 1e4);
  lens.near_clip = static_cast<float>(near_clip);
  lens.far_clip = static_cast<float>(far_clip);
  if (lens.far_clip <= lens.near_clip)
    o.fail(o.has("far_clip") ? "far_clip" : "near_clip",
           "the parameter \"far_clip\" is " + shown(far_clip) + "; allowed: more than near_clip, " +
               shown(near_clip));
  return {Sensor::Kind::perspective, o.transform("to_world"), lens};
}

Sensor make_radiancemeter(const Object& o) {
  glm::dmat4 to_world = o.transform("to_world");
  if (o.has("origin") || o.has("direction")) {
    if (o.has("to_world"))
      o.fail("to_world", "give either origin and direction or to_world, not both");
    const glm::dvec3 origin = o.point("origin"), d = o.vector("direction");
    if (!(glm::length(d) > 0)) o.fail("direction", "a direction is not (0, 0, 0)");
    const glm::dvec3 z = glm::normalize(d);
    // As Mitsuba: look-at with the first of the two vectors that complete z to a basis as up.
    const Basis basis{Vec3(z)};
    const glm::dvec3 x = glm::normalize(glm::cross(glm::dvec3(basis.s), z));
    to_world = glm::dmat4(glm::dvec4(x, 0), glm::dvec4(glm::cross(z, x), 0), glm::dvec4(z, 0),
                          glm::dvec4(origin, 1));
  }
  return {Sensor::Kind::radiancemeter, to_world, {}};
}

}  // namespace

void build_sensor(const Object& o, MediumFactory& media, Scene& scene) {
  const auto film = o.only_child("film");
  if (o.type() != "perspective" && o.type() != "radiancemeter")
    fail_unknown_plugin(o, {"perspective", "radiancemeter"});
  if (film) {
    scene.film = make_film(*film, scene.warnings);
  } else if (o.type() == "radiancemeter") {
    scene.film.width = scene.film.height = scene.film.crop_width = scene.film.crop_height = 1;
  }
  if (o.type() == "radiancemeter") {
    if (scene.film.width != 1 || scene.film.height != 1)
      (film ? *film : o).fail("a radiancemeter's film is of width 1 and height 1");
    scene.sensor = make_radiancemeter(o);
  } else {
    scene.sensor = make_perspective(o, scene.film);
  }
  if (const auto sampler = o.only_child("sampler")) read_sampler(*sampler, scene);
  scene.sensor_medium = media.make(o.only_child("medium"));
  o.reject_unknown();
}

}  // namespace renderer
