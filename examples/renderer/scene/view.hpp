// SPDX-License-Identifier: MIT
// What a sensor could see if nothing hid anything. As with extents, "no" is proved.
#pragma once

#include <vector>

#include "extent.hpp"
#include "scene.hpp"

namespace renderer {

class View {
 public:
  explicit View(const Scene& scene);

  bool may_see(const Extent& extent) const;

 private:
  bool may_see(const Facet& facet) const;

  Sensor::Kind kind_;
  glm::dvec3 origin_, direction_{0};  // the latter of a single ray
  std::vector<glm::dvec3> inwards_;   // normals of the planes around the picture, through the lens
};

}  // namespace renderer
