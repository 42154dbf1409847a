// SPDX-License-Identifier: MIT
#include "geometry.hpp"

#include <algorithm>
#include <string>
#include <variant>

#include "../io/input_error.hpp"

#if MALUS_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace renderer {

namespace {

/// The nearer root above `nearest` of |o + t d − c| = r, in double precision, since grazing rays
/// cancel badly in single.
float intersect_sphere(const Sphere& s, const glm::dvec3& origin, const glm::dvec3& direction,
                       double nearest, double farthest) {
  const glm::dvec3 o = origin - glm::dvec3(s.center);
  const double a = glm::dot(direction, direction), b = glm::dot(o, direction);
  const double r = static_cast<double>(s.radius);
  if (b > 0 && glm::dot(o, o) > r * r * (1 + 1e-9)) return -1;  // behind
  const double inverse = 1 / a;
  const glm::dvec3 closest = o - (b * inverse) * direction;
  const double discriminant = a * (r * r - glm::dot(closest, closest));
  if (discriminant < 0) return -1;
  const double q = -(b + std::copysign(std::sqrt(discriminant), b));
  double t0 = q * inverse, t1 = q != 0 ? (glm::dot(o, o) - r * r) / q : t0;
  if (t0 > t1) std::swap(t0, t1);
  if (t0 > nearest && t0 < farthest) return static_cast<float>(t0);
  if (t1 > nearest && t1 < farthest) return static_cast<float>(t1);
  return -1;
}

void sphere_bounds(const RTCBoundsFunctionArguments* args) {
  const auto& s = *static_cast<const Sphere*>(args->geometryUserPtr);
  const float r = s.radius * (1 + 1e-6f);
  *args->bounds_o = {s.center.x - r, s.center.y - r, s.center.z - r, 0,
                     s.center.x + r, s.center.y + r, s.center.z + r, 0};
}

template <class RayType>
float sphere_distance(const Sphere& s, const RayType& ray) {
  return intersect_sphere(s, {ray.org_x, ray.org_y, ray.org_z}, {ray.dir_x, ray.dir_y, ray.dir_z},
                          static_cast<double>(ray.tnear), static_cast<double>(ray.tfar));
}

void sphere_intersect(const RTCIntersectFunctionNArguments* args) {
  if (!args->valid[0]) return;
  const auto& s = *static_cast<const Sphere*>(args->geometryUserPtr);
  auto& rayhit = *reinterpret_cast<RTCRayHit*>(args->rayhit);
  const float t = sphere_distance(s, rayhit.ray);
  if (t < 0) return;
  rayhit.ray.tfar = t;
  rayhit.hit.geomID = args->geomID;
  rayhit.hit.primID = 0;
  rayhit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
}

void sphere_occluded(const RTCOccludedFunctionNArguments* args) {
  if (!args->valid[0]) return;
  const auto& s = *static_cast<const Sphere*>(args->geometryUserPtr);
  auto& ray = *reinterpret_cast<RTCRay*>(args->ray);
  if (sphere_distance(s, ray) >= 0) ray.tfar = -infinity;
}

/// A hit's position in the sphere's own axes, from its centre.
Vec3 local_to(const Sphere& s, const Hit& hit) {
  return glm::transpose(s.rotation) * (hit.position - s.center);
}

/// A hit is known to some 10 ulp of its shape's coordinates; this is 20 times as far. What counts
/// is how well it is known across the surface: a level that lies low may be as wide as it will, but
/// for what its normal is uncertain by.
float reach_of(const Vec3& largest, const Vec3& normal) {
  const float widest = std::max(largest.x, std::max(largest.y, largest.z));
  return 2e-5f * glm::dot(glm::abs(normal), largest) + 5e-7f * widest;
}

/// Of a triangle: its normal by its winding, and how far off it rays start.
struct Face {
  Vec3 normal;
  float reach;
};

/// In double precision, in which no triangle is too small.
std::vector<Face> faces_of(const TriangleMesh& mesh, const Vec3& largest) {
  std::vector<Face> faces;
  faces.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    const glm::dvec3 a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
    const Vec3 normal(glm::normalize(glm::cross(b - a, c - a)));
    faces.push_back({normal, reach_of(largest, normal)});
  }
  return faces;
}

