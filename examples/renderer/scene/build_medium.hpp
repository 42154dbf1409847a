// SPDX-License-Identifier: MIT
// From a scene file's <medium>, <phase> and <volume> to a medium.
#pragma once

#include <map>
#include <memory>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "object.hpp"
#include "scene.hpp"

namespace renderer {

PhaseFunction make_phase(const Object& phase);

/// Media go into the scene as something refers to them: those that nothing does are no part of it.
class MediumFactory {
 public:
  explicit MediumFactory(Scene& scene) : scene_(scene) {}

  /// Of a <medium>; one for each object, however often it is referred to. Null: vacuum.
  const Medium* make(const Object::Pointer& object);

  /// What stands in a scene and nothing has referred to is read, for its errors.
  void check_unused(const Object& root);

 private:
  using Grid = std::shared_ptr<const DensityGrid>;
  /// A parameter that may vary within a medium: the grid, or, if that is null, the value.
  struct Volume {
    glm::dvec3 value{0};
    glm::dmat4 to_world{1.0};
    Grid grid{};
  };
  struct Coefficients {
    glm::dvec3 extinction, albedo, absorption;
  };

  Medium::Description describe(const Object& object);
  Medium::Description describe_homogeneous(const Object& object);
  Medium::Description describe_heterogeneous(const Object& object);
  Coefficients coefficients(const Object& object);
  PhaseFunction phase_of(const Object& medium);
  const PhaseFunction& phase(const Object::Pointer& object);

  Volume read_volume(const Object::Pointer& object, double highest, DensityGrid::Outside outside);
  Volume volume(const Object& object, std::string_view name, double otherwise, double highest,
                DensityGrid::Outside outside);
  /// The same where it may not vary.
  glm::dvec3 constant(const Object& object, std::string_view name, double otherwise,
                      double highest);
  Grid grid(const Object::Pointer& object, DensityGrid::Outside outside);

  Scene& scene_;
  std::unordered_map<const Object*, const Medium*> media_;
  std::unordered_map<const Object*, PhaseFunction> phases_;
  std::map<std::pair<const Object*, DensityGrid::Outside>, Grid> grids_;
};

}  // namespace renderer
