// SPDX-License-Identifier: MIT
// Adds up pictures of one scene whose samples are independent: each counts by its number of
// samples, so that the sum is the picture of all of them. What is no part of one picture is
// refused.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "../io/image.hpp"

namespace renderer {

struct NamedImage {
  std::string name;  ///< of its file, for messages
  Image image;
};

/// `force` adds up what has samples in common, and what differs in scene or settings, too. Throws
/// InputError that names the files.
Image merge_images(const std::vector<NamedImage>& images, bool force);

/// The program malus-merge.
int malus_merge(int argc, const char* const* argv, std::ostream& out, std::ostream& err);

}  // namespace renderer