void to_embree(const Ray& ray, RTCRay& r) {
  r.org_x = ray.origin.x;
  r.org_y = ray.origin.y;
  r.org_z = ray.origin.z;
  r.dir_x = ray.direction.x;
  r.dir_y = ray.direction.y;
  r.dir_z = ray.direction.z;
  r.tnear = 0;
  r.tfar = ray.length;
  r.time = 0;
  r.mask = 0xffffffffu;
  r.id = r.flags = 0;
}

}  // namespace

struct Geometry::Embree {
  RTCDevice device = nullptr;
  RTCScene all = nullptr;
  // Parts of it: two others where light may pass some shapes, else all of them and nothing.
  RTCScene solid = nullptr, passages = nullptr;
  std::vector<RTCGeometry> geometries;  // until they are committed
  std::vector<bool> lets_pass;          // by shape
  std::vector<std::unique_ptr<std::variant<TriangleMesh, Sphere>>> shapes;
  std::vector<std::vector<Face>> faces;  // by shape; none of spheres
  std::vector<Vec3> largest;             // by shape: coordinates' magnitudes

  Embree() {
    device = rtcNewDevice(nullptr);
    if (!device) throw WorkError("Embree cannot start on this machine");
    all = new_scene();
  }
  ~Embree() {
    for (RTCGeometry geometry : geometries) rtcReleaseGeometry(geometry);
    for (RTCScene scene : {all, solid, passages})
      if (scene) rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;

  RTCScene new_scene() const {
    RTCScene scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
    return scene;
  }

  std::uint32_t add(RTCGeometry geometry) {
    rtcCommitGeometry(geometry);
    geometries.push_back(geometry);
    lets_pass.push_back(false);
    return rtcAttachGeometry(all, geometry);
  }

  void commit() {
    if (std::find(lets_pass.begin(), lets_pass.end(), true) != lets_pass.end()) {
      solid = new_scene();
      passages = new_scene();
      for (unsigned i = 0; i < geometries.size(); ++i)
        rtcAttachGeometryByID(lets_pass[i] ? passages : solid, geometries[i], i);
      rtcCommitScene(solid);
      rtcCommitScene(passages);
    }
    rtcCommitScene(all);
    for (RTCGeometry geometry : geometries) rtcReleaseGeometry(geometry);
    geometries.clear();
  }

  bool intersect(RTCScene scene, const Ray& ray, Hit& hit) const;
};

Geometry::Geometry() : embree_(std::make_unique<Embree>()) {}
Geometry::~Geometry() = default;
Geometry::Geometry(Geometry&&) noexcept = default;
Geometry& Geometry::operator=(Geometry&&) noexcept = default;

std::uint32_t Geometry::add(TriangleMesh mesh) {
  Vec3 largest(0.0f);
  for (const Vec3& p : mesh.positions) largest = glm::max(largest, glm::abs(p));
  embree_->largest.push_back(largest);
  embree_->faces.push_back(faces_of(mesh, largest));
  auto& stored = std::get<TriangleMesh>(*embree_->shapes.emplace_back(
      std::make_unique<std::variant<TriangleMesh, Sphere>>(std::move(mesh))));
  RTCGeometry geometry = rtcNewGeometry(embree_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* positions = static_cast<float*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                              3 * sizeof(float), stored.positions.size()));
  auto* indices = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), stored.triangles.size()));
  if (!positions || !indices) throw WorkError("no memory for a mesh");
  for (const auto& p : stored.positions)
    for (int i = 0; i < 3; ++i) *positions++ = p[i];
  for (const auto& t : stored.triangles)
    for (const auto i : t) *indices++ = i;
  return embree_->add(geometry);
}

