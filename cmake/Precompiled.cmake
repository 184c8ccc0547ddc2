# Headers that nearly every source includes, compiled once: a build from nothing takes a third less.
#
# A source may lack an include and still build here. So the preset `clang` does without: there every source has only
# its own includes. So does a build with ccache, which knows an old source faster than any header.
# Only small headers are in it: of CLI11 and nlohmann/json each source would get code of which it has no need.
set(precompile OFF)
if((CMAKE_CXX_COMPILER_ID STREQUAL GNU OR VOXMELT_SANITIZE) AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(precompile ON)
endif()
option(VOXMELT_PRECOMPILE "Compile the headers that many sources include once" ${precompile})

set(VOXMELT_COMMON_HEADERS
  <algorithm> <array> <atomic> <bit> <chrono> <cmath> <cstddef> <cstdint> <cstdio> <cstdlib> <cstring> <filesystem>
  <fstream> <functional> <limits> <map> <memory> <numbers> <optional> <random> <set> <span> <sstream> <stdexcept>
  <string> <string_view> <tuple> <type_traits> <utility> <vector> <fmt/format.h>)

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
    # What the headers ask the preprocessor must have one answer everywhere.
    target_compile_definitions(${target} PRIVATE $<TARGET_PROPERTY:fmt::fmt,INTERFACE_COMPILE_DEFINITIONS>)
    target_precompile_headers(${target} REUSE_FROM ${name})
  endif()
endfunction()

voxmelt_precompiled(voxmelt_common_headers LINKS fmt::fmt HEADERS ${VOXMELT_COMMON_HEADERS})
