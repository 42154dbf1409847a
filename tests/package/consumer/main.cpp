// SPDX-License-Identifier: MIT
// Horizontally polarised light through a polarizer that stands vertical and through one that stands
// horizontal.
#include <malus/malus.hpp>

#include <cstdlib>

struct Laboratory;
using Bench = malus::StaticFrame<Laboratory>;
using Light = malus::Stokes<float, malus::exitant, Bench>;
using Element = malus::Mueller<float, malus::exitant, malus::exitant, Bench>;

int main() {
  const Light light(1, 1, 0, 0);
  const Element horizontal =
      Element::from_rows({{{0.5f, 0.5f, 0, 0}, {0.5f, 0.5f, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}}});
  const Element vertical =
      Element::from_rows({{{0.5f, -0.5f, 0, 0}, {-0.5f, 0.5f, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}}});
  const bool passes = (horizontal * light).intensity() == 1.0f;
  const bool blocks = (vertical * light).intensity() == 0.0f;
  return passes && blocks ? EXIT_SUCCESS : EXIT_FAILURE;
}
