// SPDX-License-Identifier: MIT
// The photon map against all photons one by one: none near is missed, none is shown twice, none far
// is shown, wherever the photons lie in the grid.
#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "core/warp.hpp"
#include "integrators/photon_map.hpp"

namespace {

using renderer::Sampler;
using renderer::Vec3;
using Light = malus::Unpolarized<renderer::Rgb>;
using Map = renderer::PhotonMap<Light>;
using Paths = renderer::LightPaths<Light, renderer::NoMedia>;

/// Photons of these places in paths of three vertices, and lists of ten paths; `edges` is a
/// photon's number.
Map map_of(const std::vector<Vec3>& places, const Vec3& center, float radius) {
  std::vector<Paths> lists(1);
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (lists.back().ends.size() == 10) lists.emplace_back();
    renderer::LightVertex<Light, renderer::NoMedia> v{};
    v.point.position = places[i];
    v.point.geometric_normal = v.incident = Vec3(0, 0, 1);
    v.edges = static_cast<int>(i);
    lists.back().vertices.push_back(v);
    if (i % 3 == 2 || i + 1 == places.size())
      lists.back().ends.push_back(lists.back().vertices.size());
  }
  Map map;
  map.build(std::span<const Paths>(lists), false, center, radius);
  return map;
}

/// Numbers of the photons near a point by the map, each as often as it is shown, in order.
std::vector<int> shown(const Map& map, const Vec3& point) {
  std::vector<int> found;
  map.each_near(point, [&](const auto& photon, std::size_t) {
    found.push_back(static_cast<int>(photon.edges));
  });
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<int> near(const std::vector<Vec3>& places, const Vec3& point, float radius) {
  std::vector<int> found;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Vec3 way = places[i] - point;
    if (glm::dot(way, way) < radius * radius) found.push_back(static_cast<int>(i));
  }
  return found;
}

struct Count {
  std::size_t near = 0;
  int wrong = 0;
};

Count compare(const std::vector<Vec3>& places, const std::vector<Vec3>& points, const Vec3& center,
              float radius) {
  const Map map = map_of(places, center, radius);
  Count count;
  for (const Vec3& point : points) {
    const auto expected = near(places, point, radius);
    count.near += expected.size();
    count.wrong += shown(map, point) != expected;
  }
  return count;
}

/// On the walls of a box, in it, and on its edges: the coordinates of walls are the same for all.
std::vector<Vec3> in_box(const Vec3& low, const Vec3& high, int count, std::uint64_t seed) {
  Sampler sampler(seed, 0, 0);
  std::vector<Vec3> places;
  for (int i = 0; i < count; ++i) {
    Vec3 u;
    for (int axis = 0; axis < 3; ++axis) {
      const float kind = sampler.next_1d(), at = sampler.next_1d();
      u[axis] = kind < 0.2f ? 0 : kind < 0.4f ? 1 : at;
    }
    places.push_back(low + u * (high - low));
  }
  return places;
}

}  // namespace

TEST_CASE("photon map: shows what is near, once, on walls and edges of a box as well as within") {
  struct Case {
    Vec3 low, high, center;
  };
  for (const Case& c :
       {Case{{-1.27029f, -1.25549f, -1.28002f},
             {1.28975f, 1.30455f, 1.28002f},
             {0.00973f, 0.02453f, 0}},
        Case{{-30, -30, -30}, {-20, -20, -20}, {-25, -25, -25}},
        Case{{0, 0, 0}, {1, 1, 0}, {0, 0, 0}}, Case{{-2, 0, 3}, {5, 0, 3}, {5, 0, 0}},
        Case{{7, 7, 7}, {7, 7, 7}, {0, 0, 0}}})
    for (const float part : {0.02f, 0.1f, 0.7f}) {
      const float radius = part * std::max(glm::length(c.high - c.low), 0.1f);
      CAPTURE(radius);
      CAPTURE(c.low.x);
      const auto places = in_box(c.low, c.high, 1500, 1);
      auto points = in_box(c.low, c.high, 300, 2);
      points.insert(points.end(), places.begin(), places.begin() + 100);
      points.push_back(c.high + Vec3(radius * 0.5f));
      points.push_back(c.low - Vec3(radius * 0.5f));
      points.push_back(c.high + Vec3(radius * 5));
      const Count count = compare(places, points, c.center, radius);
      CHECK(count.near > points.size());
      CHECK(count.wrong == 0);
    }
}

TEST_CASE("photon map: points on the lattice itself, and photons at its cells' borders") {
  std::vector<Vec3> places;
  for (int z = -4; z <= 4; ++z)
    for (int y = -4; y <= 4; ++y)
      for (int x = -4; x <= 4; ++x) places.push_back(0.25f * Vec3(x, y, z));
  for (const float radius : {0.125f, 0.25f, 0.26f, 0.5f, 0.6f}) {
    CAPTURE(radius);
    const Count count = compare(places, places, Vec3(0), radius);
    CHECK(count.near >= places.size());
    CHECK(count.wrong == 0);
  }
}

