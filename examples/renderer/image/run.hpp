// SPDX-License-Identifier: MIT
// One run of malus-image, from its options to its output. Throws InputError for what the user got
// wrong and WorkError for what could not be done.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace renderer {

/// The braces let a designated initializer name only what it sets, without a warning.
struct ImageOptions {
  std::string input{};
  std::string output{};
  std::string show{};                  // a name of show_names(), or empty
  std::string channel{};               // one colour instead of the mean of all, or empty
  std::vector<std::string> filters{};  // as parse_filter takes them
  std::vector<std::string> compare{};  // two files, or none
  float exposure = 0;
  float scale = 1;
  float difference_scale = 0;  // 0: as scale
  bool info = false;
  bool physical = false;
  bool json = false;
};

/// Results go to `out`, remarks on them to `err`; the exit status.
int run_image(const ImageOptions& options, std::ostream& out, std::ostream& err);

}  // namespace renderer
