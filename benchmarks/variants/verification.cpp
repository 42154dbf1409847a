// SPDX-License-Identifier: MIT
#include "verification.hpp"

#include <algorithm>
#include <cmath>

namespace variants {

namespace {

renderer::Film render(const renderer::Scene& scene, Variant variant) {
  renderer::Film film(scene.film.crop_width, scene.film.crop_height, 1);
  make_passes(variant, scene, {.seed = 1}, film)->run(0, 1, [] { return false; });
  return film;
}

}  // namespace

Difference compare(const renderer::Scene& scene, Variant a, Variant b) {
  const renderer::Film film_a = render(scene, a), film_b = render(scene, b);
  const auto pixels =
      static_cast<std::size_t>(film_a.width()) * static_cast<std::size_t>(film_a.height());
  // Behind crossed polarizers there is rounding alone: it is small beside the rest of the picture.
  double mean = 0;
  for (std::size_t pixel = 0; pixel < pixels; ++pixel)
    for (std::size_t channel = 0; channel < 3; ++channel)
      mean += std::abs(film_a.total(pixel).stokes[channel]) / (3 * static_cast<double>(pixels));

  Difference result;
  std::vector<double> differences;
  for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
    const auto p = film_a.total(pixel).stokes, q = film_b.total(pixel).stokes;
    result.is_equal = result.is_equal && p == q;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const double s0 = std::max(std::abs(p[channel]), std::abs(q[channel]));
      double largest = 0;
      for (std::size_t i = channel; i < p.size(); i += 3)
        largest = std::max(largest, std::abs(p[i] - q[i]) / std::max(s0, mean / 100));
      differences.push_back(largest);
    }
  }
  std::sort(differences.begin(), differences.end());
  const auto above =
      differences.end() - std::upper_bound(differences.begin(), differences.end(), bound);
  result.median = differences[differences.size() / 2];
  result.largest = differences.back();
  result.share = static_cast<double>(above) / static_cast<double>(differences.size());
  return result;
}

double allowed_share(const renderer::Scene& scene) {
  return scene.draws_by_polarization ? 1e-3 : 0;
}

}  // namespace variants
