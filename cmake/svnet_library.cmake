# svnet_library(NAME [COMPUTES] SOURCES ... [PUBLIC targets] [PRIVATE targets])
#
# A static library of files of the current folder. Headers are included from src/, as in `#include "base/error.h"`. Which
# folder may include which is checked by tests/architecture.
#
# With SVNET_UNITY, up to sixteen files of a library are compiled as one: most of a small file's time goes into the headers
# that it includes. So no two files of a library may define the same name, not even in unnamed namespaces.
#
# COMPUTES: compiled with -O3, which vectorises plain loops and does not change a bit of their results. Other targets
# read files and options: the preset release compiles them with -O1, which takes a fifth less time than -O2.
function(svnet_library name)
  cmake_parse_arguments(ARG "COMPUTES" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  target_include_directories(${name} PUBLIC ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(${name} PUBLIC ${ARG_PUBLIC} PRIVATE svnet_options ${ARG_PRIVATE})
  set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  if(SVNET_UNITY)
    set_target_properties(${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 16)
    # What is in the unnamed namespace of one file cannot be meant for another one.
    target_compile_options(${name} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
    foreach(source ${ARG_SOURCES})
      file(STRINGS ${source} compiled_many_times REGEX "hwy/foreach_target.h")
      if(compiled_many_times)
        set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
      endif()
    endforeach()
  endif()
  if(ARG_COMPUTES AND NOT SVNET_SANITIZE)
    target_compile_options(${name} PRIVATE -O3)
  endif()
endfunction()
