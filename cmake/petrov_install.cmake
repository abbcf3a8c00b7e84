# Installation: programs, the data they read, and the meshless library with its exported target Petrov::meshless.

foreach(program IN ITEMS petrov_program)
  if(TARGET ${program})
    install(TARGETS ${program} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  endif()
endforeach()

install(DIRECTORY comparisons/benchmarks comparisons/examples meshes
  DESTINATION ${CMAKE_INSTALL_DATADIR}/petrov OPTIONAL
  FILES_MATCHING PATTERN "*.toml" PATTERN "*.md" PATTERN "*.geo" PATTERN "*.msh" PATTERN "*.csv")
