// SPDX-License-Identifier: MIT
#include "run.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <ostream>
#include <string_view>
#include <system_error>

#include "../io/atomic_file.hpp"
#include "../io/exr.hpp"
#include "../io/input_error.hpp"
#include "../io/png.hpp"
#include "compare.hpp"
#include "compare_panels.hpp"
#include "filter.hpp"
#include "finite.hpp"
#include "info.hpp"
#include "realizability.hpp"
#include "show.hpp"
#include "stokes_image.hpp"

namespace renderer {
namespace {

void print_json(const nlohmann::json& json, std::ostream& out) {
  // A header may hold text that is not UTF-8, which JSON cannot.
  out << json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << '\n';
}

bool ends_with(const std::string& path, std::string_view extension) {
  std::string tail = std::filesystem::path(path).extension().string();
  std::transform(tail.begin(), tail.end(), tail.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return tail == extension;
}

/// Everything that can be known to be wrong with the output before any work is done.
void check_output(const ImageOptions& options, bool exr_allowed) {
  const std::string& path = options.output;
  const std::string allowed = exr_allowed ? ".png or .exr" : ".png";
  if (path.empty()) throw InputError("an output file is missing: -o FILE (" + allowed + ")");
  if (!ends_with(path, ".png") && !(exr_allowed && ends_with(path, ".exr"))) {
    throw InputError("-o " + path + ": the name must end in " + allowed);
  }
  std::vector<std::string> inputs = options.compare;
  if (!options.input.empty()) inputs.push_back(options.input);
  for (const std::string& input : inputs) {
    std::error_code error;
    if (std::filesystem::equivalent(input, path, error)) {
      throw InputError("-o " + path + ": this is the input file; give the output another name");
    }
  }
  check_writable(path);
}

StokesImage select_channel(const StokesImage& image, const std::string& channel) {
  if (channel.empty()) return image;
  const auto found = std::find(image.colors.begin(), image.colors.end(), channel);
  if (found == image.colors.end()) {
    std::string allowed;
    for (const std::string& color : image.colors) allowed += " " + color;
    throw InputError(Location{image.name, 0},
                     "--channel " + channel + ": unknown; this file has" + allowed);
  }
  const auto start = static_cast<std::ptrdiff_t>(
      static_cast<std::size_t>(found - image.colors.begin()) * image.pixels());
  const auto count = static_cast<std::ptrdiff_t>(image.pixels());
  StokesImage one = image;
  one.colors = {channel};
  for (auto& planes : one.components) {
    if (planes.empty()) continue;
    planes.erase(planes.begin() + start + count, planes.end());
    planes.erase(planes.begin(), planes.begin() + start);
  }
  return one;
}

StokesImage read(const std::string& path, const ImageOptions& options) {
  return select_channel(stokes_image(read_exr(path), path), options.channel);
}

void warn_not_finite(const StokesImage& image, std::ostream& err) {
  const std::size_t count = count_not_finite(image);
  if (count == 0) return;
  err << "malus-image: " << image.name << ": " << count
      << (count == 1 ? " pixel is" : " pixels are") << " infinite or not a number, shown black\n";
}

void run_compare(const ImageOptions& options, std::ostream& out, std::ostream& err) {
  if (!options.output.empty()) check_output(options, false);
  const StokesImage a = read(options.compare[0], options);
  const StokesImage b = read(options.compare[1], options);
  const std::vector<Difference> differences = compare(a, b);
  if (!options.output.empty()) {
    warn_not_finite(a, err);
    warn_not_finite(b, err);
    const float difference_scale =
        options.difference_scale > 0 ? options.difference_scale : options.scale;
    write_png(options.output,
              comparison_panels(a, b, {options.exposure, options.scale}, difference_scale));
  }
  if (options.json) {
    print_json(to_json(differences), out);
  } else {
    out << to_text(differences);
  }
}

void run_info(const ImageOptions& options, std::ostream& out) {
  const Image file = read_exr(options.input);
  const Info info =
      describe(file, select_channel(stokes_image(file, options.input), options.channel));
  if (options.json) {
    print_json(to_json(info), out);
  } else {
    out << to_text(info);
  }
}

/// 1 if not every pixel is light.
int run_physical(const ImageOptions& options, std::ostream& out) {
  const Image file = read_exr(options.input);
  const Realizability result =
      check_realizability(file, select_channel(stokes_image(file, options.input), options.channel));
  if (options.json) {
    print_json(to_json(result), out);
  } else {
    out << to_text(result);
  }
  return result.unphysical() > 0 ? 1 : 0;
}

void run_picture(const ImageOptions& options, std::ostream& err) {
  const bool to_exr = ends_with(options.output, ".exr");
  check_output(options, options.show.empty());
  const Show what = options.show.empty() ? Show::intensity : parse_show(options.show);
  std::vector<Filter> filters;
  for (const std::string& text : options.filters) filters.push_back(parse_filter(text));
  StokesImage image = read(options.input, options);
  if (!filters.empty()) image = look_through(filters, std::move(image));
  if (to_exr) {
    write_exr(options.output, to_image(image));
  } else {
    warn_not_finite(image, err);
    write_png(options.output, show(image, what, {options.exposure, options.scale}));
  }
}

void check_options(const ImageOptions& options) {
  const bool picture = !options.show.empty() || !options.filters.empty();
  const int actions =
      int{options.info} + int{options.physical} + int{picture} + int{!options.compare.empty()};
  if (actions != 1) {
    throw InputError(
        actions == 0 ? "nothing to do: give --show, --filter, --info, --physical or --compare"
                     : "--info, --physical, --compare and --show or --filter exclude each other");
  }
  if (!options.compare.empty() && !options.input.empty()) {
    throw InputError("--compare takes exactly two files, and \"" + options.input + "\" is a third");
  }
  if (options.compare.empty() && options.input.empty()) {
    throw InputError("an input file is missing: malus-image IN.exr ...");
  }
  if ((options.info || options.physical) && !options.output.empty()) {
    throw InputError(std::string(options.info ? "--info" : "--physical") +
                     " prints to the terminal and takes no -o");
  }
  if (options.json && picture) throw InputError("--json goes with --info, --physical or --compare");
  if (!is_finite(options.exposure) || std::fabs(options.exposure) > 100) {
    throw InputError("--exposure: must be a number of stops from -100 to 100");
  }
  if (!is_finite(options.scale) || options.scale <= 0 || !is_finite(options.difference_scale) ||
      options.difference_scale < 0) {
    throw InputError("--scale, --difference-scale: must be positive numbers");
  }
}

}  // namespace

int run_image(const ImageOptions& options, std::ostream& out, std::ostream& err) {
  check_options(options);
  if (options.physical) return run_physical(options, out);
  if (options.info) {
    run_info(options, out);
  } else if (!options.compare.empty()) {
    run_compare(options, out, err);
  } else {
    run_picture(options, err);
  }
  return 0;
}

}  // namespace renderer
