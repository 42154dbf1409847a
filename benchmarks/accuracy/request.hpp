// SPDX-License-Identifier: MIT
// What the program asks of the operations, which are compiled with several flags: numbers alone, so
// that nothing of the library is shared between them. All numbers are doubles that the precision
// at hand holds exactly.
#pragma once

#include <cstddef>

namespace accuracy {

inline constexpr std::size_t channels = 3;

enum class Operation {
  coefficients,     ///< of the rotation between two frames
  rotate_stokes,    ///< into another frame
  mueller_stokes,   ///< full matrix, in another frame than the light's
  mueller_mueller,  ///< full matrices, with a rotation between them
  dielectric,       ///< Fresnel's reflection
  conductor,
  chain,  ///< light through many blocks, each in frames of its own
};

/// How the double angle between two frames is found, c and s being the cosine and sine of the
/// angle as the axes give them.
enum class Turning {
  divided,    ///< (c² − s², 2cs)/(c² + s²), by one division and two products: the library's
  quotients,  ///< the same by two divisions
  undivided,  ///< (c² − s², 2cs)
  angles,     ///< atan2, cos and sin
};

struct Axes {
  double x[3], y[3];
};

struct Operands {
  Axes from, to;
  double light[4][channels];
  double left[16][channels], right[16][channels];  ///< matrices by rows
  double cosine, eta;                              ///< of a dielectric
  double metal_eta[channels], metal_k[channels];
};

/// A block between two frames of a chain.
struct Element {
  Axes enter, exit;
  double upper[4][channels], lower[4][channels];
};

struct Request {
  Operation operation;
  Turning turning;
  bool is_double;
  const Operands* operands;
  std::size_t count;
  const Element* elements;  ///< of chains, one after the other
  std::size_t chain_length;
  /// Of all operands, or all chains. Null: only the time is asked for.
  double* results;
  double seconds;  ///< to measure for
  /// Where in memory operands start, in their own size: some places happen to cost more.
  std::size_t shift;
};

/// How many results an operand (a chain) has: rotations cos 2φ, sin 2φ; light by component, then
/// channel; matrices by rows.
constexpr std::size_t result_count(Operation operation) {
  switch (operation) {
    case Operation::coefficients:
      return 2;
    case Operation::mueller_mueller:
      return 16 * channels;
    case Operation::dielectric:
    case Operation::conductor:
      return 8 * channels;
    default:
      return 4 * channels;
  }
}

/// Fills the results in and gives the nanoseconds that one operation takes (of a chain, one
/// element).
using Entry = double (*)(const Request&);

}  // namespace accuracy
