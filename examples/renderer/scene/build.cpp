// SPDX-License-Identifier: MIT
#include "build.hpp"

namespace renderer {

void fail_unknown_plugin(const Object& object, std::initializer_list<std::string_view> known) {
  std::string list;
  for (const auto name : known) list += (list.empty() ? "" : ", ") + std::string(name);
  object.fail("unknown " + object.element() + " type \"" + object.type() + "\"; known are " + list);
}

namespace {

void build_shape(const Object& object, MaterialFactory& materials, Scene& scene) {
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
  if (emitter) {
    shape.light = static_cast<int>(scene.lights.size());
    scene.lights.push_back(make_area_light(*emitter, scene.geometry, number));
  }
  object.reject_unknown();
  scene.shapes.push_back(shape);
}

void build_lights(const Object& root, Scene& scene) {
  for (const auto& emitter : root.children("emitter")) {
    if (emitter->type() == "constant" || emitter->type() == "envmap") {
      if (scene.environment >= 0) emitter->fail("a scene has one environment at most");
      scene.environment = static_cast<int>(scene.lights.size());
    }
    scene.lights.push_back(make_light(*emitter));
  }
}

}  // namespace

Scene build_scene(const Object& root) {
  Scene scene;
  MaterialFactory materials(scene);
  // What nothing refers to is checked all the same.
  for (const auto& texture : root.children("texture")) materials.textures().make(texture);
  for (const auto& bsdf : root.children("bsdf")) materials.make(bsdf, false);
  for (const auto& shape : root.children("shape")) build_shape(*shape, materials, scene);
  build_lights(root, scene);

  const auto sensors = root.children("sensor");
  if (sensors.empty()) root.fail("the scene has no <sensor>");
  if (sensors.size() > 1) sensors[1]->fail("a second <sensor>; a scene has one");
  build_sensor(*sensors[0], scene);

  const auto integrators = root.children("integrator");
  if (integrators.size() > 1) integrators[1]->fail("a second <integrator>; a scene has one");
  if (!integrators.empty()) build_integrator(*integrators[0], scene);

  root.reject_unknown();
  scene.geometry.commit();
  return scene;
}

}  // namespace renderer
