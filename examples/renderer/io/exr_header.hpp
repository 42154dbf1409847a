// SPDX-License-Identifier: MIT
// OpenEXR sets memory aside for what an attribute in a header claims to take before it reads it:
// sixty bytes can ask for two gigabytes. This looks at the claims first.
#pragma once

#include <string>

namespace renderer {

/// Throws std::runtime_error if an attribute in the headers of an OpenEXR file claims to be longer
/// than what is left of the file, or if the headers don't end in it.
void check_attribute_sizes(const std::string& path);

}  // namespace renderer
