// SPDX-License-Identifier: MIT
// What is wrong in a mesh or picture is told with that file and its line; whose scene it is has to
// know besides which of its elements asks for it.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "../io/input_error.hpp"

namespace renderer {

/// What `read` gives. An InputError of it names `asker` as well, unless it begins with it.
template <class Read>
auto read_for(const Location& asker, Read&& read) {
  try {
    return std::forward<Read>(read)();
  } catch (const InputError& error) {
    const std::string_view problem = error.what();
    const std::string place = asker.file + ":" + std::to_string(asker.line);
    if (problem.starts_with(place + ": ")) throw;
    throw InputError(std::string(problem) + " (asked for in " + place + ")");
  }
}

}  // namespace renderer
