# svnet_library(NAME [COMPUTES] SOURCES ... [PUBLIC targets] [PRIVATE targets])
#
# A static library of files of the current folder. Headers are included from src/, as in `#include "base/error.h"`. Which
# folder may include which is checked by tests/architecture.
#
# With SVNET_UNITY, up to sixteen files of a library are compiled as one: most of a small file's time goes into the headers
# that it includes. So no two files of a library may define the same name, not even in unnamed namespaces, and no two
# Highway files in HWY_NAMESPACE.
#
# COMPUTES: compiled with -O3, which vectorises plain loops and does not change a bit of their results. Other targets
# read files and options: the preset release compiles them with -O1, which takes a fifth less time than -O2.
function(svnet_library name)
  cmake_parse_arguments(ARG "COMPUTES" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  set(precompiled svnet_precompiled)
  if(ARG_COMPUTES AND NOT SVNET_SANITIZE)
    set(precompiled svnet_precompiled_computes)
  endif()
  add_library(${name} STATIC ${ARG_SOURCES})
  target_include_directories(${name} PUBLIC ${PROJECT_SOURCE_DIR}/src)
  target_link_libraries(${name} PUBLIC ${ARG_PUBLIC} PRIVATE svnet_options ${ARG_PRIVATE})
  set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  if(SVNET_UNITY)
    set_target_properties(${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 16)
    target_precompile_headers(${name} REUSE_FROM ${precompiled})
    # What is in the unnamed namespace of one file cannot be meant for another one.
    target_compile_options(${name} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
    set(highway_sources "")
    foreach(source ${ARG_SOURCES})
      file(STRINGS ${source} compiled_many_times REGEX "hwy/foreach_target.h")
      if(compiled_many_times)
        list(APPEND highway_sources ${source})
      endif()
    endforeach()
    if(highway_sources AND SVNET_SANITIZE)
      svnet_sanitized_highway_sources(${highway_sources})
    elseif(highway_sources)
      svnet_highway_unit(${name} ${highway_sources})
    endif()
  endif()
  if(ARG_COMPUTES AND NOT SVNET_SANITIZE)
    target_compile_options(${name} PRIVATE -O3)
  endif()
endfunction()

# Compiles Highway files of a library, those that include hwy/foreach_target.h, as one: Highway's headers, which take two
# seconds to compile for all instruction sets, are then read once. Highway includes the unit itself once for each
# instruction set, so it names itself again after its files, each of which names itself.
function(svnet_highway_unit library)
  set(unit highway/${library}.cpp)
  file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR}/src ${CMAKE_CURRENT_SOURCE_DIR})
  set(this "#undef HWY_TARGET_INCLUDE\n#define HWY_TARGET_INCLUDE \"${unit}\"\n")
  set(text "${this}#include <hwy/foreach_target.h>\n#include <hwy/highway.h>\n")
  foreach(source ${ARGN})
    string(APPEND text "#include \"${folder}/${source}\"\n")
  endforeach()
  set(generated ${PROJECT_BINARY_DIR}/generated)
  file(CONFIGURE OUTPUT ${generated}/${unit} CONTENT "${text}${this}" @ONLY)
  target_sources(${library} PRIVATE ${generated}/${unit})
  target_include_directories(${library} PRIVATE ${generated})
  set_source_files_properties(${generated}/${unit} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  set_source_files_properties(${ARGN} PROPERTIES HEADER_FILE_ONLY ON)
endfunction()

# Highway files under sanitizers, where unrolled vector code takes minutes to compile: files of their own, so that
# processors share them, without the three checks of each access that find nothing here: the address sanitizer finds null
# pointers and accesses beyond an object too, and aligned loads of vectors trap.
function(svnet_sanitized_highway_sources)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON
    COMPILE_OPTIONS "-fno-sanitize=null,alignment,object-size")
endfunction()

# In unity builds, the standard headers that most files include are compiled once for each set of options. Files include
# what they need all the same: other builds have no precompiled headers.
# svnet_precompiled_headers(NAME [OPTIONS ...] [HEADERS ...]): these, and further headers.
function(svnet_precompiled_headers name)
  cmake_parse_arguments(ARG "" "" "OPTIONS;HEADERS" ${ARGN})
  set(empty ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
  file(CONFIGURE OUTPUT ${empty} CONTENT "")
  add_library(${name} OBJECT ${empty})
  target_link_libraries(${name} PRIVATE svnet_options)
  target_compile_options(${name} PRIVATE ${ARG_OPTIONS})
  set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_precompile_headers(${name} PRIVATE <algorithm> <array> <cmath> <cstdint> <cstring> <filesystem> <functional>
    <limits> <map> <memory> <numeric> <optional> <span> <sstream> <string> <string_view> <utility> <vector> ${ARG_HEADERS})
endfunction()
if(SVNET_UNITY)
  svnet_precompiled_headers(svnet_precompiled)
  if(NOT SVNET_SANITIZE)
    svnet_precompiled_headers(svnet_precompiled_computes OPTIONS -O3)
  endif()
endif()
