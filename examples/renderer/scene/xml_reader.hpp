// SPDX-License-Identifier: MIT
// Reads a scene in Mitsuba 3's XML into a tree of objects: parameters, includes, references and
// aliases resolved, every value parsed and checked. What plugins exist and what they take is the
// factories' affair. Wherever Mitsuba ignores or guesses, this is an InputError with file and line.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "object.hpp"

namespace renderer {

/// `definitions` are the command line's -D name=value; each must be used by the scene. `outside` is
/// what becomes of files that lie outside of the scene's folder.
std::shared_ptr<const Object> read_scene(const std::filesystem::path& path,
                                         const std::map<std::string, std::string>& definitions,
                                         OutsideFiles outside = OutsideFiles::warn);

}  // namespace renderer
