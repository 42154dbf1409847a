# SPDX-License-Identifier: MIT
#
# cmake -DSOURCE=case.cpp "-DCOMPILERS=g++;clang++" -DINCLUDE_DIRS=... [-DPRECOMPILED=DIR] [-DEXPECT_REJECTION=ON]
#   -P check_case.cmake
#
# DIR/COMPILER/malus/malus.hpp.gch is used where it is.
#
# With every compiler: the right expression compiles, the wrong one (MALUS_FAIL) does not, and the reason that the line
# `// expect: REASON` names stands in the error or the first note on it. Later notes do not count: they list candidates
# that were not chosen, so that any reason is found in them. A case of the checker's own tests has `// rejected because:
# TEXT` too, and passes if it is rejected for that very cause.
cmake_minimum_required(VERSION 3.25)

function(reject cause)
  if(EXPECT_REJECTION AND source_text MATCHES "\n// rejected because: ([^\n]+)\n")
    string(FIND "${cause}" "${CMAKE_MATCH_1}" position)
    if(NOT position EQUAL -1)
      message(STATUS "Rejected, as it should be: ${cause}")
      return()
    endif()
  endif()
  message(FATAL_ERROR "${source_name}: ${cause}")
endfunction()

# Sets `result`, `output`.
function(compile)
  set(include_flags "")
  set(header "${PRECOMPILED}/${compiler_name}/malus/malus.hpp.gch")
  if(EXISTS "${header}")
    list(PREPEND INCLUDE_DIRS "${PRECOMPILED}/${compiler_name}")
    if(compiler_name MATCHES "clang")
      set(include_flags -include-pch "${header}")
    endif()
  endif()
  foreach(directory IN LISTS INCLUDE_DIRS)
    list(APPEND include_flags -isystem "${directory}")
  endforeach()
  set(ENV{LC_ALL} C)
  execute_process(
    COMMAND "${compiler}" -std=c++20 -fsyntax-only ${include_flags} ${ARGN} "${SOURCE}"
    RESULT_VARIABLE result
    OUTPUT_VARIABLE output
    ERROR_VARIABLE output)
  # The name of the file is no part of the message: it may well hold the reason's words.
  string(REPLACE "${SOURCE}" "case.cpp" output "${output}")
  return(PROPAGATE result output)
endfunction()

cmake_path(GET SOURCE FILENAME source_name)
file(READ "${SOURCE}" source_text)

if(NOT source_text MATCHES "\n// expect: ([^\n]+)\n")
  reject("there is no line '// expect: REASON'")
  return()
endif()
set(reason "${CMAKE_MATCH_1}")

# Compilers quote the line at fault, and the reason must not be found in there.
string(REPLACE "// expect: ${reason}\n" "" code "${source_text}")
string(FIND "${code}" "${reason}" position)
if(NOT position EQUAL -1)
  reject("the code itself holds the reason '${reason}', so the message would prove nothing")
  return()
endif()

foreach(compiler IN LISTS COMPILERS)
  cmake_path(GET compiler FILENAME compiler_name)

  compile()
  if(NOT result STREQUAL "0")
    message("${output}")
    reject("${compiler_name}: the right expression does not compile")
    return()
  endif()

  compile(-DMALUS_FAIL)
  string(REGEX MATCHALL "error: " errors "${output}")
  list(LENGTH errors error_count)
  string(REGEX REPLACE "[^\n]" "" line_ends "${output}")
  string(LENGTH "${line_ends}" line_count)
  message("${compiler_name}: errors: ${error_count}, lines: ${line_count}\n${output}")

  if(result STREQUAL "0")
    reject("${compiler_name}: the wrong expression compiles")
    return()
  endif()
  string(FIND "${output}" ": note: " first_note)
  math(EXPR after_first_note "${first_note} + 1")
  string(SUBSTRING "${output}" ${after_first_note} -1 later_text)
  string(FIND "${later_text}" ": note: " second_note)
  if(second_note EQUAL -1)
    set(length -1)
  else()
    math(EXPR length "${after_first_note} + ${second_note}")
  endif()
  string(SUBSTRING "${output}" 0 ${length} first_diagnostic)
  string(FIND "${first_diagnostic}" "${reason}" position)
  if(position EQUAL -1)
    reject("${compiler_name}: the message does not hold the reason '${reason}'")
    return()
  endif()
endforeach()

if(EXPECT_REJECTION)
  message(FATAL_ERROR "${source_name}: accepted, but it had to be rejected")
endif()
