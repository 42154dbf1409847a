// SPDX-License-Identifier: MIT
// Command lines, an argument a line: the first byte says whether they are malus-render's or
// malus-image's. A scene and a picture lie in the working folder. Arguments that could name
// anything outside of it are left out, and --explain is added, so that nothing long is rendered.
#include <algorithm>
#include <sstream>
#include <vector>

#include "image/command_line.hpp"
#include "render/command_line.hpp"
#include "scratch.hpp"

namespace {

std::vector<std::string> arguments_of(std::string_view bytes) {
  std::vector<std::string> arguments;
  std::istringstream lines{std::string(bytes)};
  for (std::string line; std::getline(lines, line);) {
    line.erase(std::find(line.begin(), line.end(), '\0'), line.end());
    const bool stays_here = line.find('/') == std::string::npos && line != "..";
    if (stays_here && arguments.size() < 32) arguments.push_back(line);
  }
  return arguments;
}

void expect_known_status(int status, const std::string& errors) {
  const bool is_known = status == 0 || status == 1 || status == 2;
  if (is_known && (status == 0 || !errors.empty())) return;
  std::fprintf(stderr, "exit status %d with the message \"%s\"\n", status, errors.c_str());
  std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Scratch scratch;
  static unsigned runs = 0;
  if (size == 0) return 0;
  // Outputs may have been written over what is there, under any name.
  if (runs++ % 16 == 0) {
    scratch.clear();
    scratch.copy_from(MALUS_FUZZ_COMPANIONS);
  }
  const bool renders = data[0] % 2 == 0;
  std::vector<std::string> arguments = arguments_of(fuzz::text_of(data + 1, size - 1));
  arguments.insert(arguments.begin(), renders ? "malus-render" : "malus-image");
  if (renders) arguments.emplace_back("--explain");
  std::vector<const char*> pointers;
  for (const std::string& argument : arguments) pointers.push_back(argument.c_str());
  std::ostringstream out, err;
  const int count = static_cast<int>(pointers.size());
  const int status = renders ? renderer::malus_render(count, pointers.data(), out, err)
                             : renderer::malus_image(count, pointers.data(), out, err);
  expect_known_status(status, err.str());
  return 0;
}
