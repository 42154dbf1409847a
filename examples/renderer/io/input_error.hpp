// SPDX-License-Identifier: MIT
// What the user gave is wrong: says where, which value, and what is allowed. Programs answer it
// with exit status 2.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace renderer {

/// A place in a file the user wrote; line 0 means the whole file.
struct Location {
  std::string file;
  int line = 0;
};

class InputError : public std::runtime_error {
 public:
  explicit InputError(const std::string& message) : std::runtime_error(message) {}
  InputError(const Location& where, const std::string& message)
      : std::runtime_error(prefix(where) + message) {}

 private:
  static std::string prefix(const Location& where) {
    if (where.file.empty()) return {};
    if (where.line <= 0) return where.file + ": ";
    return where.file + ":" + std::to_string(where.line) + ": ";
  }
};

/// The user's input is fine but the work could not be done (no space, no permission). Exit
/// status 1.
class WorkError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace renderer
