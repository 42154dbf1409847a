# SPDX-License-Identifier: MIT
#
# cmake -DPROGRAM=... -DPREFIX=... -DOUTPUT=... -P discover_tests.cmake: writes one add_test for every test case of a doctest
# program. doctest's own script does the same, but loses names that hold a bracket or a semicolon.
cmake_minimum_required(VERSION 3.25)

execute_process(COMMAND "${PROGRAM}" --list-test-cases --no-colors=true
  OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)

# Characters that mean something in a list, by others that no name holds.
string(ASCII 1 open)
string(ASCII 2 close)
string(ASCII 3 semicolon)
string(REPLACE "[" "${open}" output "${output}")
string(REPLACE "]" "${close}" output "${output}")
string(REPLACE ";" "${semicolon}" output "${output}")
string(REPLACE "\n" ";" names "${output}")
list(FILTER names EXCLUDE REGEX "^${open}doctest${close}|^===|^$")
list(REMOVE_DUPLICATES names)

set(script "")
foreach(name IN LISTS names)
  # A comma in doctest's filters is between two of them.
  string(REPLACE "," "\\," filter "${name}")
  string(APPEND script
    "add_test([==[${PREFIX}:${name}]==] [==[${PROGRAM}]==] [==[--test-case=${filter}]==])\n"
    # RapidCheck draws from a fixed seed, so that a run can be repeated.
    "set_tests_properties([==[${PREFIX}:${name}]==] PROPERTIES ENVIRONMENT RC_PARAMS=seed=1808 TIMEOUT 300)\n")
endforeach()
string(REPLACE "${open}" "[" script "${script}")
string(REPLACE "${close}" "]" script "${script}")
string(REPLACE "${semicolon}" ";" script "${script}")
file(WRITE "${OUTPUT}" "${script}")
