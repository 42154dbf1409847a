// SPDX-License-Identifier: MIT
// Where light paths begin and end: how lights emit, and how a sensor sees points.
#include <doctest/doctest.h>

#include "core/warp.hpp"
#include "picture_files.hpp"

using namespace render_test;
using renderer::EmissionSample;
using renderer::Hit;
using renderer::LightSample;
using renderer::Sampler;
using renderer::Scene;
using renderer::Sensor;
using renderer::Vec2;
using renderer::Vec3;

namespace {

const std::string eye = meter({0, 0, -9}, {0, 0, 0}, {1, 0, 0});

std::string lamp(const std::string& shape, const std::string& content, double radiance = 3) {
  return "<shape type=\"" + shape + "\">" + content + "<emitter type=\"area\">" +
         number("radiance", radiance) + "</emitter></shape>";
}
const std::string stretch =
    "<transform name=\"to_world\"><scale x=\"2\" y=\"0.5\" z=\"1.5\"/><rotate x=\"1\" y=\"2\" "
    "angle=\"40\"/><translate x=\"1\" y=\"2\" z=\"3\"/></transform>";
const std::string inside_out = "<boolean name=\"flip_normals\" value=\"true\"/>";
const std::string point = "<emitter type=\"point\"><point name=\"position\" value=\"1, 2, 3\"/>" +
                          number("intensity", 5) + "</emitter>";
const std::string sun =
    "<emitter type=\"directional\"><vector name=\"direction\" value=\"1, 2, -2\"/>" +
    number("irradiance", 2) + "</emitter>";

/// A mean, its standard error, and how far it may be off: 5 of them fail 6 in 10^7 seeds.
struct Mean {
  double sum = 0, squares = 0;
  int count = 0;
  void add(double value) {
    sum += value;
    squares += value * value;
    ++count;
  }
  double mean() const { return sum / count; }
  double error() const {
    return std::sqrt(std::max(0.0, squares / count - mean() * mean()) / count);
  }
  bool is(double expected) const {
    return std::abs(mean() - expected) < 5 * error() + 1e-5 * std::abs(expected);
  }
};

double area_of(const Scene& scene, const std::string& shape) {
  if (shape == "sphere") return 4 * pi * 0.25;
  const auto& mesh = scene.geometry.mesh(0);
  double area = 0;
  for (const auto& t : mesh.triangles)
    area += 0.5 * glm::length(glm::cross(
                      glm::dvec3(mesh.positions[t[1]]) - glm::dvec3(mesh.positions[t[0]]),
                      glm::dvec3(mesh.positions[t[2]]) - glm::dvec3(mesh.positions[t[0]])));
  return area;
}

/// The mean power of many paths' starts.
Mean power(const Scene& scene, int samples = 40000) {
  Sampler sampler(1, 2, 3);
  Mean mean;
  for (int i = 0; i < samples; ++i) {
    EmissionSample e;
    mean.add(scene.emit(sampler, false, e) ? static_cast<double>(e.power[0]) : 0.0);
  }
  return mean;
}

}  // namespace

TEST_CASE("light paths: all that a light emits is its power") {
  const std::string small = number("radius", 0.5) + "<point name=\"center\" value=\"1, 2, 3\"/>";
  for (const auto& [shape, content] : {std::pair<std::string, std::string>{"rectangle", stretch},
                                       {"cube", stretch},
                                       {"sphere", small},
                                       {"sphere", small + inside_out}}) {
    CAPTURE(shape);
    const Scene scene = build(eye + lamp(shape, content));
    CHECK(power(scene).is(pi * area_of(scene, shape) * 3));
  }
  CHECK(power(build(eye + square({0, 0, 0}, {0, 0, 1}, 1, "") + point)).is(4 * pi * 5));
  const Scene lit = build(eye + square({0, 0, 0}, {0, 0, 1}, 1, "") + sun);
  const auto disk = pi * std::pow(static_cast<double>(lit.geometry.radius()), 2);
  CHECK(power(lit).is(disk * 2));
  CHECK(power(build(eye + square({0, 0, 0}, {0, 0, 1}, 1, "") + sky)).is(disk * 4 * pi));
  CHECK(power(build(eye + square({0, 0, 0}, {0, 0, 1}, 1, "") + sky + sun + point))
            .is(disk * (4 * pi + 2) + 4 * pi * 5));
  const Folder folder;
  const std::string map = picture(folder, "sky.exr", 6, 5, [](int x, int y) {
    return glm::vec3(1.0f + static_cast<float>(x * y));
  });
  const Scene mapped = build(eye + square({0, 0, 0}, {0, 0, 1}, 1, "") +
                             "<emitter type=\"envmap\">" + file(map) + "</emitter>");
  Mean radiance;
  Sampler sampler(4, 5, 6);
  for (int i = 0; i < 40000; ++i) {
    const Vec3 d = renderer::square_to_sphere(sampler.next_2d());
    radiance.add(static_cast<double>(mapped.environment_radiance(d)[0]));
  }
  const Mean of_map = power(mapped);
  CHECK(std::abs(of_map.mean() - 4 * pi * disk * radiance.mean()) <
        5 * std::hypot(of_map.error(), 4 * pi * disk * radiance.error()));
}

