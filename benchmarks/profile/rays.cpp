// SPDX-License-Identifier: MIT
#include "rays.hpp"

#include <vector>

#include "recording.hpp"

namespace profile {

namespace {

double seconds_of(const std::vector<RecordedRay>& rays) {
  const double start = processor_seconds();
  for (const RecordedRay& r : rays) trace(r.scene, r.ray, r.is_shadow);
  return processor_seconds() - start;
}

}  // namespace

RayTimes time_rays(const renderer::Scene& scene, renderer::Mode mode, double seconds) {
  renderer::RenderOptions options;
  options.mode = mode;
  options.seed = 1;
  renderer::Film film(scene.film.crop_width, scene.film.crop_height, 1);
  const auto passes = renderer::make_passes(scene, options, film);
  const auto [all, paths] = record(*passes);
  std::vector<RecordedRay> nearest, shadow;
  for (const RecordedRay& r : all) (r.is_shadow ? shadow : nearest).push_back(r);

  std::vector<double> of_paths, of_all, of_nearest, of_shadow;
  const double start = processor_seconds();
  while (of_paths.size() < variants::least_pairs || processor_seconds() - start < seconds) {
    const double begin = processor_seconds();
    passes->run(0, 1, [] { return false; });
    of_paths.push_back(processor_seconds() - begin);
    of_all.push_back(seconds_of(all));
    of_nearest.push_back(seconds_of(nearest));
    of_shadow.push_back(seconds_of(shadow));
  }
  RayTimes times;
  times.mode = mode == renderer::Mode::optimized ? "optimized" : "unpolarized";
  times.nearest_per_path = static_cast<double>(nearest.size()) / static_cast<double>(paths);
  times.shadow_per_path = static_cast<double>(shadow.size()) / static_cast<double>(paths);
  times.path = nanoseconds_of_each(of_paths, paths);
  times.nearest = nanoseconds_of_each(of_nearest, nearest.size());
  times.shadow = nanoseconds_of_each(of_shadow, shadow.size());
  times.share = variants::ratio_of(of_all, of_paths);
  return times;
}

}  // namespace profile
