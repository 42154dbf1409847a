# SPDX-License-Identifier: MIT
#
# cmake -DERROR_HEADER=.../malus/error.hpp -DCASES=... -P check_coverage.cmake: every reason that the library has for not
# compiling is expected by one of the cases.
cmake_minimum_required(VERSION 3.25)

file(STRINGS "${ERROR_HEADER}" reasons REGEX "^struct [a-z_]+;")
if(NOT reasons)
  message(FATAL_ERROR "No reasons found in ${ERROR_HEADER}")
endif()
list(TRANSFORM reasons REPLACE "^struct ([a-z_]+);.*" "\\1")

set(expected "")
foreach(case IN LISTS CASES)
  file(STRINGS "${case}" expectations REGEX "^// expect: ")
  list(APPEND expected ${expectations})
endforeach()
list(TRANSFORM expected REPLACE "^// expect: " "")

list(REMOVE_ITEM reasons ${expected})
if(reasons)
  message(FATAL_ERROR "Reasons without a case: ${reasons}")
endif()
