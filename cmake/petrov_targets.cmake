# Small helpers for the targets of this project.

# Sources by pattern below the top folder; a file that appears or goes makes the next build configure again.
function(petrov_glob result)
  list(TRANSFORM ARGN PREPEND ${PROJECT_SOURCE_DIR}/ OUTPUT_VARIABLE patterns)
  file(GLOB_RECURSE found CONFIGURE_DEPENDS ${patterns})
  set(${result} ${found} PARENT_SCOPE)
endfunction()

function(petrov_link_if_target target scope)
  foreach(library IN LISTS ARGN)
    if(TARGET ${library})
      target_link_libraries(${target} ${scope} ${library})
    endif()
  endforeach()
endfunction()

function(petrov_add_program name)
  add_executable(${name} ${ARGN})
  # First in line, before any library that asks for libblas.so.3.
  target_link_libraries(${name} PRIVATE ${PETROV_OPENBLAS_LINK} comparisons)
endfunction()

# What a report says of the program: version, commit, flags, where the data are; read by the sources named after the
# target.
# The commit changes without any change of ours, so it lives in a header, petrov_commit.h (#define PETROV_COMMIT),
# which is looked at in every build and rewritten only when it differs.
function(petrov_describe_build target)
  set(folder ${PROJECT_BINARY_DIR}/generated)
  set(command ${CMAKE_COMMAND} -D SOURCE_DIR=${PROJECT_SOURCE_DIR} -D HEADER=${folder}/petrov_commit.h
    -P ${PROJECT_SOURCE_DIR}/cmake/write_commit.cmake)
  execute_process(COMMAND ${command} COMMAND_ERROR_IS_FATAL ANY)
  add_custom_target(petrov_commit COMMAND ${command} BYPRODUCTS ${folder}/petrov_commit.h
    COMMENT "Reading the commit" VERBATIM)
  add_dependencies(${target} petrov_commit)
  target_include_directories(${target} PUBLIC ${folder})

  string(TOUPPER ${CMAKE_BUILD_TYPE} type)
  get_directory_property(options COMPILE_OPTIONS)
  list(FILTER options EXCLUDE REGEX "^(-W|\\$<)")
  list(JOIN options " " options)
  string(STRIP "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${type}} ${options}" flags)
  set(libraries)
  foreach(package IN ITEMS deal.II Eigen3 TBB fmt nlohmann_json CLI11)
    if(${package}_VERSION)
      list(APPEND libraries "${package} ${${package}_VERSION}")
    endif()
  endforeach()
  list(JOIN libraries "," libraries)
  # Only for the files that read them: a compiler cache then shares all others between folders.
  set_property(SOURCE ${ARGN} APPEND PROPERTY COMPILE_DEFINITIONS
    PETROV_VERSION="${PROJECT_VERSION}"
    PETROV_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
    PETROV_INSTALL_DATA_DIR="${CMAKE_INSTALL_FULL_DATADIR}/petrov"
    PETROV_LIBRARY_VERSIONS="${libraries}"
    PETROV_BUILD_TYPE="${CMAKE_BUILD_TYPE}"
    PETROV_CXX_FLAGS="${flags}")
endfunction()
