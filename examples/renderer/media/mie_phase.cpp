// SPDX-License-Identifier: MIT
#include "mie_phase.hpp"

#include <malus/optics/mie_sizes.hpp>
#include <numbers>
#include <string>

#include "../core/parallel.hpp"
#include "../image/finite.hpp"
#include "../scene/text.hpp"

namespace renderer {
namespace {

using malus::MieMean;
using malus::MieQuadrature;
using malus::MieSizes;
using Wavelengths = std::array<double, 3>;

constexpr double smallest_median = 1e-3, largest_of_all = 5000;
/// Good to 1e-3 of the cross-sections.
constexpr double range = 3.7;
// Terms of series times angles times sizes; some 2 ns each.
constexpr double most_work = 1.5e8;

double size_parameter(const MieParticles& p, double wavelength) {
  return 2 * std::numbers::pi * p.radius * p.surrounding_index / wavelength;
}

std::complex<double> relative_index(const MieParticles& p) { return p.index / p.surrounding_index; }

void check(const MieParticles& p, const Wavelengths& wavelengths, const Location& where) {
  const auto require = [&](bool holds, const std::string& what, double value,
                           const std::string& allowed) {
    if (!holds || !is_finite(value))
      throw InputError(where, what + " is " + shown(value) + "; allowed: " + allowed);
  };
  const auto require_between = [&](const std::string& what, double value, double least,
                                   double most) {
    require(value >= least && value <= most, what, value, shown(least) + " to " + shown(most));
  };
  require(p.surrounding_index > 0, "the surrounding index", p.surrounding_index, "more than 0");
  require(p.radius > 0, "the radius of Mie particles, in micrometres,", p.radius, "more than 0");
  require_between("the geometric deviation of Mie particles", p.geometric_deviation, 1, 3);
  for (const double wavelength : wavelengths)
    require_between("the size parameter 2 pi radius index/wavelength of Mie particles",
                    size_parameter(p, wavelength), smallest_median, largest_of_all);
  const auto index = relative_index(p);
  require_between("the index of Mie particles over that around them", index.real(), 0.05, 20);
  require_between("the absorption index of Mie particles over the index around them", index.imag(),
                  0, 20);
  const double shortest = *std::min_element(wavelengths.begin(), wavelengths.end());
  const double largest =
      malus::largest_size({size_parameter(p, shortest), p.geometric_deviation}, {range});
  require(largest <= largest_of_all,
          "the size parameter of the largest Mie particles of the distribution that count", largest,
          "up to " + shown(largest_of_all) + ", by a smaller radius or geometric deviation");
  if (std::abs(index - 1.0) < 1e-6)
    throw InputError(where, "Mie particles of the index " + shown(p.index.real()) +
                                " scatter nothing in what has it too; allowed: another index");
}

/// Even in angle, a dozen to a fringe; closer within the forward peak of the largest spheres, down
/// to what the cosine's single precision can tell apart.
std::vector<double> table_angles(double median, double largest) {
  constexpr double pi = std::numbers::pi;
  const double even = pi / std::clamp(12 * median, 180.0, 3000.0);
  const double closest = std::min(std::max(0.15 / largest, 7e-4), even);
  std::vector<double> angles{0};
  while (angles.back() < pi - even) {
    const double step = std::clamp(angles.back() / 10, closest, even);
    angles.push_back(angles.back() + step);
  }
  angles.push_back(pi);
  return angles;
}

MieQuadrature quadrature_for(double largest, std::size_t angles) {
  const double each = (largest + 20) / 2 * static_cast<double>(angles);
  const auto spheres = static_cast<std::size_t>(std::clamp(most_work / 3 / each, 64.0, 2000.0));
  return {range, 0.1, spheres};
}

}  // namespace

TabulatedPhase make_mie_phase(const MieParticles& particles, const Wavelengths& wavelengths,
                              const Location& where) {
  check(particles, wavelengths, where);
  const double shortest = *std::min_element(wavelengths.begin(), wavelengths.end());
  const double median = size_parameter(particles, shortest);
  const double largest = malus::largest_size({median, particles.geometric_deviation}, {range});
  const std::vector<double> angles = table_angles(median, largest);
  const MieQuadrature quadrature = quadrature_for(largest, angles.size());
  std::vector<double> cosines(angles.size());
  for (std::size_t i = 0; i < angles.size(); ++i) cosines[i] = std::cos(angles[i]);

  // Angles don't know of each other: the table is the same on any number of threads.
  constexpr std::size_t part = 256;
  const std::size_t parts = (angles.size() + part - 1) / part;
  std::vector<TabulatedPhase::Row> rows(angles.size());
  parallel_for(3 * parts, 1, [&](std::size_t from, std::size_t to) {
    for (std::size_t task = from; task != to; ++task) {
      const std::size_t channel = task % 3, first = task / 3 * part;
      const std::size_t count = std::min(part, angles.size() - first);
      const MieMean mean = malus::mie_mean(
          {size_parameter(particles, wavelengths[channel]), particles.geometric_deviation},
          relative_index(particles), std::span(cosines).subspan(first, count), quadrature);
      for (std::size_t i = 0; i < count; ++i) rows[first + i][channel] = mean.elements[i];
    }
  });
  return TabulatedPhase(angles, rows);
}

MieCrossSections mie_cross_sections(const MieParticles& particles, const Wavelengths& wavelengths,
                                    const Location& where) {
  check(particles, wavelengths, where);
  MieCrossSections result{};
  for (std::size_t i = 0; i < 3; ++i) {
    const MieSizes sizes{size_parameter(particles, wavelengths[i]), particles.geometric_deviation};
    const MieMean mean = malus::mie_mean(sizes, relative_index(particles), {}, {range, 0.1, 500});
    const double k = 2 * std::numbers::pi * particles.surrounding_index / wavelengths[i];
    result.extinction[i] = mean.extinction / (k * k);
    result.scattering[i] = mean.scattering / (k * k);
  }
  const double green = result.extinction[1];
  for (std::size_t i = 0; i < 3; ++i) {
    result.extinction[i] /= green;
    result.scattering[i] /= green;
  }
  return result;
}

}  // namespace renderer
