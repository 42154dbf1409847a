// SPDX-License-Identifier: MIT
#include "build.hpp"

namespace renderer {

namespace {

/// A surface whose axes count.
bool needs_tangent(const Bsdf& bsdf) {
  return std::visit(
      []<class B>(const B& b) {
        if constexpr (requires { b.needs_tangent(); })
          return b.needs_tangent();
        else
          return false;
      },
      bsdf.kind());
}

bool transmits(const Bsdf& bsdf) {
  return bsdf.is_sheet() || std::holds_alternative<Dielectric>(bsdf.kind()) ||
         std::holds_alternative<RoughDielectric>(bsdf.kind());
}

/// Surface terms that Mitsuba has and that aren't here.
void refuse_true(const Object& o, std::string_view name) {
  if (o.boolean(name, false))
    o.fail(name, "\"" + std::string(name) + "\" is not known here; allowed: false");
}

}  // namespace

Material MaterialFactory::make_two_sided(const Object& object) {
  const auto sides = object.children("bsdf");
  if (sides.empty() || sides.size() > 2)
    object.fail("a twosided BSDF holds one or two <bsdf>, not " + std::to_string(sides.size()));
  Material material;
  for (const auto& side : sides) {
    const Material inner = make(side, false);
    if (inner.back) side->fail("twosided BSDFs don't nest");
    if (inner.is_masked()) side->fail("a mask goes around a twosided BSDF, not into it");
    if (transmits(*inner.front))
      side->fail("a twosided BSDF holds BSDFs that reflect alone; \"" + side->type() +
                 "\" transmits");
    (material.front ? material.back : material.front) = inner.front;
    (material.back ? material.back_detail : material.front_detail) = inner.front_detail;
    material.needs = material.needs | inner.needs;
  }
  if (!material.back) {
    material.back = material.front;
    material.back_detail = material.front_detail;
  }
  return material;
}

Material MaterialFactory::make_inner(const Object& object) {
  const auto inner = object.only_child("bsdf");
  if (!inner) object.fail("needs a <bsdf> in it");
  return make(inner, false);
}

Material MaterialFactory::make_masked(const Object& object) {
  Material material = make_inner(object);
  if (material.is_masked())
    object.fail("masks don't nest, and its " + object.only_child("bsdf")->description() +
                " is masked already; allowed: one mask");
  material.coverage = textures_.number(object, "opacity", 0.5);
  return material;
}

Perturbation MaterialFactory::make_perturbation(const Object& object) {
  refuse_true(object, "flip_invalid_normals");
  refuse_true(object, "use_shadowing_function");
  if (object.type() == "normalmap") {
    const auto map = object.texture("normalmap");
    if (!map && !object.has("normalmap")) object.fail("needs a <texture name=\"normalmap\">");
    if (map && map->type() == "bitmap" && !map->boolean("raw", false))
      scene_.warnings.push_back(
          map->location().file + ":" + std::to_string(map->location().line) +
          ": a normal map holds vectors, not colours, and is usually \"raw\"");
    return Perturbation(NormalMap{textures_.color(object, "normalmap", 0)});
  }
  const auto height = object.only_child("texture");
  if (!height) object.fail("needs a <texture> in it, of the displacement");
  const Texture& texture = textures_.make(height);
  const auto* bitmap = std::get_if<Bitmap>(&texture.kind());
  if (!bitmap || bitmap->filter() == Bitmap::Filter::nearest)
    height->fail("a displacement has no steps; allowed: a bitmap of filter_type bilinear");
  const auto scale = static_cast<float>(object.number("scale", 1));
  return Perturbation(BumpMap{FloatTexture(texture), scale});
}

Material MaterialFactory::make_perturbed(const Object& object) {
  Material material = make_inner(object);
  if (material.front_detail || material.back_detail)
    object.fail("bump maps and normal maps don't nest");
  const Perturbation& detail = scene_.perturbations.emplace_back(make_perturbation(object));
  material.front_detail = &detail;
  if (material.back) material.back_detail = &detail;
  material.needs = material.needs | detail.needs();
  return material;
}

Material MaterialFactory::make_anew(const Object& object) {
  const std::size_t textures_before = textures_.handed_out();
  Material material;
  if (object.type() == "twosided") {
    material = make_two_sided(object);
  } else if (object.type() == "mask") {
    material = make_masked(object);
  } else if (object.type() == "bumpmap" || object.type() == "normalmap") {
    material = make_perturbed(object);
  } else {
    material.front = &scene_.bsdfs.emplace_back(make_bsdf_kind(object, textures_));
    material.needs.tangent = needs_tangent(*material.front);
    scene_.bsdf_origins[material.front] = {object.type(), object.id(), object.location()};
  }
  material.needs.uv |= textures_.handed_out() != textures_before;
  object.reject_unknown();
  return material;
}

Material MaterialFactory::make(const Object::Pointer& object, bool emits) {
  if (!object) {
    const Bsdf*& shared = emits ? default_of_emitters_ : default_;
    if (!shared) shared = &scene_.bsdfs.emplace_back(Diffuse{Rgb(emits ? 0.0f : 0.5f)});
    return {shared};
  }
  if (const auto found = made_.find(object.get()); found != made_.end()) return found->second;
  const Material material = make_anew(*object);
  return made_[object.get()] = material;
}

}  // namespace renderer
