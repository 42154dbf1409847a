// SPDX-License-Identifier: MIT
// malus-render's command line: parses it, renders, and turns every failure into one line and an
// exit status: 2 if the user's input is wrong, 1 if the work could not be done, 130 if the user
// stopped it (what there was is then written).
#pragma once

#include <iosfwd>

namespace renderer {

int malus_render(int argc, const char* const* argv, std::ostream& out, std::ostream& err);

}  // namespace renderer
