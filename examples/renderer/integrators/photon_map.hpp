// SPDX-License-Identifier: MIT
// Photons in a hash grid, for the merging of subpaths. A cell's number is that of the point of a
// lattice without bounds, so that no query falls off an edge; that two cells may share a bucket is
// told apart by the photons' own cells, so that none is met twice.
#pragma once

#include <bit>
#include <cstdint>
#include <span>

#include "light_subpath.hpp"

namespace renderer {

/// What merging needs of a light vertex. The light of many is polarised; it is stored as the Stokes
/// vector that left the vertex before.
template <class R>
struct Photon {
  Vec3 position, incident, geometric_normal;  ///< no normal in a medium
  SubpathMis mis;
  int edges;
  typename R::Light light;
};

template <class R>
class PhotonMap {
 public:
  /// Takes the vertices of all paths, those on surfaces or those in media. Equal input gives an
  /// equal map. The radius is above 0, and not less than a millionth of the photons' farthest
  /// distance from `center`.
  template <class M>
  void build(std::span<const LightPaths<R, M>> paths, bool in_media, const Vec3& center,
             float radius) {
    radius_ = radius;
    center_ = center;
    inverse_cell_ = 1 / (2 * radius);
    std::size_t count = 0;
    const auto each = [&](auto&& visit) {
      for (const auto& p : paths)
        for (const auto& v : p.vertices)
          if (v.scatterer.is_medium() == in_media) visit(v);
    };
    each([&](const auto&) { ++count; });
    const std::size_t buckets = std::bit_ceil(std::max<std::size_t>(count, 1024));
    mask_ = static_cast<std::uint32_t>(buckets - 1);
    starts_.assign(buckets + 1, 0);
    photons_.resize(count);

    each([&](const auto& v) { ++starts_[bucket(cell(v.point.position)) + 1]; });
    for (std::size_t b = 0; b < buckets; ++b) starts_[b + 1] += starts_[b];
    // Filling moves each bucket's start to its end, which is the next one's start.
    each([&](const auto& v) {
      photons_[starts_[bucket(cell(v.point.position))]++] = {
          v.point.position, v.incident, v.point.geometric_normal, v.mis, v.edges, v.light};
    });
    for (std::size_t b = buckets; b > 0; --b) starts_[b] = starts_[b - 1];
    starts_[0] = 0;
  }

  /// Shows every photon nearer to a point than the radius, once.
  template <class Visit>
  void each_near(const Vec3& point, Visit&& visit) const {
    // A ball as wide as a cell reaches into the nearer neighbour in each dimension, no farther.
    const Vec3 place = lattice(point);
    const glm::ivec3 home(glm::floor(place));
    const glm::ivec3 low = home - glm::ivec3(glm::lessThan(place - Vec3(home), Vec3(0.5f)));
    const float radius2 = radius_ * radius_;
    for (int corner = 0; corner < 8; ++corner) {
      const glm::ivec3 c = low + glm::ivec3(corner & 1, corner >> 1 & 1, corner >> 2);
      const std::uint32_t b = bucket(c);
      for (std::uint32_t i = starts_[b]; i < starts_[b + 1]; ++i) {
        const Photon<R>& photon = photons_[i];
        const Vec3 way = photon.position - point;
        if (glm::dot(way, way) < radius2 && cell(photon.position) == c) visit(photon);
      }
    }
  }

  float radius() const { return radius_; }
  std::size_t bytes() const {
    return photons_.capacity() * sizeof(Photon<R>) + starts_.capacity() * sizeof(std::uint32_t);
  }

 private:
  Vec3 lattice(const Vec3& p) const { return (p - center_) * inverse_cell_; }
  glm::ivec3 cell(const Vec3& p) const { return glm::ivec3(glm::floor(lattice(p))); }
  std::uint32_t bucket(const glm::ivec3& c) const {
    // Teschner et al. 2003, "Optimized spatial hashing for collision detection".
    const glm::uvec3 u(c);
    return ((u.x * 73856093u) ^ (u.y * 19349663u) ^ (u.z * 83492791u)) & mask_;
  }

  Vec3 center_{};
  float radius_ = 0, inverse_cell_ = 0;
  std::uint32_t mask_ = 0;
  std::vector<std::uint32_t> starts_;  // of each bucket's photons
  std::vector<Photon<R>> photons_;
};

}  // namespace renderer
