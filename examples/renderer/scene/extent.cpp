// SPDX-License-Identifier: MIT
#include "extent.hpp"

#include <algorithm>
#include <limits>
#include <set>

namespace renderer {

namespace {

using glm::dvec3;

/// Of coordinates that single precision holds, and of what is computed from them.
constexpr double rounding = 4e-7;
constexpr double no_end = std::numeric_limits<double>::infinity();
constexpr std::size_t most_planes = 24, most_points = 64;

double largest_coordinate(const dvec3& p) {
  return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
}

struct Box {
  dvec3 low{no_end}, high{-no_end};
  void include(const dvec3& p) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  std::vector<dvec3> corners() const {
    std::vector<dvec3> result;
    for (int i = 0; i < 8; ++i)
      result.emplace_back(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z);
    return result;
  }
};

}  // namespace

Facet Facet::plane(const dvec3& normal, const dvec3& origin, std::vector<dvec3> points,
                   Sides sides) {
  Facet f;
  f.form_ = Form::plane;
  f.normal_ = normal;
  f.origin_ = origin;
  f.sides_ = sides;
  double largest = 0;
  Box box;
  for (const dvec3& p : points) {
    largest = std::max(largest, largest_coordinate(p));
    box.include(p);
  }
  f.tolerance_ = rounding * largest;
  f.points_ = points.size() > most_points ? box.corners() : std::move(points);
  return f;
}

Facet Facet::sphere(const dvec3& center, double radius, bool outside, bool inside, bool is_closed) {
  Facet f;
  f.form_ = Form::sphere;
  f.origin_ = center;
  f.radius_ = radius;
  f.sides_ = {outside, inside};
  f.is_closed_ = is_closed;
  f.tolerance_ = rounding * (largest_coordinate(center) + radius);
  return f;
}

Facet Facet::box(const dvec3& low, const dvec3& high) {
  Facet f;
  f.points_ = Box{low, high}.corners();
  f.tolerance_ = rounding * std::max(largest_coordinate(low), largest_coordinate(high));
  return f;
}

double Facet::farthest_along(const dvec3& n) const {
  if (form_ == Form::sphere) return glm::dot(n, origin_) + radius_ * glm::length(n);
  double farthest = -no_end;
  for (const dvec3& p : points_) farthest = std::max(farthest, glm::dot(n, p));
  return farthest;
}

double Facet::farthest_from(const dvec3& point) const {
  if (form_ == Form::sphere) return glm::distance(point, origin_) + radius_;
  double farthest = 0;
  for (const dvec3& p : points_) farthest = std::max(farthest, glm::distance(point, p));
  return farthest;
}

double Facet::nearest_to(const dvec3& point) const {
  if (form_ == Form::sphere) return std::max(glm::distance(point, origin_) - radius_, 0.0);
  const auto [low, high] = bounds();
  return glm::distance(point, glm::clamp(point, low, high));
}

std::array<dvec3, 2> Facet::bounds() const {
  if (form_ == Form::sphere) return {origin_ - radius_, origin_ + radius_};
  Box box;
  for (const dvec3& p : points_) box.include(p);
  return {box.low, box.high};
}

bool Facet::sends_to(const Facet& other, double slack) const {
  switch (form_) {
    case Form::plane: {
      const double height = glm::dot(normal_, origin_), least = tolerance_ - slack;
      return (sides_.front && other.farthest_along(normal_) - height > least) ||
             (sides_.back && other.farthest_along(-normal_) + height > least);
    }
    case Form::sphere:
      return (sides_.front && other.farthest_from(origin_) + slack > radius_) ||
             (sides_.back &&
              (!is_closed_ || other.nearest_to(origin_) - slack < radius_ + tolerance_));
    case Form::box:
      return true;
  }
  return true;
}

bool Facet::sends_to(const dvec3& point) const {
  Facet at;
  at.points_ = {point};
  if (form_ != Form::sphere) return sends_to(at, 0);
  // Clipping lets a sensor see from outside what is inside.
  return sides_.back || sends_to(at, 0);
}

dvec3 Facet::only_side() const {
  if (form_ != Form::plane || sides_.front == sides_.back) return dvec3(0);
  return sides_.front ? normal_ : -normal_;
}

bool Facet::exchanges_with(const Facet& other, double slack) const {
  // Light that leaves a plane upwards comes from below to any other that looks upwards too, even if
  // it arrives within the slack of that.
  if (glm::dot(only_side(), other.only_side()) > 1 - 1e-13) return false;
  return sends_to(other, slack) && other.sends_to(*this, slack);
}

bool Facet::exchanges_with_itself(double slack) const {
  switch (form_) {
    case Form::plane:
      return slack > 0 && sides_.front && sides_.back;
    case Form::sphere:
      return slack > 0 || sides_.back;
    case Form::box:
      return true;
  }
  return true;
}

bool Facet::may_be_met(const dvec3& origin, const dvec3& direction) const {
  const auto [low, high] = bounds();
  const double margin =
      1e-5 * (largest_coordinate(low) + largest_coordinate(high) + largest_coordinate(origin));
  if (form_ == Form::sphere) {
    const double along = std::max(glm::dot(origin_ - origin, direction), 0.0);
    return glm::distance(origin_, origin + along * direction) <= radius_ + margin;
  }
  double from = 0, to = no_end;
  for (int i = 0; i < 3; ++i) {
    const double a = low[i] - margin - origin[i], b = high[i] + margin - origin[i];
    if (direction[i] == 0) {
      if (a > 0 || b < 0) return false;
      continue;
    }
    const double s = a / direction[i], t = b / direction[i];
    from = std::max(from, std::min(s, t));
    to = std::min(to, std::max(s, t));
  }
  return from <= to;
}

bool Extent::exchanges_with(const Extent& other, double slack) const {
  if (is_everywhere || other.is_everywhere) return true;
  for (const Facet& a : facets)
    for (const Facet& b : other.facets)
      if (a.exchanges_with(b, slack)) return true;
  return false;
}

bool Extent::exchanges_with_itself(double slack) const {
  if (is_everywhere) return true;
  for (std::size_t i = 0; i < facets.size(); ++i) {
    if (facets[i].exchanges_with_itself(slack)) return true;
    for (std::size_t j = i + 1; j < facets.size(); ++j)
      if (facets[i].exchanges_with(facets[j], slack)) return true;
  }
  return false;
}

namespace {

/// The triangles of a mesh that lie in one plane and have the same side for their front.
struct Plane {
  dvec3 normal, origin;
  bool has_two_fronts;  ///< which side is the front depends on the place
  std::vector<dvec3> points;