std::uint32_t Geometry::add(const Sphere& sphere) {
  embree_->faces.emplace_back();
  embree_->largest.push_back(glm::abs(sphere.center) + sphere.radius);
  auto& stored = std::get<Sphere>(
      *embree_->shapes.emplace_back(std::make_unique<std::variant<TriangleMesh, Sphere>>(sphere)));
  RTCGeometry geometry = rtcNewGeometry(embree_->device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, 1);
  rtcSetGeometryUserData(geometry, &stored);
  rtcSetGeometryBoundsFunction(geometry, sphere_bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, sphere_intersect);
  rtcSetGeometryOccludedFunction(geometry, sphere_occluded);
  return embree_->add(geometry);
}

void Geometry::let_light_pass(std::uint32_t shape) { embree_->lets_pass[shape] = true; }

void Geometry::commit() {
  embree_->commit();
  if (const RTCError error = rtcGetDeviceError(embree_->device); error != RTC_ERROR_NONE)
    throw WorkError("Embree reports error " + std::to_string(error) + " in building the scene");
  if (embree_->shapes.empty()) return;
  RTCBounds b{};
  rtcGetSceneBounds(embree_->all, &b);
  const Vec3 low(b.lower_x, b.lower_y, b.lower_z), high(b.upper_x, b.upper_y, b.upper_z);
  center_ = 0.5f * (low + high);
  radius_ = glm::length(high - center_);
}

bool Geometry::Embree::intersect(RTCScene scene, const Ray& ray, Hit& hit) const {
  RTCRayHit query;
  to_embree(ray, query.ray);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if MALUS_EMBREE_MAJOR >= 4
  rtcIntersect1(scene, &query);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &query);
#endif
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;

  hit.distance = query.ray.tfar;
  hit.shape = query.hit.geomID;
  hit.primitive = query.hit.primID;
  const auto& shape = *shapes[hit.shape];
  if (const auto* s = std::get_if<Sphere>(&shape)) {
    const Vec3 outward = normalized(ray.origin + hit.distance * ray.direction - s->center);
    hit.position = s->center + s->radius * outward;
    const Vec3 front = outward * (s->flipped ? -1.0f : 1.0f);
    hit.normal = by_components(front);
    hit.geometric_normal = by_components(front);
    hit.reach = reach_of(largest[hit.shape], outward);
    hit.parameter = {};
    return true;
  }
  const auto& mesh = std::get<TriangleMesh>(shape);
  const auto& t = mesh.triangles[hit.primitive];
  const float u = query.hit.u, v = query.hit.v, w = 1 - u - v;
  hit.parameter = {u, v};
  const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
  hit.position = w * a + u * b + v * c;
  const Face& face = faces[hit.shape][hit.primitive];
  hit.normal = hit.geometric_normal = face.normal;
  hit.reach = face.reach;
  if (!mesh.normals.empty()) {
    const Vec3 n = w * mesh.normals[t[0]] + u * mesh.normals[t[1]] + v * mesh.normals[t[2]];
    const float length2 = glm::dot(n, n);
    if (length2 > 1e-12f) hit.normal = n / std::sqrt(length2);
    // Where a file's winding and its normals disagree, its normals say which side is the front.
    if (glm::dot(hit.normal, hit.geometric_normal) < 0)
      hit.geometric_normal = -hit.geometric_normal;
  }
  return true;
}

bool Geometry::intersect(const Ray& ray, Hit& hit) const {
  return embree_->intersect(embree_->all, ray, hit);
}

bool Geometry::intersect_passages(const Ray& ray, Hit& hit) const {
  return embree_->passages && embree_->intersect(embree_->passages, ray, hit);
}

bool Geometry::occluded(const Ray& ray) const {
  const RTCScene scene = embree_->solid ? embree_->solid : embree_->all;
  RTCRay query;
  to_embree(ray, query);
#if MALUS_EMBREE_MAJOR >= 4
  rtcOccluded1(scene, &query);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene, &context, &query);
#endif
  return query.tfar < 0;
}

