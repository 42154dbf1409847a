// SPDX-License-Identifier: MIT
#include "command_line.hpp"

#include <CLI/CLI.hpp>
#include <exception>
#include <malus/config.hpp>
#include <ostream>
#include <string>

#include "../io/input_error.hpp"
#include "run.hpp"
#include "show.hpp"

namespace renderer {
namespace {

constexpr int work_failed = 1;
constexpr int input_wrong = 2;

constexpr const char* description =
    "Shows the polarisation in an OpenEXR picture with Stokes channels (S0.R ... S3.B).\n"
    "Angles count counter-clockwise from horizontal, S3 > 0 is right circular. If the header's\n"
    "malus:stokes_frame is \"up\", S1 and S2 are negated first, which brings them to that frame.";

constexpr const char* footer =
    "Colours (Wilkie & Weidlich 2010):\n"
    "  intensity   the picture itself\n"
    "  s1 s2 s3    green positive, red negative\n"
    "  dop dolp    degree of polarisation, of linear polarisation: red on black\n"
    "  docp        degree of circular polarisation: blue right, yellow left\n"
    "  aolp        angle of linear polarisation: red 0, yellow-green 45, cyan 90, violet 135\n"
    "              degrees; bright where the degree of linear polarisation is high\n"
    "  overlay     grey intensity with the degree of polarisation in red\n"
    "Filters (degrees counter-clockwise from horizontal):\n"
    "  linear:ANGLE  circular:left  circular:right  elliptical:AZIMUTH,ELLIPTICITY\n"
    "  retarder:FAST_AXIS,RETARDANCE\n"
    "The picture of --compare: a on the left, b on the right, the difference between them, each\n"
    "as four quadrants S3 S1 over S2 S0; the difference is green where b is greater.\n"
    "Examples:\n"
    "  malus-image box.exr --show overlay -o box.png\n"
    "  malus-image box.exr --filter linear:45 -o through.exr\n"
    "  malus-image box.exr --filter retarder:0,90 --filter linear:45 -o right_circular.png\n"
    "  malus-image --compare path.exr vcm.exr -o difference.png";

std::string version() {
  return "malus-image " + std::to_string(MALUS_VERSION_MAJOR) + "." +
         std::to_string(MALUS_VERSION_MINOR) + "." + std::to_string(MALUS_VERSION_PATCH);
}

void add_options(CLI::App& app, ImageOptions& options) {
  std::string shows;
  for (const std::string& name : show_names()) shows += (shows.empty() ? "" : "|") + name;
  app.add_option("input", options.input, "picture to read (.exr)")->type_name("IN.exr");
  app.add_option("-o,--output", options.output,
                 "file to write: .png, or .exr for --filter without --show")
      ->type_name("FILE");
  app.add_option("--show", options.show, "what to make a picture of: " + shows)->type_name("WHAT");
  app.add_option("--filter", options.filters,
                 "hold a filter before the picture (see below); repeat for several, in the order "
                 "the light meets them")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->type_name("FILTER")
      ->allow_extra_args(false);  // what follows one filter may be the input file
  app.add_option(
         "--compare", options.compare,
         "numbers for the difference b - a of two pictures; with -o also a picture (see below)")
      ->expected(2)
      ->type_name("A B");
  app.add_flag("--info", options.info, "print size, channels, metadata and mean Stokes vector");
  app.add_flag("--physical", options.physical,
               "count pixels that are no light: not finite, or of a degree of polarisation above 1 "
               "beyond rounding and, where the file has them, standard errors; exit status 1 if "
               "there are any");
  app.add_flag("--json", options.json, "print --info, --physical or --compare as JSON");
  app.add_option("--channel", options.channel,
                 "use one colour (R, G, B) instead of the mean of all")
      ->type_name("COLOUR");
  app.add_option("--exposure", options.exposure, "brighten by 2^EV before showing (default 0)")
      ->type_name("EV");
  app.add_option("--scale", options.scale,
                 "multiply components and degrees before they are coloured (default 1)")
      ->type_name("K");
  app.add_option("--difference-scale", options.difference_scale,
                 "--scale for the difference in --compare (default: that of --scale)")
      ->type_name("K");
  app.set_version_flag("--version", version());
  app.footer(footer);
}

}  // namespace

int malus_image(int argc, const char* const* argv, std::ostream& out, std::ostream& err) {
  const auto fail = [&err](const char* message, int status) {
    err << "malus-image: " << message << '\n';
    return status;
  };
  CLI::App app(description, "malus-image");
  ImageOptions options;
  try {
    add_options(app, options);
    app.parse(argc, argv);
    const int status = run_image(options, out, err);
    if (!out.flush()) return fail("cannot write to standard output", work_failed);
    return status;
  } catch (const CLI::ParseError& error) {
    // Help and version come as exceptions, too; CLI11's many statuses for errors are one to us.
    return app.exit(error, out, err) == 0 ? 0 : input_wrong;
  } catch (const InputError& error) {
    return fail(error.what(), input_wrong);
  } catch (const std::exception& error) {
    return fail(error.what(), work_failed);
  }
}

}  // namespace renderer
