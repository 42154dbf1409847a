// SPDX-License-Identifier: MIT
// What main() of every benchmark with options does: reads them, runs, and says in one line why it
// could not. Exit status 2 of what was asked for wrongly, 1 of what failed at work.
#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "io/input_error.hpp"

namespace benchmarks {

/// CLI11's ranges let it pass.
inline void reject_nan(const char* option, double value) {
  if (std::isnan(value)) throw renderer::InputError(std::string(option) + ": nan is no number");
}

/// Which scenes a benchmark renders: those of the names, NAME.xml in the folder.
inline void add_scene_options(CLI::App& app, std::vector<std::string>& names, std::string& folder) {
  app.add_option("--scene", names, "Names of scenes")->capture_default_str();
  app.add_option("--scenes", folder, "Folder of the scenes")->check(CLI::ExistingDirectory);
}

/// `run` is called with the options read, and gives the exit status.
template <class Run>
int run_program(CLI::App& app, int argc, char** argv, Run&& run) {
  try {
    app.parse(argc, argv);
    return run();
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? EXIT_SUCCESS : 2;
  } catch (const renderer::InputError& e) {
    std::cerr << app.get_name() << ": " << e.what() << '\n';
    return 2;
  } catch (const std::exception& e) {
    std::cerr << app.get_name() << ": " << e.what() << '\n';
    return EXIT_FAILURE;
  }
}

}  // namespace benchmarks
