// SPDX-License-Identifier: MIT
// malus-image: pictures of, and answers about, a rendered polarised image.
#include <iostream>

#include "image/command_line.hpp"

int main(int argc, char** argv) { return renderer::malus_image(argc, argv, std::cout, std::cerr); }