void Geometry::complete(const HitNeeds& needs, Hit& hit) const {
  if (needs.uv) hit.uv = uv(hit);
  if (needs.tangent) hit.tangent = tangent(hit);
  if (needs.partials) {
    const auto [du, dv] = partials(hit);
    hit.dp_du = du;
    hit.dp_dv = dv;
  }
}

Vec2 Geometry::uv(const Hit& hit) const {
  if (is_sphere(hit.shape)) {
    const Vec3 p = local_to(sphere(hit.shape), hit);
    const float longitude = std::atan2(p.y, p.x) / (2 * pi);
    // Better than acos near the poles.
    const float colatitude = std::atan2(std::hypot(p.x, p.y), p.z) / pi;
    return {longitude < 0 ? longitude + 1 : longitude, colatitude};
  }
  const TriangleMesh& m = mesh(hit.shape);
  if (m.texcoords.empty()) return hit.parameter;
  const auto& t = m.triangles[hit.primitive];
  const float u = hit.parameter.x, v = hit.parameter.y;
  return (1 - u - v) * m.texcoords[t[0]] + u * m.texcoords[t[1]] + v * m.texcoords[t[2]];
}

std::array<Vec3, 2> Geometry::partials(const Hit& hit) const {
  if (is_sphere(hit.shape)) {
    const Sphere& s = sphere(hit.shape);
    const Vec3 p = local_to(s, hit);
    const float r = std::hypot(p.x, p.y);
    const Vec2 out = r > 0 ? Vec2(p.x, p.y) / r : Vec2(1, 0);
    return {2 * pi * (s.rotation * Vec3(-p.y, p.x, 0)),
            pi * (s.rotation * Vec3(p.z * out.x, p.z * out.y, -r))};
  }
  const TriangleMesh& m = mesh(hit.shape);
  const auto& t = m.triangles[hit.primitive];
  const Vec3 e1 = m.positions[t[1]] - m.positions[t[0]], e2 = m.positions[t[2]] - m.positions[t[0]];
  if (m.texcoords.empty()) return {e1, e2};
  const Vec2 d1 = m.texcoords[t[1]] - m.texcoords[t[0]], d2 = m.texcoords[t[2]] - m.texcoords[t[0]];
  const float determinant = d1.x * d2.y - d1.y * d2.x;
  if (determinant == 0) return {};
  return {(d2.y * e1 - d1.y * e2) / determinant, (d1.x * e2 - d2.x * e1) / determinant};
}

Vec3 Geometry::tangent(const Hit& hit) const {
  Vec3 along(0);
  if (is_sphere(hit.shape) || !mesh(hit.shape).texcoords.empty()) along = partials(hit)[0];
  return tangent_along(along, hit.normal);
}

bool Geometry::is_sphere(std::uint32_t shape) const {
  return std::holds_alternative<Sphere>(*embree_->shapes[shape]);
}
const Sphere& Geometry::sphere(std::uint32_t shape) const {
  return std::get<Sphere>(*embree_->shapes[shape]);
}
const TriangleMesh& Geometry::mesh(std::uint32_t shape) const {
  return std::get<TriangleMesh>(*embree_->shapes[shape]);
}
std::array<Vec3, 2> Geometry::bounds(std::uint32_t shape) const {
  if (is_sphere(shape)) {
    const Sphere& s = sphere(shape);
    return {s.center - s.radius, s.center + s.radius};
  }
  Vec3 low(infinity), high(-infinity);
  for (const Vec3& p : mesh(shape).positions) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  return {low, high};
}
const Vec3& Geometry::face_normal(std::uint32_t shape, std::size_t triangle) const {
  return embree_->faces[shape][triangle].normal;
}
float Geometry::reach(std::uint32_t shape, const Vec3& geometric_normal) const {
  return reach_of(embree_->largest[shape], geometric_normal);
}
std::size_t Geometry::shape_count() const { return embree_->shapes.size(); }
std::size_t Geometry::triangle_count() const {
  std::size_t count = 0;
  for (const auto& shape : embree_->shapes)
    if (const auto* m = std::get_if<TriangleMesh>(shape.get())) count += m->triangles.size();
  return count;
}

}  // namespace renderer