TEST_CASE("photon map: a small radius in a large scene, far from the middle") {
  for (const float extent : {30.0f, 3000.0f}) {
    CAPTURE(extent);
    const float radius = extent * 1e-5f;
    Sampler sampler(3, 0, 0);
    std::vector<Vec3> places, points;
    for (int i = 0; i < 300; ++i) {
      const Vec3 far = extent * renderer::square_to_sphere(sampler.next_2d());
      points.push_back(far);
      for (int k = 0; k < 20; ++k)
        places.push_back(far + 1.2f * radius * std::cbrt(sampler.next_1d()) *
                                   renderer::square_to_sphere(sampler.next_2d()));
    }
    const Count count = compare(places, points, Vec3(0), radius);
    CHECK(count.near > 5 * points.size());
    CHECK(count.wrong == 0);
  }
}

TEST_CASE("photon map: cells that share a bucket show their photons once") {
  // Few photons have few buckets, which about one in a hundred blocks of eight cells shares. Around
  // corners of cells there are photons in all eight.
  constexpr float radius = 0.5f;
  Sampler sampler(4, 0, 0);
  Count sum;
  for (int map = 0; map < 20; ++map) {
    std::vector<Vec3> places, points;
    for (int i = 0; i < 60; ++i) {
      const Vec3 u(sampler.next_1d(), sampler.next_1d(), sampler.next_1d());
      points.push_back(glm::floor(80.0f * u) - 40.0f);
      for (int k = 0; k < 16; ++k)
        places.push_back(points.back() +
                         0.9f * radius * renderer::square_to_sphere(sampler.next_2d()));
    }
    const Count count = compare(places, points, Vec3(0), radius);
    sum.near += count.near;
    sum.wrong += count.wrong;
  }
  CHECK(sum.near >= 20 * 60 * 16);
  CHECK(sum.wrong == 0);
}

TEST_CASE("photon map: empty, and of one photon") {
  CHECK(shown(map_of({}, Vec3(0), 1), Vec3(0)).empty());
  CHECK(shown(map_of({Vec3(1, 2, 3)}, Vec3(0), 1), Vec3(1, 2, 3.5f)) == std::vector<int>{0});
}

TEST_CASE("photon map: photons on surfaces and those in media have a map each") {
  using MixedPaths = renderer::LightPaths<Light, renderer::WithMedia>;
  const renderer::Medium medium{renderer::Medium::Description{}};
  const renderer::Bsdf bsdf{renderer::Diffuse{}};
  std::vector<MixedPaths> lists(1);
  for (int i = 0; i < 4; ++i) {
    renderer::LightVertex<Light, renderer::WithMedia> v{};
    v.scatterer = i % 2 == 0 ? renderer::Scatterer<renderer::WithMedia>(medium)
                             : renderer::Scatterer<renderer::WithMedia>(bsdf);
    v.edges = i;
    lists.back().vertices.push_back(v);
  }
  lists.back().ends.push_back(4);
  for (const bool in_media : {true, false}) {
    Map map;
    map.build(std::span<const MixedPaths>(lists), in_media, Vec3(0.0f), 0.1f);
    CHECK(shown(map, Vec3(0.0f)) == (in_media ? std::vector<int>{0, 2} : std::vector<int>{1, 3}));
  }
}

TEST_CASE("photon map: light comes back as it was stored, polarised or not, in its frame") {
  using Polarized = malus::Polarized<renderer::Rgb>;
  using renderer::Rgb;
  const auto map_of_light = [](int polarized_every) {
    std::vector<renderer::LightPaths<Polarized, renderer::NoMedia>> paths(1);
    Sampler sampler(5, 0, 0);
    for (int i = 0; i < 200; ++i) {
      renderer::LightVertex<Polarized, renderer::NoMedia> v{};
      v.point.position = Vec3(sampler.next_1d(), sampler.next_1d(), sampler.next_1d());
      v.incident = renderer::square_to_sphere(sampler.next_2d());
      v.edges = i;
      const auto number = static_cast<float>(i + 1);
      const auto frame = malus::Frame<float>::about(-v.incident).turned(number);
      v.light = i % polarized_every == polarized_every / 2
                    ? Polarized::Light(Rgb(number), Rgb(0.5f, 0.1f, 0.2f), Rgb(-0.25f * number),
                                       Rgb(0.125f, -0.5f, number), frame)
                    : Polarized::unpolarized(Rgb(number));
      paths[0].vertices.push_back(v);
    }
    paths[0].ends.push_back(paths[0].vertices.size());
    renderer::PhotonMap<Polarized> map;
    map.build(std::span<const renderer::LightPaths<Polarized, renderer::NoMedia>>(paths), false,
              Vec3(0.5f), 2);
    int seen = 0;
    map.each_near(Vec3(0.5f), [&](const renderer::Photon& photon, std::size_t i) {
      const auto& stored = paths[0].vertices[photon.edges].light;
      const auto light = map.light(photon, i);
      ++seen;
      CHECK(light.form() == stored.form());
      for (std::size_t k = 0; k < 4; ++k)
        CHECK(malus::max_channel(light[k]) == malus::max_channel(stored[k]));
      if (stored.form() != malus::StokesForm::full) return;
      CHECK(light.frame().x() == stored.frame().x());
      CHECK(glm::length(light.frame().y() - stored.frame().y()) < 1e-6f);
    });
    CHECK(seen == 200);
    return map.bytes();
  };
  const auto some_polarized = map_of_light(3), none_polarized = map_of_light(1000);
  CHECK(some_polarized - none_polarized == 200 * sizeof(renderer::PhotonLight<Polarized>));
}
