// SPDX-License-Identifier: MIT
#include "film.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace renderer {

void PixelSum::add(const malus::Measurement<Rgb>& m) {
  for (std::size_t s = 0; s < 4; ++s)
    for (std::size_t c = 0; c < 3; ++c) stokes[3 * s + c] += static_cast<double>(m[s][c]);
  const double s0 = static_cast<double>(malus::mean_channel(m[0]));
  square += s0 * s0;
  ++count;
}

PixelSum& PixelSum::operator+=(const PixelSum& p) {
  for (std::size_t i = 0; i < stokes.size(); ++i) stokes[i] += p.stokes[i];
  square += p.square;
  count += p.count;
  return *this;
}

Film::Film(int width, int height, std::size_t batches)
    : width_(width),
      height_(height),
      batches_(batches),
      sums_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * batches) {}

PixelSum Film::total(std::size_t pixel) const {
  PixelSum sum;
  for (std::size_t b = 0; b < batches_; ++b) sum += sums_[pixel * batches_ + b];
  return sum;
}

std::array<double, 12> Film::standard_error(std::size_t pixel) const {
  std::array<double, 12> error{};
  const PixelSum all = total(pixel);
  std::size_t used = 0;
  for (std::size_t b = 0; b < batches_; ++b) {
    const PixelSum& batch = sums_[pixel * batches_ + b];
    if (batch.count == 0) continue;
    ++used;
    for (std::size_t i = 0; i < error.size(); ++i) {
      // Batches of unequal size count by their size.
      const double d = batch.mean(i) - all.mean(i);
      error[i] += d * d * static_cast<double>(batch.count);
    }
  }
  for (double& e : error)
    e = used < 2 ? std::numeric_limits<double>::quiet_NaN()
                 : std::sqrt(e / static_cast<double>(used - 1) / static_cast<double>(all.count));
  return error;
}

double Film::relative_noise() const {
  const std::size_t pixels = sums_.size() / batches_;
  double noise = 0;
  std::size_t lit = 0;
  for (std::size_t p = 0; p < pixels; ++p) {
    const PixelSum sum = total(p);
    const auto n = static_cast<double>(sum.count);
    const double mean = (sum.stokes[0] + sum.stokes[1] + sum.stokes[2]) / (3 * n);
    if (sum.count < 2 || !(mean > 0)) continue;
    const double variance = std::max(0.0, sum.square / n - mean * mean);
    noise += std::sqrt(variance / n) / mean;
    ++lit;
  }
  return lit > 0 ? noise / static_cast<double>(lit) : 0;
}

Image Film::image(StokesFrame frame, bool with_errors) const {
  std::vector<std::string> names{"R", "G", "B"};
  for (const char* s : {"S0", "S1", "S2", "S3"})
    for (const char* c : {".R", ".G", ".B"}) names.push_back(std::string(s) + c);
  if (with_errors)
    for (std::size_t i = 3; i < 15; ++i) names.push_back("SE" + names[i].substr(1));
  Image image(width_, height_, names);
  const std::size_t pixels = image.pixels();
  for (std::size_t p = 0; p < pixels; ++p) {
    const PixelSum sum = total(p);
    for (std::size_t i = 0; i < 12; ++i) {
      const bool turns = frame == StokesFrame::up && i >= 3 && i < 9;
      const auto value = static_cast<float>(turns ? -sum.mean(i) : sum.mean(i));
      image.data[(i + 3) * pixels + p] = value;
      if (i < 3) image.data[i * pixels + p] = value;
    }
    if (!with_errors) continue;
    const std::array<double, 12> errors = standard_error(p);
    for (std::size_t i = 0; i < 12; ++i)
      image.data[(i + 15) * pixels + p] = static_cast<float>(errors[i]);
  }
  return image;
}

}  // namespace renderer
