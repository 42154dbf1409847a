// SPDX-License-Identifier: MIT
// One long chain of random elements that light goes through, by the library in a precision and by
// the textbook formulas in long double, side by side.
//
// Every element is a new one, of random parameters that the precision holds exactly, in random
// frames whose axes are off by their rounding, as computed frames are. (A pool of elements, used
// again and again, would repeat its roundings and grow errors like n where they grow like √n.) The
// reference takes parameters and axes as they were rounded; the rotation between two frames is the
// proper one that their axes give.
#pragma once

#include <cstdint>
#include <vector>

namespace stability {

enum class Kind {
  rotations,  ///< into frames of any angle
  undivided,  ///< the same without the division by c² + s², for comparison: not the library's
  retarders,  ///< linear ones of any phase
  fresnel,    ///< reflections at dielectrics and conductors
  rayleigh,   ///< scattering with a depolarisation factor of 0…0.3
  full,       ///< a diattenuator, an elliptical retarder and a depolarizer, as one full matrix
};
inline constexpr const char* kind_names[] = {
    "rotations", "rotations, undivided", "retarders", "Fresnel", "Rayleigh", "full"};

/// How far off light is behind so many elements.
struct Error {
  double relative = 0;  ///< the largest component's, over the exact intensity
  double degree = 0;    ///< of the degree of polarisation, relative
};

struct Chain {
  std::vector<Error> error;      ///< at the checkpoints up to its length
  std::uint64_t states = 0;      ///< of light, one behind each element
  std::uint64_t beyond_one = 0;  ///< of these: with a degree of polarisation above 1 …
  double largest_degree = 0;     ///< … the largest
  std::uint64_t negative = 0;    ///< with an intensity below 0
  std::uint64_t not_finite = 0;
};

/// Where a chain is looked at: 10, 32, 100, … up to a length.
std::vector<std::uint64_t> checkpoints(std::uint64_t length);

Chain run_chain(Kind kind, bool is_double, std::uint64_t length, std::uint64_t seed);

}  // namespace stability
