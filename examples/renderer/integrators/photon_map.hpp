// SPDX-License-Identifier: MIT
// Photons in a hash grid, for the merging of subpaths. A cell's number is that of the point of a
// lattice without bounds, so that no query falls off an edge; that two cells may share a bucket is
// told apart by the photons' own cells, so that none is met twice.
#pragma once

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <span>
#include <vector>

#include "../core/huge_pages.hpp"
#include "../core/parallel.hpp"
#include "../core/prefetch.hpp"
#include "light_subpath.hpp"

namespace renderer {

/// What merging needs of a light vertex, polarised or not, but for its place. One cache line.
struct alignas(64) Photon {
  Vec3 incident, geometric_normal;  ///< no normal in a medium
  SubpathMis mis;
  std::uint32_t edges : 31, is_polarized : 1;
  Rgb intensity;
};

/// The light of a photon, as it left the vertex before: all of it, for families unknown here.
template <class R>
struct PhotonLight {
  explicit PhotonLight(const typename R::Light& l) : light(l) {}
  PhotonLight() = default;
  typename R::Light of(const Photon&) const { return light; }

  typename R::Light light;
};

/// What the photon doesn't hold. Light goes against `incident`, from which the frame's other axis
/// follows.
template <>
struct alignas(64) PhotonLight<malus::Polarized<Rgb>> {
  using Light = malus::Polarized<Rgb>::Light;

  PhotonLight() {}  // NOLINT: not defaulted, which would set all to zero
  explicit PhotonLight(const Light& l) : s1(l[1]), s2(l[2]), s3(l[3]), x(l.frame().x()) {}
  Light of(const Photon& photon) const {
    return {photon.intensity, s1, s2, s3,
            malus::Frame<float>::from_direction_and_x(-photon.incident, x)};
  }

  Rgb s1, s2, s3;
  Vec3 x;
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
    const bool any_is_polarized = find_buckets(paths, in_media);
    const std::size_t count = find_places();
    positions_.resize(count);
    photons_.resize(count);
    lights_.resize(any_is_polarized ? count : 0);
    store_all(paths);
  }

  /// Shows every photon nearer to a point than the radius, once, with its number.
  template <class Visit>
  void each_near(const Vec3& point, Visit&& visit) const {
    // A ball as wide as a cell reaches into the nearer neighbour in each dimension, no farther.
    const Vec3 place = lattice(point);
    const glm::ivec3 home(glm::floor(place));
    const glm::ivec3 low = home - glm::ivec3(glm::lessThan(place - Vec3(home), Vec3(0.5f)));
    const float radius2 = radius_ * radius_;
    // Everything lies at random in memory: all that is known to be read is asked for at once.
    std::uint32_t buckets[8], ends[8];
    for (int k = 0; k < 8; ++k) {
      buckets[k] = bucket(corner(low, k));
      prefetch(&starts_[buckets[k]]);
    }
    for (int k = 0; k < 8; ++k) {
      const std::uint32_t b = buckets[k];
      buckets[k] = starts_[b], ends[k] = starts_[b + 1];
      // What lies in order behind it comes by itself.
      prefetch(positions_.data() + buckets[k]);
    }
    Found found;
    for (int k = 0; k < 8; ++k) {
      const glm::ivec3 c = corner(low, k);
      for (std::uint32_t i = buckets[k]; i < ends[k]; ++i) {
        const Vec3 way = positions_[i] - point;
        if (!(glm::dot(way, way) < radius2) || cell(positions_[i]) != c) continue;
        prefetch(&photons_[i]);
        if (!lights_.empty()) prefetch(&lights_[i]);
        found.number[found.count++] = i;
        if (found.count == Found::most) show(found, visit);
      }
    }
    show(found, visit);
  }

  /// The light of a photon of that number.
  typename R::Light light(const Photon& photon, std::size_t i) const {
    if constexpr (R::polarized)
      if (photon.is_polarized) return lights_[i].of(photon);
    return R::unpolarized(photon.intensity);
  }

  float radius() const { return radius_; }
  /// Without or with what polarised light takes.
  static constexpr std::size_t bytes_per_photon(bool is_polarized) {
    return sizeof(Vec3) + sizeof(Photon) + (is_polarized ? sizeof(PhotonLight<R>) : 0);
  }
  std::size_t bytes() const {
    const auto of = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
    return of(places_) + of(starts_) + of(positions_) + of(photons_) + of(lights_);
  }

