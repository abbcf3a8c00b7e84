# cmake -D SOURCE_DIR=... -D HEADER=... -P write_commit.cmake: writes PETROV_COMMIT, only when it has changed.
cmake_minimum_required(VERSION 3.25)
find_program(git git)
set(commit unknown)
if(git)
  execute_process(COMMAND ${git} -C ${SOURCE_DIR} describe --always --dirty --abbrev=12 --exclude=*
    OUTPUT_VARIABLE found OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE result)
  if(result EQUAL 0)
    set(commit ${found})
  endif()
endif()
file(CONFIGURE OUTPUT ${HEADER} CONTENT "#pragma once\n#define PETROV_COMMIT \"@commit@\"\n" @ONLY)
