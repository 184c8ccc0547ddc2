# voxmelt_library(<folder target> SOURCES ... PUBLIC ... PRIVATE ...): one static library per folder.
# Headers are included by their path from the top of the house: "kernel/automaton/rule/spread.h".
add_library(voxmelt_options INTERFACE)
target_include_directories(voxmelt_options INTERFACE ${PROJECT_SOURCE_DIR})
# Plugins and modules of other languages link the library, so its code may lie anywhere. All code is compiled alike,
# because it shares precompiled headers. Nobody replaces our functions from outside, so they are inlined as ever.
target_compile_options(voxmelt_options INTERFACE -fPIC -fno-semantic-interposition)
option(VOXMELT_WARNINGS "Warn, and take warnings for errors" ON)
if(VOXMELT_WARNINGS)
  target_compile_options(voxmelt_options INTERFACE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Werror)
endif()
if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm64)$")
  set(VOXMELT_AARCH64 ON)
  # There compilers fuse multiply-adds by default, which gives other bits than on x86-64.
  target_compile_options(voxmelt_options INTERFACE -ffp-contract=off)
endif()
if(VOXMELT_SANITIZE)
  target_compile_options(voxmelt_options INTERFACE
    -fsanitize=${VOXMELT_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(voxmelt_options INTERFACE -fsanitize=${VOXMELT_SANITIZE})
endif()

# voxmelt_cold(<source> ...): sources of this folder that run once and compile long. A command line, a report.
function(voxmelt_cold)
  set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS $<$<CONFIG:Release>:-O1>)
endfunction()

function(voxmelt_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  target_link_libraries(${name} PUBLIC voxmelt_options ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  voxmelt_take_precompiled(${name})
endfunction()
