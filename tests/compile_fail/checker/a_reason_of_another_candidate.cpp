// SPDX-License-Identifier: MIT
// expect: swap_the_arguments
// rejected because: the message does not hold the reason
#include "a_reason_of_another_candidate.hpp"

#ifdef MALUS_FAIL
int value = combine(1, 1);
#else
int value = combine(1, 1.0);
#endif
