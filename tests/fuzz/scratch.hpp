// SPDX-License-Identifier: MIT
// What the fuzzers share: a folder of their own for the files that readers want, and what a reader
// may do with bytes that anybody could have written: read them, or refuse them with an InputError
// that says where. Anything else that is thrown ends the fuzzer, and so is found.
#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "io/input_error.hpp"

namespace fuzz {

inline std::string_view text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// A folder under TMPDIR that goes with the process; the working folder from then on, so that
/// what a name without a folder means is in it.
class Scratch {
 public:
  Scratch()
      : folder_(std::filesystem::temp_directory_path() /
                ("malus-fuzz-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_);
    std::filesystem::current_path(folder_);
  }
  ~Scratch() {
    std::error_code ignored;
    std::filesystem::current_path("/", ignored);
    std::filesystem::remove_all(folder_, ignored);
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  const std::filesystem::path& folder() const { return folder_; }

  /// Copies a folder's files into this one, over what is there.
  void copy_from(const std::filesystem::path& source) const {
    for (const auto& file : std::filesystem::directory_iterator(source))
      std::filesystem::copy_file(file.path(), folder_ / file.path().filename(),
                                 std::filesystem::copy_options::overwrite_existing);
  }
  void clear() const {
    for (const auto& file : std::filesystem::directory_iterator(folder_))
      std::filesystem::remove_all(file.path());
  }

  /// Writes a file of that name, over the one before.
  std::filesystem::path write(const std::string& name, std::string_view bytes) const {
    const auto path = folder_ / name;
    std::ofstream(path, std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return path;
  }

 private:
  std::filesystem::path folder_;
};

/// `read()` may throw an InputError that begins with the file's name, and nothing else.
template <class Read>
void expect_read_or_refused(const std::filesystem::path& path, const Read& read) {
  try {
    read();
  } catch (const renderer::InputError& refusal) {
    const std::string_view message = refusal.what();
    if (message.starts_with(path.string() + ":")) return;
    std::fprintf(stderr, "this error doesn't say which file it is about: %s\n", refusal.what());
    std::abort();
  }
}

}  // namespace fuzz
