// SPDX-License-Identifier: MIT
// expect: call_propagate_first
// rejected because: the code itself holds the reason
#ifdef MALUS_FAIL
int value = no_such_name;  // call_propagate_first
#else
int value = 2;
#endif
