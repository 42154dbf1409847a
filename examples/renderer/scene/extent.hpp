// SPDX-License-Identifier: MIT
// Where things are and where their light can go, as half-spaces, balls and boxes tell: what is
// needed to prove that two things never exchange light directly, or that the sensor never sees one.
// All answers err on one side: "yes" may be wrong, "no" is not. Nothing hides anything, but for an
// opaque sphere, which keeps what is in it.
//
// What is on a plane is not in front of it: rays start farther off a surface than single precision
// is off the plane (Geometry::reach).
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "../geometry/geometry.hpp"

namespace renderer {

/// The sides of a surface that scatter light.
struct Sides {
  bool front = false, back = false;
};

/// A part of a plane, a sphere, or a box anywhere in which light may be scattered to anywhere.
class Facet {
 public:
  /// `points` span a polygon that holds the part, or a hull around it.
  static Facet plane(const glm::dvec3& normal, const glm::dvec3& origin,
                     std::vector<glm::dvec3> points, Sides sides);
  /// `is_closed`: nothing passes through the sphere itself.
  static Facet sphere(const glm::dvec3& center, double radius, bool outside, bool inside,
                      bool is_closed);
  static Facet box(const glm::dvec3& low, const glm::dvec3& high);

  /// Whether light can go from some point of this one straight to some point within `slack` of the
  /// other.
  bool sends_to(const Facet& other, double slack) const;
  bool sends_to(const glm::dvec3& point) const;
  /// The same both ways. With slack, light that reaches a point counts as having reached all others
  /// so near, whatever is there.
  bool exchanges_with(const Facet& other, double slack) const;
  bool exchanges_with_itself(double slack) const;

  /// The greatest n · q of its points q.
  double farthest_along(const glm::dvec3& n) const;
  /// A box around it: its least and its greatest coordinates.
  std::array<glm::dvec3, 2> bounds() const;
  /// Whether a ray of unit direction meets it, or the box around it.
  bool may_be_met(const glm::dvec3& origin, const glm::dvec3& direction) const;

 private:
  enum class Form { plane, sphere, box };

  /// The way that all light leaves a plane with one side; zero where there is no such thing.
  glm::dvec3 only_side() const;
  double farthest_from(const glm::dvec3& point) const;
  double nearest_to(const glm::dvec3& point) const;

  Form form_ = Form::box;
  Sides sides_{true, true};           // of a sphere, its outside and its inside
  glm::dvec3 normal_{0}, origin_{0};  // of a sphere, its centre
  double radius_ = 0, tolerance_ = 0;
  bool is_closed_ = false;
  std::vector<glm::dvec3> points_;
};

/// All of a shape, or of a medium.
struct Extent {
  std::vector<Facet> facets;
  bool is_everywhere = false;

  bool exchanges_with(const Extent& other, double slack) const;
  bool exchanges_with_itself(double slack) const;
};

/// Of the sides of a shape. A mesh of many planes is the box around it.
Extent extent_of(const Geometry& geometry, std::uint32_t shape, Sides sides, bool is_masked);
/// Of what is behind a shape's front: the ball or the box around it, or everywhere if light could
/// get out of there by another way than through the shape.
Extent inside_of(const Geometry& geometry, std::uint32_t shape);

}  // namespace renderer
