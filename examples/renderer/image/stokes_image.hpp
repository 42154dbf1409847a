// SPDX-License-Identifier: MIT
// An EXR's channels sorted into Stokes vectors: S0.R, S0.G ... S3.B as Mitsuba's `stokes`
// integrator names them (or S0, S1, S2, S3 without colours), turned into the frame x = right, y =
// up of the picture if the header says that they are in another. A picture without such channels is
// one of intensities, R G B or Y, and not polarized.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "../io/image.hpp"
#include "stokes_pixel.hpp"

namespace renderer {

/// The header attribute that names the frame, and its values.
inline constexpr const char* stokes_frame_attribute = "malus:stokes_frame";
inline constexpr const char* horizontal_frame = "horizontal";
inline constexpr const char* up_frame = "up";

struct StokesImage {
  std::string name;  // the file it came from, for messages
  int width = 0;
  int height = 0;
  std::vector<std::string>
      colors;  // "R" "G" "B", or whatever follows "S0."; one empty string for plain S0
  bool polarized = false;
  /// For each of S0 ... S3 one plane a colour, in the order of `colors`; S1 to S3 are empty unless
  /// polarized.
  std::array<std::vector<float>, 4> components;
  std::map<std::string, std::string> metadata;

  std::size_t pixels() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  bool has_rgb() const { return colors.size() == 3 && colors[0] == "R"; }
  StokesPixel at(std::size_t color, std::size_t pixel) const;
  void set(std::size_t color, std::size_t pixel, const StokesPixel& value);
  /// The mean of the colours: the light a sensor without colour filters would see.
  StokesPixel mean(std::size_t pixel) const;
  /// Throws InputError if there is no polarisation to ask about.
  void require_polarization() const;
};

/// Throws InputError where channels are missing or the frame is unknown.
StokesImage stokes_image(const Image& image, const std::string& name);

/// The picture as a file holds it: R G B (if the colours are these), then the Stokes channels in
/// the horizontal frame.
Image to_image(const StokesImage& stokes);

}  // namespace renderer
