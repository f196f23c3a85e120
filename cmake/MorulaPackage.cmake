# What `cmake --install` puts into the prefix beside the libraries: the program, the licences, and the CMake package `morula`.
include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/morula)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/morulaConfig.cmake.in ${PROJECT_BINARY_DIR}/morulaConfig.cmake
  INSTALL_DESTINATION ${package_folder} PATH_VARS CMAKE_INSTALL_BINDIR)
# Until 1.0 what is public may change from one minor version to the next.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/morulaConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(TARGETS morula_processor EXPORT morulaTargets)
install(EXPORT morulaTargets NAMESPACE morula:: DESTINATION ${package_folder})
install(FILES ${PROJECT_BINARY_DIR}/morulaConfig.cmake ${PROJECT_BINARY_DIR}/morulaConfigVersion.cmake DESTINATION ${package_folder})
install(TARGETS morula RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
if(MORULA_WITH_GPL)
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSES/GPL-3.0-or-later.txt DESTINATION ${CMAKE_INSTALL_DOCDIR}/LICENSES)
endif()
