// SPDX-License-Identifier: MIT
// From a scene file's objects to a scene. One factory a kind of plugin; each knows its plugins'
// names, parameters and defaults, which are Mitsuba's, and refuses what it doesn't know.
#pragma once

#include <memory>
#include <unordered_map>

#include "object.hpp"
#include "scene.hpp"

namespace renderer {

/// Throws InputError where the file asks for what there isn't.
Scene build_scene(const Object& root);

// the factories

class MaterialFactory {
 public:
  explicit MaterialFactory(std::deque<Bsdf>& bsdfs) : bsdfs_(bsdfs) {}
  /// The material of a <bsdf>; one for each object, however often it is referred to. Null: the
  /// default, diffuse of ½, or of 0 where the shape emits.
  Material make(const Object::Pointer& object, bool emits);

 private:
  const Bsdf* make_bsdf(const Object::Pointer& object);
  Material make_two_sided(const Object& object);

  std::deque<Bsdf>& bsdfs_;
  std::unordered_map<const Object*, Material> made_;
  const Bsdf* default_ = nullptr;
  const Bsdf* default_of_emitters_ = nullptr;
};

/// Adds a <shape>'s geometry and returns its number.
std::uint32_t add_shape_geometry(const Object& shape, Geometry& geometry,
                                 std::vector<std::string>& warnings);

/// A <emitter> of a shape.
AreaLight make_area_light(const Object& emitter, const Geometry& geometry, std::uint32_t shape);
/// A <emitter> of the scene itself.
Emitter make_light(const Object& emitter);

void build_sensor(const Object& sensor, Scene& scene);
void build_integrator(const Object& integrator, Scene& scene);

/// "x" is not a bsdf that is known here; known are a, b, c.
[[noreturn]] void fail_unknown_plugin(const Object& object,
                                      std::initializer_list<std::string_view> known);

}  // namespace renderer
