// SPDX-License-Identifier: MIT
// expect: undeclared_name
// rejected because: the right expression does not compile
#ifdef MALUS_FAIL
int value = 1;
#else
int value = no_such_name;
#endif
