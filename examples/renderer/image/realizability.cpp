// SPDX-License-Identifier: MIT
#include "realizability.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

namespace renderer {
namespace {

/// The standard error of |(S1, S2, S3)| − S0, to first order. Light's polarised part grows with its
/// intensity, so that leaving their covariance out makes it larger, never smaller.
double error_of_excess(const StokesPixel& s, const StokesPixel& errors) {
  const auto square = [](float x) { return static_cast<double>(x) * static_cast<double>(x); };
  double polarized = 0, variance = 0;
  for (std::size_t i = 1; i < 4; ++i) {
    polarized += square(s[i]);
    variance += square(s[i]) * square(errors[i]);
  }
  return std::sqrt(square(errors[0]) + (polarized > 0 ? variance / polarized : 0.0));
}

std::string error_channel(std::size_t component, const std::string& color) {
  return "SE" + std::to_string(component) + (color.empty() ? "" : "." + color);
}

bool has_errors(const Image& file, const StokesImage& stokes) {
  for (std::size_t component = 0; component < 4; ++component)
    for (const std::string& color : stokes.colors)
      if (!file.has(error_channel(component, color))) return false;
  return true;
}

}  // namespace

Realizability check_realizability(const Image& file, const StokesImage& stokes) {
  stokes.require_polarization();
  Realizability result;
  result.name = stokes.name;
  const bool with_errors = has_errors(file, stokes);
  if (with_errors) result.beyond_errors = 0;
  for (std::size_t color = 0; color < stokes.colors.size(); ++color) {
    const auto error = [&](std::size_t component, std::size_t pixel) {
      return file.plane(error_channel(component, stokes.colors[color]))[pixel];
    };
    for (std::size_t pixel = 0; pixel < stokes.pixels(); ++pixel) {
      ++result.values;
      const StokesPixel s = stokes.at(color, pixel);
      if (!is_finite(s)) {
        ++result.not_finite;
        continue;
      }
      const double excess = excess_of_polarization(s) - rounding(s);
      if (s[0] >= std::numeric_limits<float>::min())
        result.worst =
            std::max(result.worst, excess_of_polarization(s) / static_cast<double>(s[0]));
      if (!(excess > 0)) continue;
      ++result.beyond_rounding;
      if (!with_errors) continue;
      const StokesPixel errors(error(0, pixel), error(1, pixel), error(2, pixel), error(3, pixel));
      // An error that is not a number excuses nothing.
      if (!is_finite(errors) || excess > Realizability::sigmas * error_of_excess(s, errors))
        ++*result.beyond_errors;
    }
  }
  return result;
}

std::string to_text(const Realizability& r) {
  std::ostringstream text;
  text << r.name << ": " << r.values
       << " Stokes vectors\ninfinite or not a number: " << r.not_finite
       << "\ndegree of polarisation above 1, beyond rounding: " << r.beyond_rounding << '\n';
  if (r.beyond_errors)
    text << "and by more than " << Realizability::sigmas << " standard errors: " << *r.beyond_errors
         << '\n';
  else
    text << "no standard errors in this file: malus-render --standard-error writes them\n";
  text << "largest excess over S0, as a part of it: " << r.worst << '\n';
  return text.str();
}

nlohmann::json to_json(const Realizability& r) {
  nlohmann::json json = {{"name", r.name},
                         {"values", r.values},
                         {"not_finite", r.not_finite},
                         {"beyond_rounding", r.beyond_rounding},
                         {"beyond_errors", nullptr},
                         {"worst", r.worst}};
  if (r.beyond_errors) json["beyond_errors"] = *r.beyond_errors;
  return json;
}

}  // namespace renderer
