# SPDX-License-Identifier: MIT
#
# Headers, a CMake package and a pkg-config file. Nothing here depends on the architecture, so the package lives under
# share/, and nothing holds an absolute path, so the installed tree may be moved.
include(CMakePackageConfigHelpers)

set(malus_cmake_dir "${CMAKE_INSTALL_DATADIR}/cmake/malus")
set(malus_pkgconfig_dir "${CMAKE_INSTALL_DATADIR}/pkgconfig")

configure_package_config_file(
  "${PROJECT_SOURCE_DIR}/cmake/malus-config.cmake.in"
  "${PROJECT_BINARY_DIR}/malus-config.cmake"
  INSTALL_DESTINATION "${malus_cmake_dir}"
  NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(
  "${PROJECT_BINARY_DIR}/malus-config-version.cmake"
  COMPATIBILITY SameMinorVersion
  ARCH_INDEPENDENT)

cmake_path(IS_ABSOLUTE CMAKE_INSTALL_INCLUDEDIR malus_absolute_includedir)
if(malus_absolute_includedir)
  set(malus_pc_includedir "${CMAKE_INSTALL_INCLUDEDIR}")
else()
  set(malus_pc_includedir "\${prefix}/${CMAKE_INSTALL_INCLUDEDIR}")
endif()
cmake_path(RELATIVE_PATH CMAKE_INSTALL_PREFIX
  BASE_DIRECTORY "${CMAKE_INSTALL_PREFIX}/${malus_pkgconfig_dir}"
  OUTPUT_VARIABLE malus_pc_prefix)
configure_file("${PROJECT_SOURCE_DIR}/cmake/malus.pc.in" "${PROJECT_BINARY_DIR}/malus.pc" @ONLY)

install(TARGETS malus EXPORT malus-targets FILE_SET HEADERS)
install(EXPORT malus-targets NAMESPACE malus:: DESTINATION "${malus_cmake_dir}")
install(
  FILES
    "${PROJECT_BINARY_DIR}/malus-config.cmake"
    "${PROJECT_BINARY_DIR}/malus-config-version.cmake"
  DESTINATION "${malus_cmake_dir}")
install(FILES "${PROJECT_BINARY_DIR}/malus.pc" DESTINATION "${malus_pkgconfig_dir}")
