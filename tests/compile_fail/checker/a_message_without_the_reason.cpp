// SPDX-License-Identifier: MIT
// expect: call_propagate_first
// rejected because: the message does not hold the reason
#ifdef MALUS_FAIL
int value = no_such_name;
#else
int value = 2;
#endif
