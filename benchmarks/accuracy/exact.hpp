// SPDX-License-Identifier: MIT
// The operations by their textbook formulas in quadruple precision (where the compiler has none,
// long double), without the library: what the results of a precision are compared with. Operands
// are taken as they were rounded; the rotation between two frames is the proper one that their axes
// give, whatever their lengths.
#pragma once

#include <vector>

#include "request.hpp"

namespace accuracy {

#if defined(__SIZEOF_FLOAT128__)
using Exact = __float128;
#else
using Exact = long double;
#endif

/// As request.results has them, of one operand; of a chain, of its elements too.
std::vector<Exact> compute_exactly(Operation operation, const Operands& operands,
                                   const Element* elements, std::size_t chain_length);

}  // namespace accuracy
