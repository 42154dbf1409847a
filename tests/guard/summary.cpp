// SPDX-License-Identifier: MIT
#include "summary.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <fstream>
#include <iterator>
#include <map>

#include "render/render.hpp"
#include "scene/build.hpp"
#include "scene/requirements.hpp"
#include "scene/xml_reader.hpp"

namespace guard {
namespace {

constexpr int width = 24, height = 16, columns = 3, rows = 2;
constexpr std::uint64_t samples_per_pixel = 32;

/// The film's size, by the parameters that a scene has for it.
std::map<std::string, std::string> small(const std::filesystem::path& scene) {
  std::ifstream in(scene);
  const std::string text(std::istreambuf_iterator<char>(in), {});
  std::map<std::string, std::string> definitions;
  for (const auto& [name, size] :
       {std::pair{"resolution", width}, {"width", width}, {"height", height}})
    if (text.find("<default name=\"" + std::string(name) + "\"") != std::string::npos)
      definitions[name] = std::to_string(size);
  return definitions;
}

using Stokes = std::array<double, 4>;

/// The mean of the channels.
Stokes stokes_of(const renderer::Image& image, int x, int y) {
  Stokes mean{};
  const auto pixel = static_cast<std::size_t>(y * image.width + x);
  for (std::size_t s = 0; s < 4; ++s)
    for (const char* channel : {".R", ".G", ".B"})
      mean[s] += static_cast<double>(image.plane("S" + std::to_string(s) + channel)[pixel]) / 3;
  return mean;
}

/// Means over a block of pixels, each of them brought into bounds before.
void append_block(const renderer::Image& image, int from_x, int to_x, int from_y, int to_y,
                  double scale, Summary& summary) {
  Stokes mean{};
  for (int y = from_y; y < to_y; ++y)
    for (int x = from_x; x < to_x; ++x) {
      const Stokes stokes = stokes_of(image, x, y);
      const double bound = (std::max(stokes[0], 0.0) + scale) * (to_x - from_x) * (to_y - from_y);
      for (std::size_t s = 0; s < 4; ++s) mean[s] += stokes[s] / bound;
    }
  summary.insert(summary.end(), mean.begin(), mean.end());
}

double mean_intensity(const renderer::Image& image) {
  double sum = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) sum += stokes_of(image, x, y)[0];
  return sum / (image.width * image.height);
}

}  // namespace

std::optional<Summary> summarize(const std::filesystem::path& path, const std::string& integrator,
                                 unsigned seed, double& scale) {
  renderer::Scene scene = renderer::build_scene(*renderer::read_scene(path, small(path)));
  renderer::set_integrator(scene.integrator, integrator);
  try {
    renderer::check_requirements(scene, path.string());
  } catch (const renderer::InputError&) {
    return std::nullopt;
  }
  renderer::RenderOptions options;
  options.samples_per_pixel = samples_per_pixel;
  options.seed = seed;
  const std::atomic<bool> stop{false};
  const auto image =
      renderer::render(scene, options, stop, {}).film.image(renderer::StokesFrame::horizontal);
  if (scale <= 0) scale = std::max(mean_intensity(image), 1e-6);
  Summary summary;
  const int across = std::min(columns, image.width), down = std::min(rows, image.height);
  for (int row = 0; row < down; ++row)
    for (int column = 0; column < across; ++column)
      append_block(image, image.width * column / across, image.width * (column + 1) / across,
                   image.height * row / down, image.height * (row + 1) / down, scale, summary);
  append_block(image, 0, image.width, 0, image.height, scale, summary);
  return summary;
}

}  // namespace guard
