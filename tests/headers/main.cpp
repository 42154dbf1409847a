// SPDX-License-Identifier: MIT
// The headers' own translation units stand beside this one; that the program links is the test.
#include <malus/malus.hpp>

int main() {}
