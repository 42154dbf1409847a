// SPDX-License-Identifier: MIT
#include "info.hpp"

#include <algorithm>
#include <array>
#include <iomanip>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

namespace renderer {
namespace {

/// Doubles: a float's sum over a million pixels has lost the digits that matter.
struct Sum {
  std::array<double, 4> components{};
  std::size_t count = 0;

  void add(const StokesPixel& s) {
    for (std::size_t i = 0; i < 4; ++i) components[i] += static_cast<double>(s[i]);
    ++count;
  }
  StokesPixel mean() const {
    if (count == 0) return {};
    const auto part = [&](std::size_t i) {
      return static_cast<float>(components[i] / static_cast<double>(count));
    };
    return {part(0), part(1), part(2), part(3)};
  }
};

}  // namespace

Info describe(const Image& file, const StokesImage& stokes) {
  Info info;
  info.name = stokes.name;
  info.width = file.width;
  info.height = file.height;
  info.channels = file.channels;
  info.metadata = file.metadata;
  info.polarized = stokes.polarized;
  std::vector<Sum> sums(stokes.colors.size());
  for (std::size_t pixel = 0; pixel < stokes.pixels(); ++pixel) {
    bool all_finite = true;
    bool all_physical = true;
    for (std::size_t color = 0; color < stokes.colors.size(); ++color) {
      const StokesPixel s = stokes.at(color, pixel);
      if (!is_finite(s)) {
        all_finite = false;
        continue;
      }
      sums[color].add(s);
      all_physical = all_physical && is_physical(s);
      // Subnormal numbers have too few digits for a degree.
      if (s[0] >= std::numeric_limits<float>::min())
        info.max_dop = std::max(info.max_dop, degree_of_polarization(s));
    }
    if (!all_finite) ++info.not_finite;
    if (!all_physical) ++info.unphysical;
  }
  for (std::size_t color = 0; color < stokes.colors.size(); ++color) {
    info.mean.emplace_back(stokes.colors[color], sums[color].mean());
  }
  return info;
}

std::string to_text(const Info& info) {
  std::ostringstream text;
  text << info.name << ": " << info.width << " x " << info.height << " pixels\nchannels:";
  for (const std::string& channel : info.channels) text << ' ' << channel;
  text << '\n';
  for (const auto& [name, value] : info.metadata) text << name << " = " << value << '\n';
  text << std::setprecision(6) << std::left << std::setw(6) << "mean" << std::right;
  const int components = info.polarized ? 4 : 1;
  for (int i = 0; i < components; ++i) text << std::setw(14) << "S" + std::to_string(i);
  text << '\n';
  for (const auto& [color, s] : info.mean) {
    text << std::left << std::setw(6) << "  " + color << std::right;
    for (std::size_t i = 0; i < static_cast<std::size_t>(components); ++i) {
      text << std::setw(14) << s[i];
    }
    text << '\n';
  }
  if (info.polarized) {
    text << "largest degree of polarisation: " << info.max_dop << '\n';
  } else {
    text << "no polarisation in this file: it has no Stokes channels (S0.R ... S3.B)\n";
  }
  text << "pixels infinite or not a number: " << info.not_finite
       << "\npixels that are no light (negative, or degree of polarisation above 1): "
       << info.unphysical << '\n';
  return text.str();
}

nlohmann::json to_json(const Info& info) {
  nlohmann::json mean = nlohmann::json::object();
  for (const auto& [color, s] : info.mean) {
    const std::string key = color.empty() ? "Y" : color;
    for (std::size_t i = 0; i < (info.polarized ? 4U : 1U); ++i) {
      mean["S" + std::to_string(i)][key] = s[i];
    }
  }
  nlohmann::json result = {{"name", info.name},
                           {"width", info.width},
                           {"height", info.height},
                           {"channels", info.channels},
                           {"metadata", info.metadata},
                           {"polarized", info.polarized},
                           {"mean", mean},
                           {"not_finite", info.not_finite},
                           {"unphysical", info.unphysical}};
  if (info.polarized) result["max_dop"] = info.max_dop;
  return result;
}

}  // namespace renderer
