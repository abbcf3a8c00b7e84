# Compiler settings that hold for every target of this project.

# deal.II exists as a Release and a Debug library. With any other build type it silently takes the Debug one
# (set-up 24 times, assembly 57 times slower), so every timing would be wrong.
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Release or Debug" FORCE)
endif()
set_property(CACHE CMAKE_BUILD_TYPE PROPERTY STRINGS Release Debug)
if(NOT CMAKE_BUILD_TYPE MATCHES "^(Release|Debug)$")
  message(FATAL_ERROR
    "CMAKE_BUILD_TYPE is '${CMAKE_BUILD_TYPE}'; Petrov accepts exactly Release or Debug. "
    "With RelWithDebInfo or MinSizeRel deal.II silently becomes its Debug library, many times slower. "
    "For a Release build with symbols use -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS=-g.")
endif()

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib)
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib)

# No -ffast-math: sums keep their order and NaN stays visible.
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")
set(CMAKE_CXX_FLAGS_DEBUG "-O0 -g")

set(PETROV_NATIVE_FLAGS)
if(PETROV_NATIVE)
  set(PETROV_NATIVE_FLAGS -march=native)
endif()
add_compile_options(${PETROV_NATIVE_FLAGS})
# Nothing reads errno after a mathematical function; without it sqrt is one instruction.
add_compile_options(-fno-math-errno)

add_compile_options(-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion)
# False alarms of g++ 12: its own AVX-512 intrinsics ("__Y may be used uninitialized") wherever Eigen is inlined, and
# std::string and fmt at -O3 (restrict, stringop-overflow).
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  add_compile_options(-Wno-maybe-uninitialized -Wno-restrict -Wno-stringop-overflow)
endif()
if(PETROV_WARNINGS_AS_ERRORS)
  add_compile_options(-Werror)
endif()

# deal.II brings some 200 shared libraries: gold links a program in 1 s, the default linker in 14 s.
include(CheckLinkerFlag)
check_linker_flag(CXX -fuse-ld=gold PETROV_HAS_GOLD)
if(PETROV_HAS_GOLD)
  add_link_options(-fuse-ld=gold)
endif()

# A program that uses nothing of deal.II must not load it.
add_link_options(-Wl,--as-needed)

if(PETROV_SANITIZE)
  # -O1: at -O0 the sanitized tests take too long. -g1: lines of the stack, without which a finding says nothing; more
  # would triple the libraries. The first finding ends the program, so that no test can pass over it.
  add_compile_options(-fsanitize=${PETROV_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer -O1 -g1)
  add_compile_definitions(_GLIBCXX_ASSERTIONS)
  # The same false alarm of g++ 12's intrinsics as above, under another name at -O1.
  add_compile_options(-Wno-uninitialized)
  add_link_options(-fsanitize=${PETROV_SANITIZE})
endif()

# A file that includes deal.II needs up to 1.8 GB to compile.
set_property(GLOBAL PROPERTY JOB_POOLS deal_ii_pool=2)
