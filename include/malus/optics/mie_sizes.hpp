// SPDX-License-Identifier: MIT
// Scattering by spheres of many sizes (optics/mie.hpp), log-normally distributed by number: the
// logarithms of their sizes are, normally, about that of the median, with a standard deviation of
// ln σ_g. Each counts by its scattering cross-section.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <span>
#include <vector>

#include <malus/optics/mie.hpp>

namespace malus {

/// Size parameters x = 2πr/λ.
struct MieSizes {
  double median = 1;
  double geometric_deviation = 1;  ///< σ_g ≥ 1; 1 is one size

  /// So narrow that no step would change ln x.
  bool are_one() const { return !(geometric_deviation > 1 + 1e-6); }
};

/// How finely a distribution is integrated. The defaults are good to 1e-6 of each element where x
/// is below some 20. Larger transparent spheres have resonances that are narrower than any step:
/// cross- sections are then good to 1e-4, and elements at single angles, backward above all, to
/// percents.
struct MieQuadrature {
  double range = 6;                 ///< how far out, in standard deviations
  double largest_step = 0.1;        ///< between sizes, where the distribution is wider
  std::size_t most_spheres = 1000;  ///< wide distributions take larger steps to stay below
};

/// The mean over a distribution. Cross-sections are those of one sphere, in units of π/k²: Q x²,
/// which are πr² Q where the wave number k is 1.
struct MieMean {
  double extinction = 0, scattering = 0;
  double asymmetry = 0;
  /// One an angle; the mean of a1 over the sphere is 1.
  std::vector<ScatteringElements<double>> elements;
};

namespace detail {

struct MieNode {
  double size, weight;
};

/// Where a distribution's integrands have fallen to exp(−range²/2) of their largest value. What is
/// absorbed by small spheres grows as x³, forward scattering as x⁶ and, of large ones, x⁴: bounds
/// below and above everything in between.
class MieRange {
 public:
  MieRange(double mean, double deviation, double range)
      : mean_(mean), deviation_(deviation), drop_(range * range / 2) {}

  double lowest() const {
    return edge(-1, [](double t) { return 2 * t + std::min(t, 0.0); });
  }
  double highest() const {
    return edge(1, [](double t) { return 4 * t + 2 * std::min(t, 0.0); });
  }

 private:
  /// The logarithm of density × `growth` is concave: from its maximum on it only falls.
  template <class F>
  double edge(double sign, const F& growth) const {
    const auto height = [&](double t) {
      const double z = (t - mean_) / deviation_;
      return growth(t) - z * z / 2;
    };
    const double step = deviation_ / 8;
    double t = mean_;
    while (height(t + step) > height(t)) t += step;
    const double least = height(t) - drop_;
    while (height(t) > least) t += sign * step;
    return t;
  }

  double mean_, deviation_, drop_;
};

/// The trapezoidal rule in w = t/h + eᵗ/δ of t = ln x, which steps by h where spheres are small and
/// by x = δ where they are large. Integrands are smooth and vanish at both ends, for which that
/// rule is the best.
inline std::vector<MieNode> mie_nodes(const MieSizes& sizes, const MieQuadrature& quadrature) {
  if (sizes.are_one()) return {{sizes.median, 1}};
  const double mean = std::log(sizes.median), deviation = std::log(sizes.geometric_deviation);
  const MieRange range(mean, deviation, quadrature.range);
  const double low = range.lowest(), high = range.highest(), h = deviation / 3;
  const double large = std::exp(high) - std::exp(low), small = (high - low) / h;
  const double left = std::max(static_cast<double>(quadrature.most_spheres) - small, 8.0);
  const double delta = std::max(quadrature.largest_step, large / left);
  const auto w = [&](double t) { return t / h + std::exp(t) / delta; };
  const auto count = static_cast<std::size_t>(std::ceil(w(high) - w(low)));
  const double step = (w(high) - w(low)) / static_cast<double>(count);
  std::vector<MieNode> nodes(count + 1);
  double t = low;
  for (std::size_t i = 0; i <= count; ++i) {
    const double target = w(low) + step * static_cast<double>(i);
    // Newton's method: w is convex, and the node before is near.
    for (int k = 0; k < 8; ++k) t -= (w(t) - target) / (1 / h + std::exp(t) / delta);
    const double z = (t - mean) / deviation, x = std::exp(t);
    const double density =
        std::exp(-z * z / 2) * std::numbers::inv_sqrtpi / (deviation * std::numbers::sqrt2);
    nodes[i] = {x, density * step / (1 / h + x / delta)};
  }
  return nodes;
}

}  // namespace detail

/// The largest size that is integrated over: what the time goes by.
inline double largest_size(const MieSizes& sizes, const MieQuadrature& quadrature = {}) {
  if (sizes.are_one()) return sizes.median;
  return std::exp(detail::MieRange(std::log(sizes.median), std::log(sizes.geometric_deviation),
                                   quadrature.range)
                      .highest());
}

/// The mean over a distribution of sizes, of spheres of one relative index n + ik, at the angles of
/// these cosines (none: cross-sections alone).
inline MieMean mie_mean(const MieSizes& sizes, std::complex<double> index,
                        std::span<const double> cosines, const MieQuadrature& quadrature = {}) {
  MieMean mean;
  mean.elements.assign(cosines.size(), ScatteringElements<double>{});
  for (const auto& [size, weight] : detail::mie_nodes(sizes, quadrature)) {
    const MieSphere sphere(size, index);
    const double area = weight * size * size;
    mean.extinction += area * sphere.extinction();
    mean.scattering += area * sphere.scattering();
    mean.asymmetry += area * sphere.scattering() * sphere.asymmetry();
    sphere.add_elements(cosines, weight, mean.elements);
  }
  if (!(mean.scattering > 0)) return mean;
  mean.asymmetry /= mean.scattering;
  for (auto& e : mean.elements) e = e * (4 / mean.scattering);
  return mean;
}

}  // namespace malus
