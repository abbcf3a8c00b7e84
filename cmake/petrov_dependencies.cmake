# Libraries from outside; on Debian 12 all of them are packages (see packages.txt).

find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(nanoflann REQUIRED)
find_package(TBB REQUIRED)
find_package(fmt REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(ZLIB REQUIRED)
find_package(deal.II 9.4 REQUIRED)

find_path(UMFPACK_INCLUDE_DIR umfpack.h PATH_SUFFIXES suitesparse REQUIRED)
find_library(UMFPACK_LIBRARY umfpack REQUIRED)
find_library(CHOLMOD_LIBRARY cholmod REQUIRED)
find_library(MUPARSER_LIBRARY muparser REQUIRED)
find_path(GMSH_INCLUDE_DIR gmsh.h REQUIRED)
find_library(GMSH_LIBRARY gmsh REQUIRED)
find_path(TOML_INCLUDE_DIR toml++/toml.h REQUIRED)
mark_as_advanced(UMFPACK_INCLUDE_DIR UMFPACK_LIBRARY CHOLMOD_LIBRARY MUPARSER_LIBRARY GMSH_INCLUDE_DIR GMSH_LIBRARY
  TOML_INCLUDE_DIR)

# UMFPACK, CHOLMOD and deal.II ask for libblas.so.3, which may be the slow reference BLAS. libopenblas linked
# first, and kept although nothing calls it by name, answers for every BLAS and LAPACK symbol of the process
# whatever the system's alternatives say.
find_library(OPENBLAS_LIBRARY openblas PATH_SUFFIXES openblas-pthread REQUIRED)
mark_as_advanced(OPENBLAS_LIBRARY)
set(PETROV_OPENBLAS_LINK "-Wl,--push-state,--no-as-needed" ${OPENBLAS_LIBRARY} "-Wl,--pop-state")

# deal.II would put its own flags (-g -O2 -std=c++17 -funroll-all-loops ...) behind ours and win.
set(DEAL_II_CXX_FLAGS "")
set(DEAL_II_CXX_FLAGS_RELEASE "")
set(DEAL_II_CXX_FLAGS_DEBUG "")
set(DEAL_II_LINKER_FLAGS_DEBUG "")

# Compile the sources of a target against deal.II and link it. Targets that link the result see its plain headers
# only: neither include paths nor flags nor definitions of deal.II pass on. (The macro links by the old signature
# without PUBLIC or PRIVATE, so later target_link_libraries calls for this target must do likewise.)
function(petrov_use_deal_ii target)
  # Its Debug library would make a sanitized run last hours, and is not instrumented anyway.
  if(PETROV_SANITIZE)
    deal_ii_setup_target(${target} RELEASE)
  else()
    deal_ii_setup_target(${target})
  endif()
  set_target_properties(${target} PROPERTIES
    INTERFACE_COMPILE_OPTIONS "" INTERFACE_COMPILE_DEFINITIONS ""
    JOB_POOL_COMPILE deal_ii_pool JOB_POOL_PRECOMPILE_HEADER deal_ii_pool)
endfunction()
