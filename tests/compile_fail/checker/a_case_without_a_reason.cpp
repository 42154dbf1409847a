// SPDX-License-Identifier: MIT
// rejected because: there is no line
#ifdef MALUS_FAIL
int value = no_such_name;
#else
int value = 2;
#endif