  bool holds(const dvec3& n, bool two_fronts, const std::array<dvec3, 3>& corners,
             double tolerance) const {
    return has_two_fronts == two_fronts && glm::dot(normal, n) > 0 &&
           largest_coordinate(normal - n) < 1e-6 &&
           std::all_of(corners.begin(), corners.end(), [&](const dvec3& p) {
             return std::abs(glm::dot(normal, p - origin)) <= tolerance;
           });
  }
};

/// Where normals of a file disagree with its winding, they say which side is the front.
bool has_two_fronts(const TriangleMesh& mesh, std::size_t triangle, const dvec3& normal) {
  if (mesh.normals.empty()) return false;
  for (const auto i : mesh.triangles[triangle])
    if (!(glm::dot(dvec3(mesh.normals[i]), normal) > 0)) return true;
  return false;
}

/// All planes of a mesh; none if there are too many.
std::vector<Plane> planes_of(const Geometry& geometry, std::uint32_t shape) {
  const TriangleMesh& mesh = geometry.mesh(shape);
  const auto [low, high] = geometry.bounds(shape);
  const double tolerance =
      rounding * std::max(largest_coordinate(dvec3(low)), largest_coordinate(dvec3(high)));
  std::vector<Plane> planes;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    const std::array<dvec3, 3> corners{dvec3(mesh.positions[t[0]]), dvec3(mesh.positions[t[1]]),
                                       dvec3(mesh.positions[t[2]])};
    const dvec3 n(geometry.face_normal(shape, i));
    const bool two_fronts = has_two_fronts(mesh, i, n);
    auto found = std::find_if(planes.begin(), planes.end(), [&](const Plane& p) {
      return p.holds(n, two_fronts, corners, tolerance);
    });
    if (found == planes.end()) {
      if (planes.size() == most_planes) return {};
      found = planes.insert(planes.end(), Plane{n, corners[0], two_fronts, {}});
    }
    auto& points = found->points;
    for (const dvec3& p : corners)
      if (points.size() > most_points || std::find(points.begin(), points.end(), p) == points.end())
        points.push_back(p);
  }
  return planes;
}

Facet box_around(const Geometry& geometry, std::uint32_t shape) {
  const auto [low, high] = geometry.bounds(shape);
  return Facet::box(dvec3(low), dvec3(high));
}

/// Every edge has a triangle on either side.
bool is_watertight(const TriangleMesh& mesh) {
  using Point = std::array<float, 3>;
  std::multiset<std::array<Point, 2>> edges;
  const auto point = [&](std::uint32_t i) {
    const Vec3& p = mesh.positions[i];
    return Point{p.x, p.y, p.z};
  };
  for (const auto& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) edges.insert({point(t[i]), point(t[(i + 1) % 3])});
  return std::all_of(edges.begin(), edges.end(), [&](const std::array<Point, 2>& e) {
    return edges.count(e) == 1 && edges.count({e[1], e[0]}) == 1;
  });
}

/// Then it is in one piece, too.
bool is_convex_body(const Geometry& geometry, std::uint32_t shape) {
  const std::vector<Plane> planes = planes_of(geometry, shape);
  const TriangleMesh& mesh = geometry.mesh(shape);
  for (const Plane& plane : planes) {
    if (plane.has_two_fronts) return false;
    const Facet facet = Facet::plane(plane.normal, plane.origin, plane.points, {true, false});
    for (const Vec3& p : mesh.positions)
      if (facet.sends_to(dvec3(p))) return false;
  }
  return !planes.empty() && is_watertight(mesh);
}

}  // namespace

