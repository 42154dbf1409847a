// SPDX-License-Identifier: MIT
#include "errors.hpp"

#include <algorithm>
#include <cmath>

namespace convergence {

namespace {

constexpr double floor_part = 0.1;

struct Moments {
  std::vector<double> mean, variance;  // the latter of the mean
};

Moments moments(const std::vector<Picture>& batches) {
  const std::size_t n = batches[0].data.size();
  const auto k = static_cast<double>(batches.size());
  Moments m{std::vector<double>(n), std::vector<double>(n)};
  for (const Picture& p : batches)
    for (std::size_t i = 0; i < n; ++i) m.mean[i] += static_cast<double>(p.data[i]) / k;
  for (const Picture& p : batches)
    for (std::size_t i = 0; i < n; ++i) {
      const double d = static_cast<double>(p.data[i]) - m.mean[i];
      m.variance[i] += d * d / (k - 1) / k;
    }
  return m;
}

double sum(const std::vector<double>& values) {
  double total = 0;
  for (const double v : values) total += v;
  return total;
}

/// The mean of a plane's three channels.
double grey(const auto& data, std::size_t pixels, std::size_t component, std::size_t pixel) {
  double total = 0;
  for (std::size_t c = 0; c < 3; ++c)
    total += static_cast<double>(data[(3 * component + c) * pixels + pixel]);
  return total / 3;
}

/// A degree of polarisation; that of no light is 0.
double degree_of(double s0, double s1, double s2, double s3) {
  return s0 > 0 ? std::min(1.0, std::sqrt(s1 * s1 + s2 * s2 + s3 * s3) / s0) : 0;
}

/// Adds S1 to S3 up.
void complete(PerQuantity& q) { q[polarization] = q[1] + q[2] + q[3]; }

/// The variance of the mean of `per_batch`, added to what there is.
void add_variance(const std::vector<PerQuantity>& per_batch, PerQuantity& variance) {
  const auto k = static_cast<double>(per_batch.size());
  PerQuantity mean{};
  for (const auto& batch : per_batch)
    for (std::size_t q = 0; q < quantities; ++q) mean[q] += batch[q] / k;
  for (const auto& batch : per_batch)
    for (std::size_t q = 0; q < quantities; ++q)
      variance[q] += (batch[q] - mean[q]) * (batch[q] - mean[q]) / (k - 1) / k;
}

}  // namespace

void Errors::add(const Errors& e, double weight) {
  for (std::size_t q = 0; q < quantities; ++q) {
    square[q] += weight * e.square[q];
    relative_square[q] += weight * e.relative_square[q];
    uncertainty[q] += weight * e.uncertainty[q];
  }
  dop_bias += weight * e.dop_bias;
}

std::uint64_t Half::samples() const {
  std::uint64_t total = 0;
  for (const Picture& p : batches) total += p.samples;
  return total;
}

double Half::seconds() const {
  double total = 0;
  for (const Picture& p : batches) total += p.seconds;
  return total;
}

Reference::Reference(Half a, Half b)
    : a_(std::move(a)), b_(std::move(b)), pixels_(a_.batches[0].pixels()) {
  average();
  weigh_halves();
  weigh_pixels();
  find_degrees();
  judge_itself();
  compare_halves();
}

void Reference::average() {
  Moments a = moments(a_.batches), b = moments(b_.batches);
  mean_a_ = std::move(a.mean);
  variance_a_ = std::move(a.variance);
  mean_b_ = std::move(b.mean);
  variance_b_ = std::move(b.variance);
}

/// By one number each, since weights by pixel would go by their noise and favour the dark.
void Reference::weigh_halves() {
  const double a = sum(variance_a_), b = sum(variance_b_);
  a_.weight = a + b > 0 ? b / (a + b) : 0.5;
  b_.weight = 1 - a_.weight;
}

void Reference::weigh_pixels() {
  weights_.resize(3 * pixels_);
  for (std::size_t c = 0; c < 3; ++c) {
    const auto value = [&](std::size_t p) {
      const std::size_t i = c * pixels_ + p;
      return a_.weight * mean_a_[i] + b_.weight * mean_b_[i];
    };
    double mean = 0;
    for (std::size_t p = 0; p < pixels_; ++p) mean += value(p) / static_cast<double>(pixels_);
    mean_intensity_ += mean / 3;
    const double least = std::max(floor_part * mean, 1e-30);
    for (std::size_t p = 0; p < pixels_; ++p)
      weights_[c * pixels_ + p] = 1 / (value(p) * value(p) + least * least);
  }
}

void Reference::find_degrees() {
  degree_.resize(pixels_);
  degree_variance_.resize(pixels_);
  lit_.resize(pixels_);
  // Batches' channels share their paths: variances of their mean have to be taken of it.
  std::vector<Picture> greys[2];
  for (int half = 0; half < 2; ++half)
    for (const Picture& p : (half == 0 ? a_ : b_).batches) {
      Picture g;
      g.data.resize(4 * pixels_);
      for (std::size_t s = 0; s < 4; ++s)
        for (std::size_t i = 0; i < pixels_; ++i)
          g.data[s * pixels_ + i] = static_cast<float>(grey(p.data, pixels_, s, i));
      greys[half].push_back(std::move(g));
    }
  const Moments a = moments(greys[0]), b = moments(greys[1]);
  const double wa = a_.weight, wb = b_.weight;
  for (std::size_t p = 0; p < pixels_; ++p) {
    double value[4], variance[4];
    for (std::size_t s = 0; s < 4; ++s) {
      const std::size_t i = s * pixels_ + p;
      value[s] = wa * a.mean[i] + wb * b.mean[i];
      variance[s] = wa * wa * a.variance[i] + wb * wb * b.variance[i];
    }
    lit_[p] = value[0] > floor_part * mean_intensity_;
    if (!lit_[p]) continue;
    ++lit_count_;
    const double noise = variance[1] + variance[2] + variance[3];
    const double s0 = value[0],
                 length2 = value[1] * value[1] + value[2] * value[2] + value[3] * value[3];
    degree_[p] = std::min(1.0, std::sqrt(std::max(0.0, length2 - noise)) / s0);
    // Along the vector, whose direction is unknown where it is short.
    double along = noise / 3;
    if (length2 > noise)
      along = (value[1] * value[1] * variance[1] + value[2] * value[2] * variance[2] +
               value[3] * value[3] * variance[3]) /
              length2;
    degree_variance_[p] = (along + degree_[p] * degree_[p] * variance[0]) / (s0 * s0);
    mean_degree_ += degree_[p];
  }
  if (lit_count_ > 0) mean_degree_ /= static_cast<double>(lit_count_);
}

void Reference::judge_itself() {
  const double wa = a_.weight, wb = b_.weight;
  PerQuantity square{};
  for (std::size_t plane = 0; plane < planes; ++plane)
    for (std::size_t p = 0; p < pixels_; ++p) {
      const std::size_t i = plane * pixels_ + p;
      square[plane / 3] += weights_[plane % 3 * pixels_ + p] *
                           (wa * wa * variance_a_[i] + wb * wb * variance_b_[i]) /
                           static_cast<double>(3 * pixels_);
    }
  complete(square);
  square[degree] =
      sum(degree_variance_) / static_cast<double>(std::max<std::size_t>(1, lit_count_));
  for (std::size_t q = 0; q < quantities; ++q) standard_error_[q] = std::sqrt(square[q]);
}

/// With differences D of batch k of A and B, the mean of D_k D_l over k ≠ l has no noise in it; its
/// own spread is that of leaving out one k after the other.
void Reference::compare_halves() {
  const std::size_t k = std::min(a_.batches.size(), b_.batches.size());
  if (k < 3) return;
  std::vector<double> total(pixels_ * planes);
  const auto difference = [&](std::size_t batch, std::size_t i) {
    return static_cast<double>(a_.batches[batch].data[i]) -
           static_cast<double>(b_.batches[batch].data[i]);
  };
  for (std::size_t batch = 0; batch < k; ++batch)
    for (std::size_t i = 0; i < total.size(); ++i) total[i] += difference(batch, i);
  // |Σ D|² and Σ |D|², and the same without each of the batches.
  PerQuantity all{}, own{};
  std::vector<PerQuantity> without(k), own_of(k);
  for (std::size_t i = 0; i < total.size(); ++i) {
    const std::size_t q = i / (3 * pixels_);
    const double w = weights_[i % (3 * pixels_)] / static_cast<double>(3 * pixels_);
    all[q] += w * total[i] * total[i];
    for (std::size_t batch = 0; batch < k; ++batch) {
      const double d = difference(batch, i), rest = total[i] - d;
      own_of[batch][q] += w * d * d;
      without[batch][q] += w * rest * rest;
    }
  }
  const auto n = static_cast<double>(k);
  for (const auto& o : own_of)
    for (std::size_t q = 0; q < 4; ++q) own[q] += o[q];
  std::vector<PerQuantity> left(k);
  for (std::size_t batch = 0; batch < k; ++batch) {
    for (std::size_t q = 0; q < 4; ++q)
      left[batch][q] = (without[batch][q] - own[q] + own_of[batch][q]) / ((n - 1) * (n - 2));
    complete(left[batch]);
  }
  for (std::size_t q = 0; q < 4; ++q) distance_[q] = (all[q] - own[q]) / (n * (n - 1));
  complete(distance_);
  PerQuantity spread{};
  add_variance(left, spread);
  for (std::size_t q = 0; q < quantities; ++q) distance_error_[q] = std::sqrt(spread[q]) * (n - 1);
}

Errors Reference::errors(const Picture& x) const {
  Errors e;
  const double n = static_cast<double>(3 * pixels_);
  std::vector<PerQuantity> with_a(a_.batches.size()), with_b(b_.batches.size());
  for (std::size_t plane = 0; plane < planes; ++plane) {
    const std::size_t q = plane / 3;
    for (std::size_t p = 0; p < pixels_; ++p) {
      const std::size_t i = plane * pixels_ + p;
      const double value = static_cast<double>(x.data[i]);
      const double from_a = value - mean_a_[i], from_b = value - mean_b_[i];
      const double w = weights_[plane % 3 * pixels_ + p] / n;
      e.square[q] += from_a * from_b / n;
      e.relative_square[q] += w * from_a * from_b;
      for (std::size_t k = 0; k < with_a.size(); ++k)
        with_a[k][q] += w * (value - static_cast<double>(a_.batches[k].data[i])) * from_b;
      for (std::size_t k = 0; k < with_b.size(); ++k)
        with_b[k][q] += w * (value - static_cast<double>(b_.batches[k].data[i])) * from_a;
    }
  }
  complete(e.square);
  complete(e.relative_square);
  for (auto& k : with_a) complete(k);
  for (auto& k : with_b) complete(k);
  PerQuantity variance{};
  add_variance(with_a, variance);
  add_variance(with_b, variance);
  for (std::size_t q = 0; q < quantities; ++q) e.uncertainty[q] = std::sqrt(variance[q]);

  if (lit_count_ == 0) return e;
  for (std::size_t p = 0; p < pixels_; ++p) {
    if (!lit_[p]) continue;
    const auto s = [&](std::size_t component) { return grey(x.data, pixels_, component, p); };
    const double d = degree_of(s(0), s(1), s(2), s(3)) - degree_[p];
    e.square[degree] += (d * d - degree_variance_[p]) / static_cast<double>(lit_count_);
    e.dop_bias += d / static_cast<double>(lit_count_);
  }
  e.relative_square[degree] = e.square[degree];
  return e;
}

}  // namespace convergence
