// SPDX-License-Identifier: MIT
#include "build.hpp"

namespace renderer {

void fail_unknown_plugin(const Object& object, std::initializer_list<std::string_view> known) {
  std::string list;
  for (const auto name : known) list += (list.empty() ? "" : ", ") + std::string(name);
  object.fail("unknown " + object.element() + " type \"" + object.type() + "\"; known are " + list);
}

void warn(Scene& scene, const Object& object, const std::string& message) {
  const Location& where = object.location();
  scene.warnings.push_back(where.file + ":" + std::to_string(where.line) + ": " +
                           object.description() + ": " + message);
}

namespace {

void read_sides(const Object& object, MediumFactory& media, Shape& shape, Scene& scene) {
  const auto interior = object.child("interior", "medium");
  const auto exterior = object.child("exterior", "medium");
  shape.is_boundary = interior || exterior;
  shape.interior = media.make(interior);
  shape.exterior = media.make(exterior);
  if (shape.is_boundary && object.children("bsdf").empty())
    warn(scene, object,
         "bounds a medium, and is diffuse since it has no <bsdf>, as in Mitsuba; light passes "
         "through a <bsdf type=\"null\"/> as if it were not there");
}

void add_light(Emitter light, const Object& emitter, const Medium* medium, Scene& scene) {
  scene.lights.push_back(std::move(light));
  scene.light_media.push_back(medium);
  scene.light_places.push_back(emitter.location());
}

void build_shape(const Object& object, MaterialFactory& materials, MediumFactory& media,
                 Scene& scene) {
  const std::uint32_t number = add_shape_geometry(object, scene.geometry, scene.warnings);
  Shape shape;
  const auto emitter = object.only_child("emitter");
  shape.material = materials.make(object.only_child("bsdf"), emitter != nullptr);
  for (const Bsdf* bsdf : {shape.material.front, shape.material.back}) {
    if (!bsdf) continue;
    scene.has_sheets |= bsdf->is_sheet();
    scene.polarizes |= bsdf->polarizes();
  }
  scene.has_masks |= shape.material.is_masked();
  read_sides(object, media, shape, scene);
  if (emitter) {
    // The front emits.
    const Medium* medium = media.make(emitter->only_child("medium"));
    if (shape.is_boundary && medium && medium != shape.exterior)
      warn(scene, *emitter, "its <medium> doesn't count: the shape's exterior does");
    shape.light = static_cast<int>(scene.lights.size());
    add_light(make_area_light(*emitter, scene.geometry, number), *emitter,
              shape.is_boundary ? shape.exterior : medium, scene);
  }
  object.reject_unknown();
  scene.shapes.push_back(shape);
  scene.shape_origins.push_back({object.type(), object.id(), object.location()});
}

void build_lights(const Object& root, const TextureFactory& textures, MediumFactory& media,
                  Scene& scene) {
  for (const auto& emitter : root.children("emitter")) {
    if (emitter->type() == "constant" || emitter->type() == "envmap") {
      if (scene.environment >= 0) emitter->fail("a scene has one environment at most");
      scene.environment = static_cast<int>(scene.lights.size());
    }
    const Medium* medium = nullptr;
    if (emitter->type() == "point") {
      medium = media.make(emitter->only_child("medium"));
    } else {
      for (const auto& child : emitter->nested())
        if (child.object->element() == "medium")
          throw InputError(child.where, emitter->description() +
                                            ": a medium would take all light from infinity; "
                                            "allowed: none, for a vacuum");
    }
    add_light(make_light(*emitter, textures.held()), *emitter, medium, scene);
  }
}

/// Media that emit are enclosed by the shapes whose inside they are; what nothing encloses has no
/// end, and is no Glow.
void find_glows(Scene& scene) {
  for (const Medium& medium : scene.media) {
    if (!medium.emits()) continue;
    Glow glow{&medium, Vec3(infinity), Vec3(-infinity)};
    for (std::uint32_t i = 0; i < scene.shapes.size(); ++i) {
      if (scene.shapes[i].interior != &medium) continue;
      const auto [low, high] = scene.geometry.bounds(i);
      glow.low = glm::min(glow.low, low);
      glow.high = glm::max(glow.high, high);
    }
    if (glow.high.x > glow.low.x) scene.glows.push_back(glow);
  }
}

}  // namespace

Scene build_scene(const Object& root) {
  Scene scene;
  MaterialFactory materials(scene);
  MediumFactory media(scene);
  // What nothing refers to is checked all the same.
  for (const auto& texture : root.children("texture")) materials.textures().make(texture);
  for (const auto& bsdf : root.children("bsdf")) materials.make(bsdf, false);
  for (const auto& shape : root.children("shape")) build_shape(*shape, materials, media, scene);
  build_lights(root, materials.textures(), media, scene);

  const auto sensors = root.children("sensor");
  if (sensors.empty()) root.fail("the scene has no <sensor>");
  if (sensors.size() > 1) sensors[1]->fail("a second <sensor>; a scene has one");
  build_sensor(*sensors[0], media, scene);

  const auto integrators = root.children("integrator");
  if (integrators.size() > 1) integrators[1]->fail("a second <integrator>; a scene has one");
  if (!integrators.empty()) build_integrator(*integrators[0], scene);

  for (auto& warning : root.file_warnings()) scene.warnings.push_back(std::move(warning));
  media.check_unused(root);
  root.reject_unknown();
  find_glows(scene);
  for (std::size_t i = 0; i < scene.shapes.size(); ++i)
    if (scene.shapes[i].material.lets_light_pass())
      scene.geometry.let_light_pass(static_cast<std::uint32_t>(i));
  scene.geometry.commit();
  return scene;
}

}  // namespace renderer
