// SPDX-License-Identifier: MIT
// Whether two pictures estimate the same light: all four Stokes components of all three channels,
// with a stated chance to call equal ones different.
//
// A picture is rendered in batches of samples, independent of each other. Cells of pixels are
// compared by Welch's test of the batches' means, at three levels: small cells, which tell where
// something is wrong, large ones, and the picture as a whole, which has the power to see a small
// error everywhere. A third of the error rate is each level's, shared by Bonferroni among its
// comparisons. Batches of a whole cell are sums of so many samples that Student's t holds for them.
//
// The two pictures need different seeds: camera paths of equal seeds share random numbers among
// integrators, and are not independent.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "render_scenes.hpp"

namespace agreement {

/// The chance that two pictures of equal expectation are called different.
constexpr double family_wise_error = 1e-5;

/// The chance of a Student's t of so many degrees of freedom, or one farther from 0 (Abramowitz &
/// Stegun 1964, equations 26.7.3 and 26.7.4).
inline double student_tail(double t, int freedom) {
  const double angle = std::atan(std::abs(t) / std::sqrt(static_cast<double>(freedom)));
  const double cosine = std::cos(angle), sine = std::sin(angle);
  const bool odd = freedom % 2 == 1;
  double term = odd ? cosine : 1, sum = freedom == 1 ? 0 : term;
  for (int k = odd ? 3 : 2; k <= freedom - 2; k += 2) {
    term *= cosine * cosine * (k - 1) / k;
    sum += term;
  }
  const double inside = odd ? (angle + sine * sum) * 2 / render_test::pi : sine * sum;
  return std::max(1 - inside, 1e-16);
}

/// The means of every pixel's 12 Stokes components, S0.R to S3.B, batch by batch.
class Picture {
 public:
  explicit Picture(render_test::Rendering rendering)
      : width_(rendering.film.width()),
        height_(rendering.film.height()),
        batches_(rendering.film.batches()),
        used_(pixels(), true) {
    for (std::size_t p = 0; p < pixels(); ++p)
      for (std::size_t i = 0; i < 12; ++i)
        for (std::size_t b = 0; b < batches_; ++b)
          values_.push_back(rendering.film.at(p, b).mean(i));
  }

  int width() const { return width_; }
  int height() const { return height_; }
  std::size_t batches() const { return batches_; }
  std::size_t pixels() const {
    return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  }

  /// Leaves pixels out of all comparisons.
  void use(const std::vector<bool>& pixels) { used_ = pixels; }
  /// A planted error: a factor for every channel of one component.
  void scale(std::size_t component, double factor) {
    for (std::size_t k = 0; k < values_.size(); ++k)
      if (k / batches_ % 12 / 3 == component) values_[k] *= factor;
  }
  /// Batch by batch: of equal seeds, what the one has and the other hasn't.
  Picture& operator-=(const Picture& b) { return add(b, -1); }
  Picture& add(const Picture& b, double factor) {
    REQUIRE(values_.size() == b.values_.size());
    for (std::size_t k = 0; k < values_.size(); ++k) values_[k] += factor * b.values_[k];
    return *this;
  }

  /// The batches' means of one component of a cell, a square of pixels; none if all are left out.
  std::vector<double> cell(int x0, int y0, int side, std::size_t i) const {
    std::vector<double> sums(batches_);
    int count = 0;
    for (int y = y0; y < std::min(y0 + side, height_); ++y)
      for (int x = x0; x < std::min(x0 + side, width_); ++x) {
        const auto p = static_cast<std::size_t>(y * width_ + x);
        if (!used_[p]) continue;
        ++count;
        for (std::size_t b = 0; b < batches_; ++b) sums[b] += values_[(p * 12 + i) * batches_ + b];
      }
    if (count == 0) return {};
    for (double& s : sums) s /= count;
    return sums;
  }

