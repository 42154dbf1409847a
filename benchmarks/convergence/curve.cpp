// SPDX-License-Identifier: MIT
#include "curve.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace convergence {

namespace {

struct Sample {
  double log_time, log_error;
};

/// The resolved points, by growing time.
std::vector<Sample> samples(const Curve& curve, std::size_t quantity, const Reference& reference,
                            std::optional<std::size_t> without = {}) {
  std::vector<Sample> list;
  const double seconds = curve.seconds_a_sample();
  for (const Point& p : curve.points) {
    const double e = p.error(quantity, true, without);
    if (!p.resolved(quantity, reference) || !(e > 0)) continue;
    list.push_back({std::log(seconds * static_cast<double>(p.samples)), std::log(e)});
  }
  return list;
}

/// Least squares; none without a spread of times.
std::optional<Line> fit(const std::vector<Sample>& list) {
  if (list.size() < 3) return {};
  const auto n = static_cast<double>(list.size());
  double x = 0, y = 0, xx = 0, xy = 0;
  for (const Sample& s : list) {
    x += s.log_time / n;
    y += s.log_error / n;
  }
  for (const Sample& s : list) {
    xx += (s.log_time - x) * (s.log_time - x);
    xy += (s.log_time - x) * (s.log_error - y);
  }
  if (!(xx > 0)) return {};
  return Line{y - xy / xx * x, xy / xx, 0};
}

std::optional<TimeTo> find_time(const std::vector<Sample>& list, double error) {
  const double target = std::log(error);
  for (std::size_t i = 0; i + 1 < list.size(); ++i) {
    const Sample &a = list[i], &b = list[i + 1];
    if (!(a.log_error >= target && target >= b.log_error)) continue;
    const double drop = a.log_error - b.log_error;
    const double part = drop > 0 ? (a.log_error - target) / drop : 0;
    return TimeTo{std::exp(a.log_time + part * (b.log_time - a.log_time)), Found::measured, 0};
  }
  if (!list.empty() && list.front().log_error < target)
    return TimeTo{std::exp(list.front().log_time), Found::at_most, 0};
  if (list.size() < 3) return {};
  const auto line = fit({list.end() - 3, list.end()});
  if (!line || !(line->slope < 0)) return {};
  const double log_time = (target - line->intercept) / line->slope;
  // A line that is steeper than its points leave it may say that it has been reached already.
  if (log_time > list.back().log_time + std::log(reach)) return {};
  return TimeTo{std::exp(std::max(log_time, list.back().log_time)), Found::extrapolated, 0};
}

/// A jackknife's standard error: of values each without one of n.
double jackknife(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  double mean = 0, square = 0;
  for (const double v : values) mean += v / n;
  for (const double v : values) square += (v - mean) * (v - mean);
  return std::sqrt((n - 1) / n * square);
}

/// Student's 97.5 % point, from two degrees of freedom on to three digits (Abramowitz & Stegun
/// 1964, 26.7.5).
double student(std::size_t degrees) {
  constexpr double exact[] = {12.706, 4.303, 3.182, 2.776, 2.571, 2.447};
  if (degrees <= std::size(exact)) return exact[degrees - 1];
  constexpr double z = 1.959964;
  const auto n = static_cast<double>(degrees);
  return z + (z * z * z + z) / (4 * n) +
         (5 * std::pow(z, 5) + 16 * z * z * z + 3 * z) / (96 * n * n);
}

/// The logarithm of Gain's value at equal samples; infinite where an error is 0 without a repeat.
double log_gain(const Point& base, const Point& other, std::size_t quantity,
                std::optional<std::size_t> without = {}) {
  return 2 * std::log(base.error(quantity, true, without)) -
         2 * std::log(other.error(quantity, true, without));
}

}  // namespace

void Point::add_repeat(const std::vector<Picture>& pictures, const Reference& reference) {
  double time = 0;
  Errors mean;
  for (const Picture& p : pictures) {
    time += p.seconds / static_cast<double>(pictures.size());
    mean.add(reference.errors(p), 1 / static_cast<double>(pictures.size()));
  }
  seconds.push_back(time);
  repeats.push_back(mean);
}

double Point::error(std::size_t quantity, bool relative, std::optional<std::size_t> without) const {
  double total = 0, n = 0;
  for (std::size_t r = 0; r < repeats.size(); ++r) {
    if (without == r) continue;
    total += (relative ? repeats[r].relative_square : repeats[r].square)[quantity];
    ++n;
  }
  return std::sqrt(std::max(0.0, total / n));
}

double Point::spread(std::size_t quantity, bool relative) const {
  std::vector<double> values;
  for (std::size_t r = 0; r < repeats.size(); ++r) values.push_back(error(quantity, relative, r));
  return jackknife(values);
}

double Point::dop_bias() const {
  double total = 0;
  for (const Errors& e : repeats) total += e.dop_bias;
  return total / static_cast<double>(repeats.size());
}

bool Point::resolved(std::size_t quantity, const Reference& reference) const {
  double uncertainty = 0;
  // The repeats share the reference: their uncertainties don't average out.
  for (const Errors& e : repeats)
    uncertainty += e.uncertainty[quantity] / static_cast<double>(repeats.size());
  const double e = error(quantity);
  return e > 2 * reference.standard_error()[quantity] && e * e > 3 * uncertainty;
}

double Curve::seconds_a_sample() const {
  std::vector<double> all;
  for (const Point& p : points)
    for (const double s : p.seconds) all.push_back(s / static_cast<double>(p.samples));
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end());
  return *middle;
}

std::optional<Line> Curve::line(std::size_t quantity, const Reference& reference) const {
  auto all = fit(samples(*this, quantity, reference));
  if (!all) return {};
  std::vector<double> slopes;
  for (std::size_t r = 0; r < points[0].repeats.size(); ++r)
    if (const auto l = fit(samples(*this, quantity, reference, r))) slopes.push_back(l->slope);
  if (slopes.size() > 1) all->slope_error = jackknife(slopes);
  return all;
}

std::optional<TimeTo> Curve::time_to(double error, std::size_t quantity,
                                     const Reference& reference) const {
  const auto list = samples(*this, quantity, reference);
  auto found = find_time(list, error);
  if (!found) return {};
  std::vector<double> logs;
  for (std::size_t r = 0; r < points[0].repeats.size(); ++r)
    if (const auto t = find_time(samples(*this, quantity, reference, r), error))
      logs.push_back(std::log(t->seconds));
  if (logs.size() > 1) found->error = jackknife(logs);
  return found;
}

std::optional<Gain> gain_over(const Curve& base, const Curve& curve, std::size_t quantity,
                              bool at_equal_time, const Reference& reference) {
  const double faster =
      at_equal_time ? std::log(base.seconds_a_sample() / curve.seconds_a_sample()) : 0;
  for (std::size_t i = std::min(base.points.size(), curve.points.size()); i-- > 0;) {
    const Point &b = base.points[i], &c = curve.points[i];
    if (!b.resolved(quantity, reference) || !c.resolved(quantity, reference)) continue;
    const std::size_t repeats = std::min(b.repeats.size(), c.repeats.size());
    if (repeats < 2) return {};
    std::vector<double> logs;
    for (std::size_t r = 0; r < repeats; ++r) logs.push_back(log_gain(b, c, quantity, r));
    const double log = log_gain(b, c, quantity) + faster;
    const double half = student(repeats - 1) * jackknife(logs);
    if (!std::isfinite(half)) continue;
    return Gain{c.samples, std::exp(log), std::exp(log - half), std::exp(log + half)};
  }
  return {};
}

}  // namespace convergence