TEST_CASE("light paths: what starts at a light's surface starts from all of it, by Lambert's law") {
  const Scene scene = build(eye + lamp("rectangle", stretch));
  Sampler sampler(1, 1, 1);
  Mean cosine, cosine2, x, x2;
  const Vec3 middle(1, 2, 3);
  for (int i = 0; i < 40000; ++i) {
    EmissionSample e;
    REQUIRE(scene.emit(sampler, false, e));
    const auto c = static_cast<double>(glm::dot(e.direction, e.normal));
    cosine.add(c);
    cosine2.add(c * c);
    const auto d = static_cast<double>(glm::length(e.position - middle));
    x.add(static_cast<double>(e.position.x - middle.x));
    x2.add(d * d);
  }
  CHECK(cosine.is(2.0 / 3));
  CHECK(cosine2.is(0.5));
  CHECK(x.is(0));
  CHECK(x2.is((4 + 0.25) / 3));
}

TEST_CASE(
    "light paths: directions and places of light from infinity fill the scene's disk evenly") {
  for (const std::string& light : {sky, sun}) {
    const Scene scene = build(eye + square({3, 0, 1}, {0, 0, 1}, 1, "") + light);
    const float radius = scene.geometry.radius();
    Sampler sampler(1, 1, 1);
    Mean offset2, along;
    glm::dvec3 mean_direction(0);
    for (int i = 0; i < 40000; ++i) {
      EmissionSample e;
      REQUIRE(scene.emit(sampler, false, e));
      const Vec3 way = e.position - scene.geometry.center();
      const float before = glm::dot(way, e.direction);
      along.add(static_cast<double>(before / radius));
      const Vec3 across = way - before * e.direction;
      offset2.add(static_cast<double>(glm::dot(across, across) / (radius * radius)));
      mean_direction += glm::dvec3(e.direction) / 40000.0;
    }
    CHECK(along.mean() <= -0.999);
    CHECK(offset2.is(0.5));
    if (light == sky) CHECK(glm::length(mean_direction) < 0.02);
  }
}

TEST_CASE("light paths: the densities of starting along a ray and of being connected along it") {
  const std::string ball = number("radius", 0.5) + "<point name=\"center\" value=\"1, 2, 3\"/>";
  const std::string inside = "<sphere/>";
  for (const auto& light :
       {lamp("rectangle", stretch), lamp("cube", stretch), lamp("sphere", ball),
        lamp("sphere", ball + inside_out), lamp("sphere", ball) + point + sky}) {
    CAPTURE(light);
    const Scene scene = build(eye + light);
    Sampler sampler(7, 7, 7);
    int checked = 0;
    for (int i = 0; i < 2000; ++i) {
      EmissionSample e;
      if (!scene.emit(sampler, false, e) || e.normal == Vec3(0.0f)) continue;
      // A point that the path may reach, and the light's point as seen from there.
      const bool from_within = scene.geometry.is_sphere(0) && scene.geometry.sphere(0).flipped;
      const Vec3 to = e.position + (from_within ? 0.3f : 2.0f) * e.direction;
      Hit hit;
      const float cosine = glm::dot(e.normal, e.direction);
      if (cosine < 0.05f || !scene.intersect({to, -e.direction}, hit) ||
          glm::length(hit.position - e.position) > 1e-3f)
        continue;
      ++checked;
      const float emission = scene.emission_pdf(hit, e.direction);
      CHECK(e.cosine_over_pdf == doctest::Approx(cosine / emission).epsilon(2e-3));
      CHECK(e.power[0] ==
            doctest::Approx(scene.emitted(hit, e.direction)[0] * e.cosine_over_pdf).epsilon(1e-4));
      // Étendue is conserved: the density by area across the ray and by solid angle is the same at
      // its two ends.
      const float expected = emission / cosine / scene.light_pdf(to, hit);
      CHECK(scene.emission_ratio(e, to) == doctest::Approx(expected).epsilon(4e-3));
    }
    CHECK(checked > 200);

    // The ratio that next-event estimation is told.
    int connected = 0;
    for (int i = 0; i < 2000; ++i) {
      LightSample sample;
      const Vec3 from(1.2f, 2.1f, 2.9f + static_cast<float>(i % 7));
      Hit hit;
      if (!scene.sample_light(from, sampler, sample) || sample.is_delta) continue;
      if (sample.is_at_infinity) {
        CHECK(sample.emission_ratio ==
              doctest::Approx(scene.environment_emission_pdf(sample.direction) / sample.pdf)
                  .epsilon(1e-4));
        continue;
      }
      if (!scene.intersect({from, sample.direction}, hit) ||
          glm::length(hit.position - sample.position) > 1e-3f)
        continue;
      const float cosine = -glm::dot(hit.geometric_normal, sample.direction);
      if (cosine < 0.05f) continue;
      ++connected;
      CHECK(sample.emission_ratio ==
            doctest::Approx(scene.emission_pdf(hit, -sample.direction) / cosine / sample.pdf)
                .epsilon(4e-3));
    }
    CHECK(connected > 100);
  }
}

