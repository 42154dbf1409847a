// SPDX-License-Identifier: MIT
// What --explain prints: which code a scene will run through, and why.
#pragma once

#include <string>

#include "../scene/needs.hpp"
#include "render_options.hpp"

namespace renderer {

/// `asked` is the mode by its name on the command line, `mode` what comes of it; `file` the
/// scene's.
std::string explanation(const Scene& scene, const Needs& needs, const std::string& asked, Mode mode,
                        const std::string& file);

}  // namespace renderer
