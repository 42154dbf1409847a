// SPDX-License-Identifier: MIT
#include "command_line.hpp"

#include <tbb/info.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <limits>
#include <map>
#include <new>
#include <optional>
#include <ostream>

#include "../io/atomic_file.hpp"
#include "../io/digest.hpp"
#include "../io/exr.hpp"
#include "../io/exr_name.hpp"
#include "../scene/build.hpp"
#include "../scene/needs.hpp"
#include "../scene/requirements.hpp"
#include "../scene/text.hpp"
#include "../scene/xml_reader.hpp"
#include "checkpoint.hpp"
#include "explain.hpp"
#include "progress_bar.hpp"
#include "statistics.hpp"

namespace renderer {

namespace {

std::atomic<bool> stop_requested{false};
std::atomic<int> stop_signal{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free,
              "a signal handler may set them");

/// The first signal asks for a stop; a second one kills, should the stop take too long.
extern "C" void request_stop(int signal) {
  stop_signal = signal;
  stop_requested = true;
  std::signal(signal, SIG_DFL);
}

std::string version() {
  return std::to_string(MALUS_VERSION_MAJOR) + "." + std::to_string(MALUS_VERSION_MINOR) + "." +
         std::to_string(MALUS_VERSION_PATCH);
}

struct Arguments {
  std::string scene, output, integrator, mode = "auto", stokes_frame = "horizontal", stats;
  std::string sampler = "auto", checkpoint;
  std::vector<std::string> definitions;
  std::vector<int> strategy;
  std::optional<std::uint64_t> samples, seed;
  std::uint64_t first_sample = 0;
  double seconds = 0, checkpoint_every = 60;
  int threads = 0;
  bool explain = false, confined = false, standard_error = false;
};

/// CLI11 would take 010 for 8, 0x10 for 16, and what 64 bits don't hold for the most that they do.
CLI::Validator whole_number(std::uint64_t lowest, std::uint64_t highest, const std::string& type) {
  const std::string range = "in [" + std::to_string(lowest) + " - " + std::to_string(highest) + "]";
  return CLI::Validator(
      [=](std::string& text) -> std::string {
        std::uint64_t value = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc() || end != text.data() + text.size() || value < lowest ||
            value > highest)
          return in_quotes(text) + " is not a whole number " + range;
        text = std::to_string(value);
        return {};
      },
      type.empty() ? "" : type + " " + range);
}

CLI::Validator decimal_number() {
  return CLI::Validator(
      [](std::string& text) {
        return parse_number(text) ? std::string() : in_quotes(text) + " is not a decimal number";
      },
      "");
}

void add_options(CLI::App& app, Arguments& a) {
  app.set_version_flag("--version", version());
  app.add_option("scene", a.scene, "Scene in Mitsuba 3 XML")->required();
  app.add_option("-o,--output", a.output, "OpenEXR file to write (required, but for --explain)")
      ->check(CLI::Validator([](std::string& name) { return problem_of_exr_name(name); }, ""));
  app.add_option(
         "--integrator", a.integrator,
         "Path tracing, light tracing, bidirectional path tracing, progressive or "
         "bidirectional photon mapping, vertex connection and merging (default: the scene's)")
      ->check(
          CLI::IsMember({"path", "volpath", "volpathmis", "ptracer", "bdpt", "ppm", "bpm", "vcm"}));
  app.add_option("--strategy", a.strategy,
                 "Of bdpt, one strategy alone and unweighted: S vertices from the light, T from "
                 "the camera")
      ->delimiter(',')
      ->expected(2)
      ->transform(whole_number(0, 1 << 20, "INT"))
      ->type_name("S,T");
  app.add_option("--mode", a.mode,
                 "auto: follow polarisation where it matters to the picture; or always "
                 "(optimized) or never (unpolarized)")
      ->check(CLI::IsMember({"auto", "unpolarized", "optimized"}))
      ->capture_default_str();
  auto* spp = app.add_option("--spp", a.samples, "Samples a pixel (default: the scene's)")
                  ->transform(whole_number(1, std::uint64_t{1} << 40, "UINT"));
  app.add_option("--time", a.seconds, "Render for so many seconds instead")
      ->check(CLI::Range(1e-3, 1e8))
      ->check(decimal_number())
      ->excludes(spp);
  app.add_option("--seed", a.seed, "Seed of the random numbers (default: the scene's)")
      ->transform(whole_number(0, std::numeric_limits<std::uint64_t>::max(), ""));
  app.add_option("--threads", a.threads, "Threads (default: all processors)")
      ->transform(whole_number(1, 4096, "INT"));
  app.add_option(
         "--sampler", a.sampler,
         "Random numbers: independent, or of scrambled Sobol sequences, which spread a pixel's "
         "samples evenly; auto: sobol where it was found to help")
      ->check(CLI::IsMember({"auto", "independent", "sobol"}))
      ->capture_default_str();
  app.add_option("-D", a.definitions, "Set a parameter of the scene: -D name=value")
      ->take_all()
      ->allow_extra_args(false)  // what follows is the scene
      ->type_name("NAME=VALUE");
  app.add_flag("--confined", a.confined,
               "Refuse scenes that read files outside of their own folder");
  app.add_option(
         "--stokes-frame", a.stokes_frame,
         "Where S1 and S2 are measured from: the picture's horizontal, counter-clockwise, or up")
      ->check(CLI::IsMember({"horizontal", "up"}))
      ->capture_default_str();
  app.add_option("--stats", a.stats,
                 "JSON file of counts, rates and, of a radiancemeter, readings");
  app.add_option("--first-sample", a.first_sample,
                 "Number of the first sample: runs of one seed whose numbers don't overlap are "
                 "parts of one picture, for malus-merge")
      ->transform(whole_number(0, std::uint64_t{1} << 40, "UINT"))
      ->capture_default_str();
  app.add_flag("--standard-error", a.standard_error,
               "Write the components' standard errors too, as SE0.R ... SE3.B");
  app.add_option("--checkpoint", a.checkpoint,
                 "File to go on from, if it is there, and to keep for that until the picture is "
                 "complete");
  app.add_option("--checkpoint-every", a.checkpoint_every, "Seconds between checkpoints")
      ->check(CLI::Range(0.0, 1e8))
      ->check(decimal_number())
      ->capture_default_str();
  app.add_flag("--explain", a.explain,
               "Say what the scene needs of polarisation, media and light paths, and why, instead "
               "of rendering it");
}

/// Enough for an error of the error of a fifth.
constexpr std::size_t batches_for_errors = 16;

std::map<std::string, std::string> parse_definitions(const std::vector<std::string>& texts) {
  std::map<std::string, std::string> definitions;
  for (const std::string& text : texts) {
    const auto equals = text.find('=');
    if (equals == std::string::npos || equals == 0)
      throw InputError("-D " + text + ": expected NAME=VALUE");
    if (!definitions.emplace(text.substr(0, equals), text.substr(equals + 1)).second)
      throw InputError("-D " + text + ": \"" + text.substr(0, equals) + "\" is given twice");
  }
  return definitions;
}

Mode resolve_mode(const std::string& name, const Needs& needs) {
  if (name == "unpolarized") return Mode::unpolarized;
  return name == "optimized" || needs.polarization() ? Mode::optimized : Mode::unpolarized;
}

/// What tells renderings apart whose samples must not be added up.
std::map<std::string, std::string> identity_of(const Scene& scene, const RenderOptions& options,
                                               const Digest& digest) {
  const IntegratorSettings& s = scene.integrator;
  std::map<std::string, std::string> identity{
      {"version", version()},
      {"scene (its files and -D)", digest.text()},
      {"integrator", s.name},
      {"strategy",
       s.strategy ? std::to_string(s.strategy->s) + "," + std::to_string(s.strategy->t) : "all"},
      {"mode", options.mode == Mode::unpolarized ? "unpolarized" : "optimized"},
      {"sampler", name_of(options.sampler)},
      {"seed", std::to_string(options.seed)},
      {"first sample", std::to_string(options.first_sample)},
      {"number of batches", std::to_string(options.batches)}};
  return identity;
}

/// The elements whose polarisation `auto` doesn't follow.
std::size_t count_skipped(const Needs& needs, Mode mode) {
  if (mode == Mode::unpolarized) return needs.elements.size();
  return static_cast<std::size_t>(std::count_if(
      needs.elements.begin(), needs.elements.end(),
      [](const auto& e) { return !e.matters && e.kind != PolarizingElement::Kind::extinction; }));
}

SamplerKind resolve_sampler(const std::string& name, const Scene& scene) {
  if (name == "independent") return SamplerKind::independent;
  if (name == "sobol") return SamplerKind::sobol;
  return suited_sampler(scene);
}

void add_metadata(Image& image, const Arguments& a, const Scene& scene,
                  const RenderOptions& options, const Rendering& rendering, const Digest& digest) {
  auto& m = image.metadata;
  m["malus:version"] = version();
  m["malus:scene"] = digest.text();
  m["malus:samples"] = std::to_string(options.seed) + ":" + std::to_string(options.first_sample) +
                       "+" + std::to_string(rendering.samples_per_pixel);
  m["malus:stokes_frame"] = a.stokes_frame;
  m["malus:stokes_convention"] =
      a.stokes_frame == "horizontal"
          ? "S1 > 0 horizontal, S2 > 0 at +45 degrees counter-clockwise, S3 > 0 right circular, "
            "seen "
            "in the picture"
          : "S1 > 0 vertical, S2 > 0 at +45 degrees counter-clockwise from vertical, S3 > 0 right "
            "circular, seen in the picture";
  m["malus:mode"] = options.mode == Mode::unpolarized ? "unpolarized" : "optimized";
  m["malus:integrator"] = scene.integrator.name;
  m["malus:samples_per_pixel"] = std::to_string(rendering.samples_per_pixel);
  m["malus:seed"] = std::to_string(options.seed);
  if (const auto& strategy = scene.integrator.strategy)
    m["malus:strategy"] = std::to_string(strategy->s) + "," + std::to_string(strategy->t);
  m["malus:sampler"] = name_of(options.sampler);
}

bool are_one_place(const std::string& a, const std::string& b) {
  std::error_code failed;
  const auto place = std::filesystem::weakly_canonical(a, failed);
  return !failed && place == std::filesystem::weakly_canonical(b, failed) && !failed;
}

/// Nothing that is written may stand where something else of the same run is.
void check_outputs(const Arguments& a) {
  if (std::isnan(a.seconds)) throw InputError("--time: nan is not a number of seconds");
  if (a.explain) return;
  if (a.output.empty()) throw InputError("-o: the name of an OpenEXR file to write is required");
  struct Use {
    const char* option;
    const std::string& file;
    const char* what;
  };
  const Use uses[] = {{"", a.scene, "the scene is read from there"},
                      {"-o ", a.output, "the picture is to be written there"},
                      {"--stats ", a.stats, "--stats is to be written there"},
                      {"--checkpoint ", a.checkpoint, ""}};
  for (const Use* use = uses + 1; use != std::end(uses); ++use) {
    if (use->file.empty()) continue;
    for (const Use* other = uses; other != use; ++other)
      if (!other->file.empty() && are_one_place(use->file, other->file))
        throw InputError(use->option + use->file + ": " + other->what);
  }
  check_writable(a.output);
  if (!a.stats.empty()) check_writable(a.stats);
}

int render_command(const Arguments& a, std::ostream& out, std::ostream& err) {
  const auto definitions = parse_definitions(a.definitions);
  check_outputs(a);
  Digest digest;
  for (const auto& [name, value] : definitions) {
    digest.add(name);
    digest.add(value);
  }
  const auto outside = a.confined ? OutsideFiles::refuse : OutsideFiles::warn;
  Scene scene = [&] {
    const DigestOfReading reading(digest);
    return build_scene(*read_scene(a.scene, definitions, outside));
  }();
  if (!a.integrator.empty()) set_integrator(scene.integrator, a.integrator);
  if (!a.strategy.empty()) scene.integrator.strategy = Strategy{a.strategy[0], a.strategy[1]};
  check_requirements(scene, a.scene);
  for (const std::string& warning : scene.warnings) err << "warning: " << warning << '\n';

  const Needs needs = find_needs(scene);
  RenderOptions options;
  options.mode = resolve_mode(a.mode, needs);
  if (a.explain) {
    out << explanation(scene, needs, a.mode, options.mode, a.scene);
    return 0;
  }
  if (a.mode == "auto" && options.mode == Mode::optimized) skip_what_is_not_needed(needs, scene);
  options.stores_polarization = a.mode != "auto" || needs.stored_polarization();
  options.samples_per_pixel =
      a.samples.value_or(static_cast<std::uint64_t>(scene.samples_per_pixel));
  options.seconds = a.seconds;
  options.seed = a.seed.value_or(scene.seed);
  options.sampler = resolve_sampler(a.sampler, scene);
  options.threads = a.threads;
  options.first_sample = a.first_sample;
  if (a.standard_error) options.batches = batches_for_errors;
  std::optional<Checkpoint> checkpoint;
  if (!a.checkpoint.empty())
    options.checkpoint =
        &checkpoint.emplace(a.checkpoint, a.checkpoint_every, identity_of(scene, options, digest));

  stop_requested = false;
  std::signal(SIGINT, request_stop);
  std::signal(SIGTERM, request_stop);
  const Rendering rendering = [&] {
    ProgressBar bar;
    return render(scene, options, stop_requested, [&](const Progress& p) { bar.show(p); });
  }();

  const StokesFrame frame = a.stokes_frame == "up" ? StokesFrame::up : StokesFrame::horizontal;
  Image image = rendering.film.image(frame, a.standard_error);
  add_metadata(image, a, scene, options, rendering, digest);
  write_exr(a.output, image);
  if (!a.stats.empty()) {
    const int threads = a.threads > 0 ? a.threads : tbb::info::default_concurrency();
    auto json = statistics(scene, options, rendering, frame, threads);
    json["scene"] = a.scene;
    json["polarizing_elements"] = needs.elements.size();
    json["skipped_elements"] = a.mode == "auto" ? count_skipped(needs, options.mode) : 0;
    write_file(a.stats, json.dump(2) + "\n");
  }
  if (rendering.counters.non_finite > 0)
    err << "warning: " << rendering.counters.non_finite << " of " << rendering.counters.samples
        << " samples were not finite and were dropped\n";
  if (checkpoint && !checkpoint->failure().empty())
    err << "warning: the checkpoint: " << checkpoint->failure() << '\n';
  if (rendering.interrupted) {
    err << "interrupted: wrote what there was, " << rendering.samples_per_pixel
        << " samples a pixel and a part of the next\n";
    return 128 + stop_signal;
  }
  if (checkpoint) checkpoint->remove();
  out << a.output << ": " << image.width << " x " << image.height << ", "
      << rendering.samples_per_pixel << " samples a pixel, " << rendering.seconds << " s\n";
  return 0;
}

}  // namespace

int malus_render(int argc, const char* const* argv, std::ostream& out, std::ostream& err) {
  CLI::App app("Renders a scene with polarised light.", "malus-render");
  Arguments arguments;
  add_options(app, arguments);
  try {
    app.parse(argc, argv);
    return render_command(arguments, out, err);
  } catch (const CLI::Success& e) {
    return app.exit(e, out, err);
  } catch (const CLI::ParseError& e) {
    err << "malus-render: " << e.what() << '\n';
    return 2;
  } catch (const InputError& e) {
    err << "malus-render: " << e.what() << '\n';
    return 2;
  } catch (const std::bad_alloc&) {
    err << "malus-render: out of memory\n";
    return 1;
  } catch (const std::exception& e) {
    err << "malus-render: " << e.what() << '\n';
    return 1;
  }
}

}  // namespace renderer
