// SPDX-License-Identifier: MIT
// The row that a camera path carries through polarising media, by which directions are drawn: no
// picture would tell were it another, but for its noise.
#include <doctest/doctest.h>

#include <malus/row_sweep.hpp>

#include "core/warp.hpp"
#include "integrators/carried_row.hpp"
#include "medium_scenes.hpp"

namespace {

using namespace renderer;
using namespace render_test;
using Family = malus::Polarized<Rgb>;

Scene scene_of_air() {
  return build(integrator(5) + camera + sky +
               sphere(medium(rgb("sigma_s", "1, 0.5, 0.25") + number("sigma_a", 0) +
                             phase("rayleigh", number("depolarization", 0.03)))));
}

PolarizedBsdfSample drawn(const Vec3& direction) {
  PolarizedBsdfSample sample;
  sample.direction = direction;
  sample.pdf = 0.08f;
  sample.weight = Rgb(0.9f, 0.8f, 0.7f);
  return sample;
}

void check_same(const LinearPolarization& a, const LinearPolarization& b, const Vec3& across) {
  CHECK(a.is_none == b.is_none);
  if (a.is_none || b.is_none) return;
  CHECK(static_cast<double>(a.along(across)) ==
        doctest::Approx(static_cast<double>(b.along(across))).epsilon(1e-4));
}

}  // namespace

TEST_CASE(
    "carried row: through a medium it is what the sweep's row is, behind a surface a new one") {
  const Scene scene = scene_of_air();
  const Scatterer<WithMedia> air(scene.media.front());
  const Bsdf wall(Diffuse{});
  const Scatterer<WithMedia> on_wall(wall);
  CHECK(air.polarizes());

  Sampler sampler(7, 0, 0);
  CarriedRow row;
  malus::RowSweep<Rgb> sweep;
  SurfacePoint point = point_in_medium(Vec3(0.1f, 0.2f, 0.3f));
  for (int path = 0; path < 50; ++path) {
    CAPTURE(path);
    row.begin();
    sweep.begin();
    Vec3 exitant = square_to_sphere(sampler.next_2d());
    CHECK(row.polarization().is_none);
    for (int k = 0; k < 5; ++k) {
      const auto sample = drawn(square_to_sphere(sampler.next_2d()));
      row.scatter(point, exitant, air, sample, 0.7f);
      air.with_weight<Family>(point, exitant, Tracing::from_camera, sample, 0.7f,
                              [&](const auto& f) { sweep.scatter(as_matrix(f)); });
      row.attenuate(Rgb(0.9f, 0.5f, 0.7f));
      sweep.attenuate(Rgb(0.9f, 0.5f, 0.7f));
      exitant = -sample.direction;
      check_near(row.throughput(), sweep.throughput());
      const Vec3 across = Basis(exitant).s;
      check_same(row.polarization(), LinearPolarization(sweep.row()), across);
      CHECK_FALSE(row.polarization().is_none);
    }
    const Rgb before = row.throughput();
    const auto sample = drawn(square_to_sphere(sampler.next_2d()));
    row.scatter(point, exitant, on_wall, sample, 0.5f);
    check_near(row.throughput(), before * sample.weight * 0.5f);
    CHECK(row.polarization().is_none);
  }
}
