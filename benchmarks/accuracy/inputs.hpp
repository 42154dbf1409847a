// SPDX-License-Identifier: MIT
// Random operands, rounded to a precision.
//
// Two frames of one direction differ by any angle, by almost none or by almost a quarter turn. As
// computed frames are, they are off by up to one unit in the last place a component besides their
// rounding. Matrices are sums of two Jones matrices' (physical, partly depolarising), light is
// partly polarised. Chains are of retarders of any phase in frames of any angle about one
// direction, which leave the degree of polarisation as it is, so that what changes it is rounding.
#pragma once

#include <cstdint>
#include <vector>

#include "request.hpp"

namespace accuracy {

std::vector<Operands> random_operands(std::size_t count, bool is_double, std::uint64_t seed);

/// Of `chains` chains, one after the other.
std::vector<Element> random_chains(std::size_t chains, std::size_t length, bool is_double,
                                   std::uint64_t seed);

}  // namespace accuracy
