// SPDX-License-Identifier: MIT
#include "build_texture.hpp"

#include "../textures/read_texels.hpp"
#include "build.hpp"
#include "read_for.hpp"
#include "text.hpp"

namespace renderer {

namespace {

/// The transform's action on u and v; what it does to a third coordinate counts for nothing.
Texture::Placement read_placement(const Object& o) {
  const glm::dmat4 m = o.transform("to_uv");
  return {glm::mat2(glm::dmat2(m)), Vec2(glm::dvec2(m[3]))};
}

Bitmap make_bitmap(const Object& o, std::uint64_t held) {
  const auto path = o.file("filename");
  const auto filter = o.one_of("filter_type", "bilinear", {"bilinear", "nearest"}) == "nearest"
                          ? Bitmap::Filter::nearest
                          : Bitmap::Filter::bilinear;
  const std::string mode = o.one_of("wrap_mode", "repeat", {"repeat", "mirror", "clamp"});
  const auto wrap = mode == "mirror"  ? Bitmap::Wrap::mirror
                    : mode == "clamp" ? Bitmap::Wrap::clamp
                                      : Bitmap::Wrap::repeat;
  const bool raw = o.boolean("raw", false);
  return Bitmap(read_for(o.location(), [&] { return read_texels(path, raw, o.location(), held); }),
                filter, wrap);
}

Checkerboard make_checkerboard(const Object& o) {
  return {to_rgb(o.color("color0", glm::dvec3(0.4))), to_rgb(o.color("color1", glm::dvec3(0.2)))};
}

/// In bytes, of its picture.
std::uint64_t size_of(const Texture& texture) {
  const auto* bitmap = std::get_if<Bitmap>(&texture.kind());
  return bitmap ? bitmap->texels().values.size() * sizeof(Rgb) : 0;
}

Texture make_texture(const Object& o, std::uint64_t held) {
  if (o.type() == "bitmap") return {make_bitmap(o, held), read_placement(o)};
  if (o.type() == "checkerboard") return {make_checkerboard(o), read_placement(o)};
  fail_unknown_plugin(o, {"bitmap", "checkerboard"});
}

}  // namespace

const Texture& TextureFactory::make(const Object::Pointer& object) {
  ++handed_out_;
  const Texture*& made = made_[object.get()];
  if (!made) {
    made = &textures_.emplace_back(make_texture(*object, held_));
    held_ += size_of(*made);
    object->reject_unknown();
  }
  return *made;
}

const Texture* TextureFactory::nested(const Object& object, std::string_view name, double lowest,
                                      double highest) {
  const auto child = object.texture(name);
  if (!child) return nullptr;
  const Texture& texture = make(child);
  for (std::size_t i = 0; i < 3; ++i)
    for (const float value : {texture.lowest()[i], texture.highest()[i]})
      if (const auto v = static_cast<double>(value); !(v >= lowest && v <= highest))
        object.fail(name, "the texture " + in_quotes(name) + " has the value " + shown(v) +
                              "; allowed: " + shown(lowest) + " to " + shown(highest));
  return &texture;
}

ColorTexture TextureFactory::color(const Object& object, std::string_view name, double otherwise,
                                   double lowest, double highest) {
  if (const Texture* texture = nested(object, name, lowest, highest)) return ColorTexture(*texture);
  return to_rgb(object.color_in(name, glm::dvec3(otherwise), lowest, highest));
}

FloatTexture TextureFactory::number(const Object& object, std::string_view name, double otherwise,
                                    double lowest, double highest) {
  if (const Texture* texture = nested(object, name, lowest, highest)) return FloatTexture(*texture);
  const double value = object.uniform(name, otherwise);
  if (!(value >= lowest && value <= highest))
    object.fail(name, "the parameter " + in_quotes(name) + " is " + shown(value) +
                          "; allowed: " + shown(lowest) + " to " + shown(highest));
  return static_cast<float>(value);
}

}  // namespace renderer