 private:
  /// Photons that are near, while their light is on its way from memory.
  struct Found {
    static constexpr int most = 32;
    std::uint32_t number[most];
    int count = 0;
  };
  template <class Visit>
  void show(Found& found, Visit&& visit) const {
    for (int i = 0; i < found.count; ++i) visit(photons_[found.number[i]], found.number[i]);
    found.count = 0;
  }

  /// Shows every vertex with its number, on all threads.
  template <class M, class Visit>
  void each_vertex(std::span<const LightPaths<R, M>> paths, const Visit& visit) const {
    constexpr std::size_t grain = 16;
    parallel_for(paths.size(), grain, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i != last; ++i) {
        std::size_t number = firsts_[i];
        for (const auto& v : paths[i].vertices) visit(v, number++);
      }
    });
  }

  /// The bucket of every vertex, in its place; whether light of any is polarised.
  template <class M>
  bool find_buckets(std::span<const LightPaths<R, M>> paths, bool in_media) {
    firsts_.assign(1, 0);
    for (const auto& p : paths) firsts_.push_back(firsts_.back() + p.vertices.size());
    places_.resize(firsts_.back());
    starts_.assign(std::bit_ceil(std::max<std::size_t>(places_.size(), 1024)) + 1, 0);
    mask_ = static_cast<std::uint32_t>(starts_.size() - 2);
    std::atomic<bool> any_is_polarized{false};
    each_vertex(paths, [&](const auto& v, std::size_t number) {
      places_[number] = nowhere;
      if (v.scatterer.is_medium() != in_media) return;
      places_[number] = bucket(cell(v.point.position));
      if constexpr (R::polarized)
        if (!R::is_unpolarized(v.light)) any_is_polarized.store(true, std::memory_order_relaxed);
    });
    return any_is_polarized;
  }

  /// The place of every photon by its bucket and, of one bucket, by its number; how many there are.
  /// By one thread, so that the places don't depend on how many there are.
  std::size_t find_places() {
    for (const std::uint32_t b : places_)
      if (b != nowhere) ++starts_[b + std::size_t(1)];
    for (std::size_t b = 1; b < starts_.size(); ++b) starts_[b] += starts_[b - 1];
    // This moves each bucket's start to its end, which is the next one's start.
    for (std::uint32_t& place : places_)
      if (place != nowhere) place = starts_[place]++;
    for (std::size_t b = starts_.size() - 1; b > 0; --b) starts_[b] = starts_[b - 1];
    starts_[0] = 0;
    return starts_.back();
  }

  /// Everything lies at random in memory: what is to be written next is asked for before.
  template <class M>
  void store_all(std::span<const LightPaths<R, M>> paths) {
    each_vertex(paths, [&](const auto& v, std::size_t number) {
      constexpr std::size_t ahead = 8;
      if (number + ahead < places_.size() && places_[number + ahead] != nowhere) {
        const std::uint32_t next = places_[number + ahead];
        prefetch_to_write(&positions_[next]);
        prefetch_to_write(&photons_[next]);
        if (!lights_.empty()) prefetch_to_write(&lights_[next]);
      }
      if (places_[number] != nowhere) store(v, places_[number]);
    });
  }

  template <class Vertex>
  void store(const Vertex& v, std::size_t i) {
    positions_[i] = v.point.position;
    Photon& photon = photons_[i];
    photon.incident = v.incident;
    photon.geometric_normal = v.point.geometric_normal;
    photon.mis = v.mis;
    photon.edges = static_cast<std::uint32_t>(v.edges) & 0x7fffffffu;
    photon.is_polarized = 0;
    photon.intensity = R::intensity(v.light);
    if constexpr (R::polarized)
      if (!R::is_unpolarized(v.light)) {
        photon.is_polarized = 1;
        std::construct_at(&lights_[i], v.light);
      }
  }

  static glm::ivec3 corner(const glm::ivec3& low, int k) {
    return low + glm::ivec3(k & 1, k >> 1 & 1, k >> 2);
  }
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
  static constexpr std::uint32_t nowhere = 0xffffffffu;  // of vertices that are no photons here
  std::vector<std::size_t> firsts_;  // of each list's vertices, the number of the first
  template <class T>
  using Array = std::pmr::vector<T>;
  Array<std::uint32_t> places_{&huge_pages()};   // of photons, by the numbers of their vertices
  Array<std::uint32_t> starts_{&huge_pages()};   // of each bucket's photons
  Array<Vec3> positions_{&huge_pages()};         // in the buckets' order
  Array<Photon> photons_{&huge_pages()};         // in the same
  Array<PhotonLight<R>> lights_{&huge_pages()};  // in the same, of polarised light alone
};

}  // namespace renderer
