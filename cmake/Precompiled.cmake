# Headers that nearly every source includes, compiled once: a build from nothing takes a third less.
#
# A source may lack an include and still build here. So the preset `clang` does without: there every source has only
# its own includes. So does a build with ccache, which knows an old source faster than any header.
# Every source pays for all of it, by its size: a third of a second for these 53 MB. With all headers of the standard
# library and {fmt} it is 97 MB, and a second, more than most of them take where they are needed.
set(precompile OFF)
if((CMAKE_CXX_COMPILER_ID STREQUAL GNU OR VOXMELT_SANITIZE) AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(precompile ON)
endif()
option(VOXMELT_PRECOMPILE "Compile the headers that many sources include once" ${precompile})

set(VOXMELT_COMMON_HEADERS
  <algorithm> <array> <cstddef> <cstdint> <functional> <memory> <optional> <span> <string> <string_view> <utility>
  <vector>)

# voxmelt_precompiled(<name> LINKS ... HEADERS ...): the headers, compiled with the options of all sources.
function(voxmelt_precompiled name)
  if(NOT VOXMELT_PRECOMPILE)
    return()
  endif()
  cmake_parse_arguments(ARG "" "" "LINKS;HEADERS" ${ARGN})
  file(GENERATE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp CONTENT "// CMake compiles headers beside a source.\n")
  add_library(${name} OBJECT ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
  target_link_libraries(${name} PRIVATE voxmelt_options ${ARG_LINKS})
  target_precompile_headers(${name} PRIVATE ${ARG_HEADERS})
endfunction()

# voxmelt_take_precompiled(<target> [<name>]): its sources, which have no options of their own, begin with them.
function(voxmelt_take_precompiled target)
  set(name voxmelt_common_headers)
  if(ARGC GREATER 1)
    set(name ${ARGV1})
  endif()
  if(TARGET ${name})
    target_precompile_headers(${target} REUSE_FROM ${name})
  endif()
endfunction()

voxmelt_precompiled(voxmelt_common_headers HEADERS ${VOXMELT_COMMON_HEADERS})
