// SPDX-License-Identifier: MIT
#include "tabulated_phase.hpp"

#include <bit>

namespace renderer {
namespace {

using Row = TabulatedPhase::Row;

constexpr double two_pi = 2 * std::numbers::pi;

/// The places of the angles whose cosines, in single precision, differ: the first, the last, and
/// those between.
std::vector<std::size_t> distinct(const std::vector<float>& cosines) {
  std::vector<std::size_t> kept{0};
  for (std::size_t i = 1; i + 1 < cosines.size(); ++i)
    if (cosines[i] < cosines[kept.back()] && cosines[i] > cosines.back()) kept.push_back(i);
  kept.push_back(cosines.size() - 1);
  return kept;
}

/// 2π ∫ a1 d cos Θ, of what is linear between the knots.
double integral(const std::vector<float>& cosines, const std::vector<double>& a1) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < a1.size(); ++i)
    sum += two_pi * (a1[i] + a1[i + 1]) / 2 *
           (static_cast<double>(cosines[i]) - static_cast<double>(cosines[i + 1]));
  return sum;
}

Rgb rgb(const std::array<double, 3>& v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

}  // namespace

TabulatedPhase::TabulatedPhase(std::span<const double> angles, std::span<const Row> rows) {
  std::vector<float> all(angles.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<float>(std::cos(angles[i]));
  all.front() = 1, all.back() = -1;
  const std::vector<std::size_t> kept = distinct(all);
  const std::size_t count = kept.size();
  std::vector<float> cosines(count);
  for (std::size_t i = 0; i < count; ++i) cosines[i] = all[kept[i]];

  std::vector<std::array<double, 3>> a1(count);
  std::array<double, 3> scale{};
  for (std::size_t k = 0; k < 3; ++k) {
    std::vector<double> values(count);
    for (std::size_t i = 0; i < count; ++i) values[i] = rows[kept[i]][k].a1;
    const double least = 1e-6 * integral(cosines, values) / (2 * two_pi);
    for (double& v : values) v = std::max(v, least);
    scale[k] = 1 / integral(cosines, values);
    for (std::size_t i = 0; i < count; ++i) a1[i][k] = values[i] * scale[k];
  }
  knots_.resize(count);
  others_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Row& row = rows[kept[i]];
    const auto normalized = [&](double malus::ScatteringElements<double>::*e) {
      return rgb({row[0].*e * scale[0], row[1].*e * scale[1], row[2].*e * scale[2]});
    };
    using Elements = malus::ScatteringElements<double>;
    others_[i] = {normalized(&Elements::a2), normalized(&Elements::a3), normalized(&Elements::a4),
                  normalized(&Elements::b1), normalized(&Elements::b2)};
    const float width = i + 1 < count ? cosines[i] - cosines[i + 1] : 1;
    const Rgb value = rgb(a1[i]);
    knots_[i] = {value, cosines[i], 1 / width, (value[0] + value[1] + value[2]) / 3};
  }
  find_cumulative();
  const std::size_t buckets = std::bit_ceil(3 * count);
  buckets_per_unit_ = static_cast<float>(buckets) / 2;
  guide_ = make_guide(buckets + 1, [&](std::size_t i) { return bucket(knots_[i].cosine); });
  sampling_buckets_ = static_cast<float>(buckets);
  sampling_guide_ = make_guide(buckets, [&](std::size_t i) {
    return static_cast<std::size_t>(cumulative_[i] * static_cast<double>(buckets));
  });
}

void TabulatedPhase::find_cumulative() {
  cumulative_.assign(knots_.size(), 0);
  for (std::size_t i = 0; i + 1 < knots_.size(); ++i) {
    const Knot &a = knots_[i], &b = knots_[i + 1];
    cumulative_[i + 1] =
        cumulative_[i] + (static_cast<double>(a.density) + static_cast<double>(b.density)) *
                             (static_cast<double>(a.cosine) - static_cast<double>(b.cosine));
  }
  for (double& c : cumulative_) c /= cumulative_.back();
}

template <class F>
TabulatedPhase::Guide TabulatedPhase::make_guide(std::size_t buckets, const F& bucket_of) const {
  // What is in a bucket is after all knots of buckets before, and not after those of buckets
  // beyond.
  Guide guide(buckets + 1);
  const std::size_t last = knots_.size() - 2;
  std::size_t i = 0;
  for (std::size_t b = 0; b <= buckets; ++b) {
    while (i < last && bucket_of(i + 1) < b) ++i;
    guide[b] = static_cast<std::uint32_t>(i);
  }
  return guide;
}

/// Within a cell of densities p and q at its ends, the part r of its chance is at t = r (p + q)/(p
/// + √(p² + r (q² − p²))) of its width: the quadratic's solution without cancellation.
float TabulatedPhase::sample(float u) const {
  const double x = static_cast<double>(u);
  const auto bucket = static_cast<std::size_t>(u * sampling_buckets_);
  const std::size_t i =
      last_cell(sampling_guide_, bucket, [&](std::size_t k) { return cumulative_[k] <= x; });
  const Knot &a = knots_[i], &b = knots_[i + 1];
  const auto r = static_cast<float>((x - cumulative_[i]) / (cumulative_[i + 1] - cumulative_[i]));
  const float p = a.density, q = b.density;
  const float root = std::sqrt((1 - r) * p * p + r * q * q);
  const float t = r * (p + q) / (p + root);
  return std::clamp(a.cosine - t * (a.cosine - b.cosine), b.cosine, a.cosine);
}

}  // namespace renderer
