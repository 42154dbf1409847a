// SPDX-License-Identifier: MIT
#include "filter.hpp"

#include <charconv>
#include <cmath>
#include <cstddef>
#include <malus/analysis/polarization_state.hpp>
#include <malus/optics/polarizer.hpp>
#include <malus/optics/retarder.hpp>
#include <malus/product.hpp>
#include <malus/propagate.hpp>
#include <numbers>
#include <string_view>

#include "../io/input_error.hpp"
#include "finite.hpp"

namespace renderer {
namespace {

using Matrix = decltype(Filter::matrix);

[[noreturn]] void refuse(const std::string& text, const std::string& why) {
  throw InputError("filter \"" + text + "\": " + why + "; allowed are " + filter_grammar);
}

std::vector<double> parse_numbers(const std::string& text, std::string_view list,
                                  std::size_t count) {
  std::vector<double> numbers;
  const char* next = list.data();
  const char* const end = list.data() + list.size();
  while (true) {
    double number = 0;
    const auto [rest, error] = std::from_chars(next, end, number);
    if (error != std::errc{} || !is_finite(number) || std::fabs(number) > 1e6) {
      refuse(text, "\"" + std::string(next, end) + "\" does not begin with an angle");
    }
    numbers.push_back(number);
    if (rest == end) break;
    if (*rest != ',') refuse(text, "\"" + std::string(rest, end) + "\" follows a number");
    next = rest + 1;
  }
  if (numbers.size() != count) {
    refuse(text,
           "has " + std::to_string(numbers.size()) + " numbers, wants " + std::to_string(count));
  }
  return numbers;
}

/// Whole turns are taken off while there are digits to do it with.
float radians(double degrees) {
  return static_cast<float>(std::remainder(degrees, 360.0) * std::numbers::pi / 180);
}

/// Half the outer product of the state it passes with itself: what an ideal polarizer for any
/// polarisation is.
Matrix elliptical_polarizer(float azimuth, float ellipticity) {
  const StokesPixel state =
      malus::from_ellipse<malus::incident>(1.0F, 1.0F, azimuth, ellipticity, PictureFrame{});
  Matrix::rows_type rows;
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      rows[row][column] = 0.5F * state[row] * state[column];
    }
  }
  return Matrix::from_rows(rows);
}

/// On the Poincare sphere the axis stands at twice its angle.
Matrix linear_retarder(float axis, float retardance) {
  return malus::elliptical_retarder(1.0F, {std::cos(2 * axis), std::sin(2 * axis), 0.0F},
                                    retardance, PictureFrame{});
}

Matrix parse_matrix(const std::string& text) {
  const std::size_t colon = text.find(':');
  const std::string kind = text.substr(0, colon);
  const std::string_view rest =
      colon == std::string::npos ? std::string_view() : std::string_view(text).substr(colon + 1);
  if (kind == "linear") {
    const float angle = radians(parse_numbers(text, rest, 1)[0]);
    return malus::linear_polarizer(1.0F, PictureFrame{}, angle);
  }
  if (kind == "circular") {
    using malus::Handedness;
    if (rest == "right") return malus::circular_polarizer(1.0F, Handedness::right, PictureFrame{});
    if (rest == "left") return malus::circular_polarizer(1.0F, Handedness::left, PictureFrame{});
    refuse(text, "\"" + std::string(rest) + "\" is neither left nor right");
  }
  if (kind == "elliptical") {
    const auto numbers = parse_numbers(text, rest, 2);
    if (std::fabs(numbers[1]) > 45) refuse(text, "the ellipticity is outside -45 ... 45");
    return elliptical_polarizer(radians(numbers[0]), radians(numbers[1]));
  }
  if (kind == "retarder") {
    const auto numbers = parse_numbers(text, rest, 2);
    return linear_retarder(radians(numbers[0]), radians(numbers[1]));
  }
  refuse(text, "unknown kind \"" + kind + "\"");
}

}  // namespace

Filter parse_filter(const std::string& text) { return {text, parse_matrix(text)}; }

StokesPixel pass(const StokesPixel& light, const Filter& filter) {
  return malus::propagate(filter.matrix * light);
}

StokesImage look_through(const std::vector<Filter>& filters, StokesImage image) {
  image.require_polarization();
  std::string& history = image.metadata["malus:filter"];
  for (const Filter& filter : filters) {
    history += (history.empty() ? "" : " then ") + filter.name;
    for (std::size_t color = 0; color < image.colors.size(); ++color) {
      for (std::size_t pixel = 0; pixel < image.pixels(); ++pixel) {
        image.set(color, pixel, pass(image.at(color, pixel), filter));
      }
    }
  }
  return image;
}

}  // namespace renderer