Extent extent_of(const Geometry& geometry, std::uint32_t shape, Sides sides, bool is_masked) {
  if (geometry.is_sphere(shape)) {
    const Sphere& s = geometry.sphere(shape);
    const bool outside = s.flipped ? sides.back : sides.front;
    const bool inside = s.flipped ? sides.front : sides.back;
    // What scatters inside alone reflects alone.
    return {{Facet::sphere(dvec3(s.center), static_cast<double>(s.radius), outside, inside,
                           !is_masked && !outside)}};
  }
  Extent extent;
  for (Plane& plane : planes_of(geometry, shape)) {
    const bool both = plane.has_two_fronts;
    extent.facets.push_back(Facet::plane(plane.normal, plane.origin, std::move(plane.points),
                                         both ? Sides{true, true} : sides));
  }
  if (extent.facets.empty()) extent.facets.push_back(box_around(geometry, shape));
  return extent;
}

Extent inside_of(const Geometry& geometry, std::uint32_t shape) {
  if (geometry.is_sphere(shape)) {
    const Sphere& s = geometry.sphere(shape);
    if (s.flipped) return {{}, true};
    return {{Facet::sphere(dvec3(s.center), static_cast<double>(s.radius), true, true, false)},
            false};
  }
  if (!is_convex_body(geometry, shape)) return {{}, true};
  return {{box_around(geometry, shape)}, false};
}

}  // namespace renderer
