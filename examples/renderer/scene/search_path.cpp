// SPDX-License-Identifier: MIT
#include "search_path.hpp"

#include <algorithm>
#include <system_error>

#include "text.hpp"

namespace renderer {
namespace {

std::filesystem::path whole_path(const std::filesystem::path& path) {
  std::error_code ignored;
  const auto whole =
      std::filesystem::weakly_canonical(std::filesystem::absolute(path, ignored), ignored);
  return ignored ? path : whole;
}

bool is_within(const std::filesystem::path& file, const std::filesystem::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first ==
         folder.end();
}

}  // namespace

Premises::Premises(const std::filesystem::path& scene, OutsideFiles outside)
    : folder_(whole_path(std::filesystem::absolute(scene).parent_path())), outside_(outside) {}

void Premises::enter(const std::filesystem::path& file, const Location& asker) {
  const auto whole = whole_path(file);
  if (is_within(whole, folder_) || !seen_.insert(whole).second) return;
  const std::string message = "the file " + in_quotes(whole.string()) +
                              " is outside of the scene's folder, " + in_quotes(folder_.string());
  if (outside_ == OutsideFiles::refuse)
    throw InputError(asker, message + "; allowed with --confined: files inside of it");
  warnings_.push_back(asker.file + ":" + std::to_string(asker.line) + ": " + message);
}

std::filesystem::path SearchPath::find(const std::filesystem::path& name,
                                       const std::filesystem::path& own_folder) const {
  if (name.is_absolute()) return name;
  for (const std::filesystem::path& folder : folders_) {
    std::error_code ignored;
    if (std::filesystem::exists(folder / name, ignored)) return folder / name;
  }
  return own_folder / name;
}

std::filesystem::path SearchPath::find_to_read(const std::filesystem::path& name,
                                               const Location& asker) const {
  const auto file = find(name, std::filesystem::path(asker.file).parent_path());
  premises_->enter(file, asker);
  return file;
}

}  // namespace renderer