TEST_CASE("light paths: the sensor sees a point where the ray to it starts") {
  for (const std::string& turn :
       {look({1, 2, 3}, {0, 0.5, -2}, {0, 1, 0.3}),
        std::string("<scale x=\"2\" y=\"1.5\" z=\"0.7\"/><rotate x=\"1\" y=\"0.3\" "
                    "angle=\"50\"/><translate x=\"1\" z=\"-2\"/>"),
        "<scale x=\"-1\"/>" + look({0, -5, 1}, {0, 0, 0}, {0, 0, 1})}) {
    CAPTURE(turn);
    const Scene scene =
        build("<sensor type=\"perspective\"><float name=\"fov\" value=\"70\"/>" +
              number("near_clip", 0.5) + number("far_clip", 20) +
              number("principal_point_offset_x", 0.2) + number("principal_point_offset_y", -0.3) +
              "<transform name=\"to_world\">" + turn +
              "</transform><film type=\"hdrfilm\"><integer name=\"width\" value=\"48\"/>"
              "<integer name=\"height\" value=\"32\"/></film></sensor>" +
              point + square({0, 0, 0}, {0, 0, 1}, 1, ""));
    const Sensor& sensor = *scene.sensor;
    Sampler sampler(1, 2, 3);
    for (int i = 0; i < 500; ++i) {
      const Vec2 film = sampler.next_2d();
      const auto ray = sensor.ray(film);
      const float distance = ray.length * sampler.next_1d();
      const Vec3 seen = ray.origin + distance * ray.direction;
      Sensor::Projection p{};
      REQUIRE(sensor.project(seen, p));
      CHECK(glm::length(p.film - film) < 2e-5f);
      CHECK(glm::length(p.direction - ray.direction) < 1e-5f);
      CHECK(p.near + distance == doctest::Approx(p.distance).epsilon(1e-5));
      CHECK(p.far - p.near == doctest::Approx(ray.length).epsilon(1e-5));
      CHECK_FALSE(sensor.project(2.0f * sensor.origin() - seen, p));
    }
    // Rays are spread evenly over the film: so many in the solid angle of a part of it.
    constexpr int parts = 40;
    double sum = 0;
    for (int y = 0; y < parts; ++y)
      for (int x = 0; x < parts; ++x) {
        const auto corner = [&](float i, float j) {
          return glm::dvec3(sensor
                                .ray(Vec2(static_cast<float>(x) + i, static_cast<float>(y) + j) /
                                     static_cast<float>(parts))
                                .direction);
        };
        const double angle =
            glm::length(glm::cross(corner(1, 1) - corner(0, 0), corner(1, 0) - corner(0, 1))) / 2;
        const double rays =
            angle * static_cast<double>(sensor.pdf(Vec3(corner(0.5f, 0.5f)), parts * parts));
        CHECK(rays == doctest::Approx(1).epsilon(3e-3));
        sum += rays / (parts * parts);
      }
    CHECK(sum == doctest::Approx(1).epsilon(1e-3));
  }
  const Scene single = build(eye + point);
  Sensor::Projection p{};
  CHECK_FALSE(single.sensor->project({0, 0, 3}, p));
}
