# Installation: programs, the data they read, and the meshless library with its exported target Petrov::meshless.
# A package is built with -DPETROV_NATIVE=OFF.

include(CMakePackageConfigHelpers)

if(TARGET petrov_program)
  install(TARGETS petrov_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

install(DIRECTORY comparisons/benchmarks comparisons/examples meshes
  DESTINATION ${CMAKE_INSTALL_DATADIR}/petrov OPTIONAL
  FILES_MATCHING PATTERN "*.toml" PATTERN "*.md" PATTERN "*.geo" PATTERN "*.msh" PATTERN "*.csv")

install(DIRECTORY comparisons/reports/page DESTINATION ${CMAKE_INSTALL_DATADIR}/petrov/reports
  FILES_MATCHING PATTERN "*.css" PATTERN "*.js")

if(TARGET meshless)
  set(config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/Petrov)
  install(TARGETS meshless EXPORT PetrovTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(DIRECTORY meshless/include/meshless DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
  install(EXPORT PetrovTargets NAMESPACE Petrov:: DESTINATION ${config_folder})
  configure_package_config_file(cmake/PetrovConfig.cmake.in ${PROJECT_BINARY_DIR}/PetrovConfig.cmake
    INSTALL_DESTINATION ${config_folder})
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/PetrovConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/PetrovConfig.cmake ${PROJECT_BINARY_DIR}/PetrovConfigVersion.cmake
    DESTINATION ${config_folder})
endif()
