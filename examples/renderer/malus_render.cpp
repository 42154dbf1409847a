// SPDX-License-Identifier: MIT
// malus-render: renders a scene in Mitsuba 3's XML with polarised light.
#include <iostream>

#include "render/command_line.hpp"

int main(int argc, char** argv) { return renderer::malus_render(argc, argv, std::cout, std::cerr); }
