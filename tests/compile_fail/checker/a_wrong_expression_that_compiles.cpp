// SPDX-License-Identifier: MIT
// expect: deleted
// rejected because: the wrong expression compiles
#ifdef MALUS_FAIL
int value = 1 + 1;
#else
int value = 2;
#endif
