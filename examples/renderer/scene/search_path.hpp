// SPDX-License-Identifier: MIT
// Where the names of files in a scene are looked up, and what a scene may read: what lies in the
// folder of its own file. Names that lead out of it (absolute ones, "..", links) are a stranger's
// way to other files, or a user's to a shared folder of textures; so they are read with a warning,
// or refused if the user wants that.
#pragma once

#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "../io/input_error.hpp"

namespace renderer {

enum class OutsideFiles { warn, refuse };

/// The folder of a scene's own file, and what was read from elsewhere.
class Premises {
 public:
  Premises(const std::filesystem::path& scene, OutsideFiles outside);

  /// Notes that `asker` names this file: warns (once a file) or throws an InputError if it is
  /// outside.
  void enter(const std::filesystem::path& file, const Location& asker);

  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  std::filesystem::path folder_;  // canonical
  OutsideFiles outside_;
  std::set<std::filesystem::path> seen_;
  std::vector<std::string> warnings_;
};

/// Folders in which a file's names are looked up, first to last; the first is the file's own.
class SearchPath {
 public:
  explicit SearchPath(std::shared_ptr<Premises> premises) : premises_(std::move(premises)) {}

  void put_first(const std::filesystem::path& folder) { folders_.insert(folders_.begin(), folder); }

  /// The first of the folders that has it; where none does, the name in `own_folder`.
  std::filesystem::path find(const std::filesystem::path& name,
                             const std::filesystem::path& own_folder) const;
  /// The same of a file that is to be read.
  std::filesystem::path find_to_read(const std::filesystem::path& name,
                                     const Location& asker) const;

 private:
  std::vector<std::filesystem::path> folders_;
  std::shared_ptr<Premises> premises_;
};

}  // namespace renderer
