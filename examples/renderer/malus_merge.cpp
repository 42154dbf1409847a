// SPDX-License-Identifier: MIT
// malus-merge: adds up pictures that were rendered in parts.
#include <iostream>

#include "image/merge.hpp"

int main(int argc, char** argv) { return renderer::malus_merge(argc, argv, std::cout, std::cerr); }
