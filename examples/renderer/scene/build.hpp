// SPDX-License-Identifier: MIT
// From a scene file's objects to a scene. One factory a kind of plugin; each knows its plugins'
// names, parameters and defaults, which are Mitsuba's, and refuses what it doesn't know.
#pragma once

#include <memory>
#include <unordered_map>

#include "build_medium.hpp"
#include "build_texture.hpp"
#include "object.hpp"
#include "scene.hpp"

namespace renderer {

/// Throws InputError where the file asks for what there isn't.
Scene build_scene(const Object& root);

// the factories

/// A number, or a material by its name.
double index_of_refraction(const Object& object, std::string_view name, std::string_view otherwise);

/// The kind of a <bsdf> that is one; "twosided" and the like are of the material.
Bsdf::Kind make_bsdf_kind(const Object& bsdf, TextureFactory& textures);

class MaterialFactory {
 public:
  explicit MaterialFactory(Scene& scene) : scene_(scene), textures_(scene.textures) {}
  /// The material of a <bsdf>; one for each object, however often it is referred to. Null: the
  /// default, diffuse of ½, or of 0 where the shape emits.
  Material make(const Object::Pointer& object, bool emits);

  TextureFactory& textures() { return textures_; }

 private:
  Material make_anew(const Object& object);
  Material make_two_sided(const Object& object);
  Material make_masked(const Object& object);
  Material make_perturbed(const Object& object);
  /// The material of the one <bsdf> in a wrapper such as "mask".
  Material make_inner(const Object& object);
  Perturbation make_perturbation(const Object& object);

  Scene& scene_;
  TextureFactory textures_;
  std::unordered_map<const Object*, Material> made_;
  const Bsdf* default_ = nullptr;
  const Bsdf* default_of_emitters_ = nullptr;
};

/// Refuses a mesh with which the machine's memory would not hold all of the scene's triangles.
void check_triangles_fit(const Object& shape, double triangles);

/// Adds a <shape>'s geometry and returns its number.
std::uint32_t add_shape_geometry(const Object& shape, Geometry& geometry,
                                 std::vector<std::string>& warnings);

/// A <emitter> of a shape.
AreaLight make_area_light(const Object& emitter, const Geometry& geometry, std::uint32_t shape);
/// A <emitter> of the scene itself, whose textures hold so many bytes.
Emitter make_light(const Object& emitter, std::uint64_t held);

void build_sensor(const Object& sensor, MediumFactory& media, Scene& scene);
void build_integrator(const Object& integrator, Scene& scene);

/// By its name in a scene file or on the command line; the other settings stay.
void set_integrator(IntegratorSettings& settings, const std::string& name);

/// A warning with the object's line.
void warn(Scene& scene, const Object& object, const std::string& message);

/// "x" is not a bsdf that is known here; known are a, b, c.
[[noreturn]] void fail_unknown_plugin(const Object& object,
                                      std::initializer_list<std::string_view> known);

}  // namespace renderer
