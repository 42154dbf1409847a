// SPDX-License-Identifier: MIT
// malus-image's command line: parses it, runs it, and turns every failure into one line and an exit
// status: 2 if the user's input is wrong, 1 if the work could not be done.
#pragma once

#include <iosfwd>

namespace renderer {

int malus_image(int argc, const char* const* argv, std::ostream& out, std::ostream& err);

}  // namespace renderer