 private:
  int width_, height_;
  std::size_t batches_;
  std::vector<bool> used_;
  std::vector<double> values_;  // by pixel, component and batch
};

/// A mean and the variance of it.
struct Estimate {
  double mean = 0, variance = 0;
  explicit Estimate(std::span<const double> batches) {
    const auto n = static_cast<double>(batches.size());
    for (const double b : batches) mean += b / n;
    for (const double b : batches) variance += (b - mean) * (b - mean) / (n * (n - 1));
  }
};

/// How likely a difference as large as the worst is between pictures that agree, and where it is.
struct Verdict {
  double p = 1;
  std::string worst = "nothing differs";
  bool agrees() const { return p > family_wise_error; }
};

/// One comparison. `bias` is what is tolerated besides noise; `brightness` scales rounding errors.
inline double deviation_chance(const Estimate& a, const Estimate& b, std::size_t batches,
                               double bias, double brightness) {
  constexpr double rounding = 3e-5;
  const double difference = std::max(0.0, std::abs(a.mean - b.mean) - bias);
  if (difference <= rounding * brightness) return 1;
  const double variance = a.variance + b.variance;
  if (!(variance > 0)) return 1e-16;
  // Welch and Satterthwaite's degrees of freedom.
  const double n = static_cast<double>(batches - 1);
  const double freedom =
      variance * variance * n / (a.variance * a.variance + b.variance * b.variance);
  return student_tail(difference / std::sqrt(variance), static_cast<int>(freedom));
}

/// What may differ, and how finely the pictures are compared.
struct Tolerance {
  double bias = 0;  ///< part of a cell's S0, in all components, that is not noise
  int cells = 8;  ///< across the picture, at the finest level: many samples in each must see light
};

inline Verdict compare(const Picture& a, const Picture& b, const Tolerance& tolerance = {}) {
  REQUIRE(a.pixels() == b.pixels());
  REQUIRE(a.batches() == b.batches());
  const int extent = std::max(a.width(), a.height());
  Verdict verdict;
  for (const int cells : {tolerance.cells, 3, 1}) {
    const int side = (extent + cells - 1) / cells;
    double least = 1;
    int comparisons = 0;
    std::string where;
    for (int y = 0; y < a.height(); y += side)
      for (int x = 0; x < a.width(); x += side)
        for (std::size_t i = 0; i < 12; ++i) {
          const auto in_a = a.cell(x, y, side, i), in_b = b.cell(x, y, side, i);
          if (in_a.empty() || in_b.empty()) continue;
          const Estimate of_a(in_a), of_b(in_b);
          const double s0 = Estimate(a.cell(x, y, side, i % 3)).mean;
          const double p = deviation_chance(of_a, of_b, a.batches(), tolerance.bias * s0, s0);
          ++comparisons;
          if (!(p >= least)) {
            least = p;
            std::ostringstream text;
            text << "S" << i / 3 << "."
                 << "RGB"[i % 3] << " of " << side << " x " << side << " pixels at " << x << ", "
                 << y << ": " << of_a.mean << " +- " << std::sqrt(of_a.variance) << " and "
                 << of_b.mean << " +- " << std::sqrt(of_b.variance) << ", S0 " << s0;
            where = text.str();
          }
        }
    REQUIRE(comparisons > 0);
    const double p = std::min(1.0, 3 * comparisons * least);
    if (!(p >= verdict.p)) verdict = {p, where};
  }
  return verdict;
}

constexpr std::size_t batches = 32;

inline render_test::Rendering render(const renderer::Scene& scene, std::uint64_t samples,
                                     std::uint64_t seed,
                                     render_test::Mode mode = render_test::Mode::optimized,
                                     int threads = 2) {
  const std::atomic<bool> stop{false};
  renderer::RenderOptions options;
  options.mode = mode;
  options.samples_per_pixel = samples;
  options.seed = seed;
  options.threads = threads;
  options.batches = batches;
  auto rendering = renderer::render(scene, options, stop, {});
  CAPTURE(scene.integrator.name);
  CHECK(rendering.counters.non_finite == 0);
  CHECK(rendering.counters.unphysical == 0);
  return rendering;
}

/// A picture by an integrator; `samples` is a multiple of the batches.
inline Picture picture(renderer::Scene& scene, const std::string& integrator, std::uint64_t samples,
                       std::uint64_t seed, render_test::Mode mode = render_test::Mode::optimized) {
  REQUIRE(samples % batches == 0);
  scene.integrator.name = integrator;
  return Picture(render(scene, samples, seed, mode));
}

}  // namespace agreement

#define CHECK_AGREE_BUT_FOR(a, b, tolerance)                         \
  do {                                                               \
    const auto verdict_ = agreement::compare((a), (b), (tolerance)); \
    INFO("chance ", verdict_.p, ": ", verdict_.worst);               \
    CHECK(verdict_.agrees());                                        \
  } while (false)
#define CHECK_AGREE(a, b) CHECK_AGREE_BUT_FOR(a, b, agreement::Tolerance{})
#define CHECK_DIFFER(a, b)                              \
  do {                                                  \
    const auto verdict_ = agreement::compare((a), (b)); \
    INFO("chance ", verdict_.p, ": ", verdict_.worst);  \
    CHECK_FALSE(verdict_.agrees());                     \
  } while (false)
