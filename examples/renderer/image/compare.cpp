// SPDX-License-Identifier: MIT
#include "compare.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>

#include "../io/input_error.hpp"
#include "finite.hpp"

namespace renderer {
namespace {

std::string size_of(const StokesImage& image) {
  return std::to_string(image.width) + " x " + std::to_string(image.height);
}

std::string colors_of(const StokesImage& image) {
  std::string text = image.polarized ? "S0 ... S3 of" : "intensities";
  for (const std::string& color : image.colors)
    text += " " + (color.empty() ? "one channel" : color);
  return text;
}

Difference compare_planes(const float* a, const float* b, std::size_t pixels) {
  Difference result;
  double squares = 0;
  for (std::size_t i = 0; i < pixels; ++i) {
    if (!is_finite(a[i]) || !is_finite(b[i])) {
      ++result.skipped;
      continue;
    }
    const double difference = static_cast<double>(b[i]) - static_cast<double>(a[i]);
    result.mean_a += static_cast<double>(a[i]);
    result.mean_b += static_cast<double>(b[i]);
    result.mean_difference += difference;
    squares += difference * difference;
    result.max_abs = std::max(result.max_abs, std::fabs(difference));
  }
  const std::size_t used = pixels - result.skipped;
  if (used == 0) return result;
  const double n = static_cast<double>(used);
  result.mean_a /= n;
  result.mean_b /= n;
  result.mean_difference /= n;
  result.rmse = std::sqrt(squares / n);
  return result;
}

}  // namespace

void require_comparable(const StokesImage& a, const StokesImage& b) {
  const std::string pair = "\"" + a.name + "\" and \"" + b.name + "\" cannot be compared: ";
  if (a.width != b.width || a.height != b.height) {
    throw InputError(pair + "their sizes are " + size_of(a) + " and " + size_of(b));
  }
  if (a.polarized != b.polarized || a.colors != b.colors) {
    throw InputError(pair + "their channels are " + colors_of(a) + " and " + colors_of(b));
  }
}

std::vector<Difference> compare(const StokesImage& a, const StokesImage& b) {
  require_comparable(a, b);
  std::vector<Difference> differences;
  for (std::size_t component = 0; component < (a.polarized ? 4U : 1U); ++component) {
    for (std::size_t color = 0; color < a.colors.size(); ++color) {
      const std::size_t start = color * a.pixels();
      Difference one = compare_planes(a.components[component].data() + start,
                                      b.components[component].data() + start, a.pixels());
      one.component = "S" + std::to_string(component);
      one.color = a.colors[color];
      // The rows of S0 come first, one a colour.
      const double brightness = component == 0 ? one.mean_a : differences[color].mean_a;
      if (brightness > 0) one.relative_error = one.rmse / brightness;
      differences.push_back(std::move(one));
    }
  }
  return differences;
}

std::string to_text(const std::vector<Difference>& differences) {
  std::ostringstream text;
  text << std::left << std::setw(8) << "" << std::right;
  for (const char* title :
       {"mean a", "mean b", "mean b-a", "RMSE", "RMSE/mean S0", "max |b-a|", "skipped"}) {
    text << std::setw(14) << title;
  }
  text << '\n' << std::setprecision(6);
  for (const Difference& one : differences) {
    const std::string name = one.color.empty() ? one.component : one.component + "." + one.color;
    text << std::left << std::setw(8) << name << std::right;
    for (const double value : {one.mean_a, one.mean_b, one.mean_difference, one.rmse}) {
      text << std::setw(14) << value;
    }
    text << std::setw(14);
    if (one.relative_error) {
      text << *one.relative_error;
    } else {
      text << "-";
    }
    text << std::setw(14) << one.max_abs << std::setw(14) << one.skipped << '\n';
  }
  return text.str();
}

nlohmann::json to_json(const std::vector<Difference>& differences) {
  nlohmann::json result = nlohmann::json::object();
  for (const Difference& one : differences) {
    nlohmann::json& row = result[one.component][one.color.empty() ? "Y" : one.color];
    row = {{"mean_a", one.mean_a},
           {"mean_b", one.mean_b},
           {"mean_difference", one.mean_difference},
           {"rmse", one.rmse},
           {"max_abs", one.max_abs},
           {"skipped", one.skipped},
           {"relative_error", nullptr}};
    if (one.relative_error) row["relative_error"] = *one.relative_error;
  }
  return result;
}

}  // namespace renderer
