# SPDX-License-Identifier: MIT
#
# Installs Malus to a scratch prefix, moves that elsewhere (an installed tree must not remember where it was), builds
# consumer/ against it by WAY and runs the result.
cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

set(consumer_dir "${CMAKE_CURRENT_LIST_DIR}/consumer")
set(prefix "${SCRATCH_DIR}/a prefix")
set(build_dir "${SCRATCH_DIR}/build")
file(REMOVE_RECURSE "${SCRATCH_DIR}")

if(NOT WAY STREQUAL "add_subdirectory")
  run("${CMAKE_COMMAND}" --install "${MALUS_BINARY_DIR}" --prefix "${SCRATCH_DIR}/first")
  file(RENAME "${SCRATCH_DIR}/first" "${prefix}")

  file(GLOB_RECURSE offered RELATIVE "${MALUS_SOURCE_DIR}/include" "${MALUS_SOURCE_DIR}/include/*.hpp")
  file(GLOB_RECURSE installed RELATIVE "${prefix}/include" "${prefix}/include/*")
  if(NOT offered STREQUAL installed OR NOT installed)
    message(FATAL_ERROR "Installed headers: ${installed}\nThe library's headers: ${offered}")
  endif()
endif()

if(WAY STREQUAL "pkg_config")
  set(ENV{PKG_CONFIG_PATH} "${prefix}/share/pkgconfig")
  run(pkg-config --exact-version=${MALUS_VERSION} malus)
  execute_process(COMMAND pkg-config --cflags malus
    OUTPUT_VARIABLE flags OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  separate_arguments(flags UNIX_COMMAND "${flags}")
  file(MAKE_DIRECTORY "${build_dir}")
  run("${COMPILER}" -std=c++20 ${flags} "${consumer_dir}/main.cpp" -o "${build_dir}/consumer")
else()
  run("${CMAKE_COMMAND}" -S "${consumer_dir}" -B "${build_dir}" -G "${GENERATOR}"
    "-DCMAKE_CXX_COMPILER=${COMPILER}"
    "-DWAY=${WAY}"
    "-DMALUS_SOURCE_DIR=${MALUS_SOURCE_DIR}"
    "-DMALUS_VERSION=${MALUS_VERSION}"
    "-DCMAKE_PREFIX_PATH=${prefix}")
  run("${CMAKE_COMMAND}" --build "${build_dir}")
endif()
run("${build_dir}/consumer")
file(REMOVE_RECURSE "${SCRATCH_DIR}")
