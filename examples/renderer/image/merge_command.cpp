// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <exception>
#include <malus/config.hpp>
#include <ostream>

#include "../io/atomic_file.hpp"
#include "../io/exr.hpp"
#include "../io/exr_name.hpp"
#include "../io/input_error.hpp"
#include "merge.hpp"

namespace renderer {

int malus_merge(int argc, const char* const* argv, std::ostream& out, std::ostream& err) {
  const auto fail = [&err](const char* message, int status) {
    err << "malus-merge: " << message << '\n';
    return status;
  };
  CLI::App app(
      "Adds up pictures of one scene that malus-render made with different seeds, or with one "
      "seed\n"
      "and different --first-sample, by their numbers of samples.",
      "malus-merge");
  std::vector<std::string> inputs;
  std::string output;
  bool force = false;
  app.add_option("inputs", inputs, "Pictures to add up")->required()->type_name("IN.exr");
  app.add_option("-o,--output", output, "OpenEXR file to write")->required()->type_name("OUT.exr");
  app.add_flag("--force", force,
               "Merge samples that are in several pictures, and pictures of other scenes, settings "
               "or versions, too");
  app.set_version_flag("--version", "malus-merge " + std::to_string(MALUS_VERSION_MAJOR) + "." +
                                        std::to_string(MALUS_VERSION_MINOR) + "." +
                                        std::to_string(MALUS_VERSION_PATCH));
  try {
    app.parse(argc, argv);
    if (const std::string problem = problem_of_exr_name(output); !problem.empty())
      throw InputError("-o: " + problem);
    check_writable(output);
    std::vector<NamedImage> images;
    for (const std::string& input : inputs) images.push_back({input, read_exr(input)});
    const Image merged = merge_images(images, force);
    write_exr(output, merged);
    out << output << ": " << merged.width << " x " << merged.height << ", "
        << merged.metadata.at("malus:samples_per_pixel") << " samples a pixel of " << inputs.size()
        << (inputs.size() == 1 ? " picture\n" : " pictures\n");
    return 0;
  } catch (const CLI::ParseError& error) {
    return app.exit(error, out, err) == 0 ? 0 : 2;
  } catch (const InputError& error) {
    return fail(error.what(), 2);
  } catch (const std::bad_alloc&) {
    return fail("out of memory", 1);
  } catch (const std::exception& error) {
    return fail(error.what(), 1);
  }
}

}  // namespace renderer
