# The instruction sets: the compiler's options, and objects for each. What C++ knows of them is in
# kernel/engine/cpu/instruction_set_table.h; their lanes are in kernel/engine/cpu/lanes_<name>.h.

# voxmelt_instruction_set(<name> <processor> [<option> ...]): one of them.
function(voxmelt_instruction_set name processor)
  if((processor STREQUAL aarch64 AND VOXMELT_AARCH64) OR (processor STREQUAL x86-64 AND NOT VOXMELT_AARCH64))
    set(VOXMELT_INSTRUCTION_SETS ${VOXMELT_INSTRUCTION_SETS} ${name} PARENT_SCOPE)
    set(VOXMELT_${name}_OPTIONS ${ARGN} PARENT_SCOPE)
  endif()
endfunction()

voxmelt_instruction_set(sse42 x86-64 -march=x86-64-v2)
voxmelt_instruction_set(avx2 x86-64 -march=x86-64-v3)
# g++ 12 warns of undefined registers in its own immintrin.h.
voxmelt_instruction_set(avx512 x86-64
  -march=x86-64-v4 -Wno-uninitialized $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
voxmelt_instruction_set(neon aarch64)

# A build for the machine at hand has one of them; it takes a third of the processor time. AVX-512 is not worth
# its: it takes longest to compile, and `auto` seldom chooses it.
option(VOXMELT_ONE_INSTRUCTION_SET "Compile for one instruction set, of the machine at hand" OFF)
if(VOXMELT_ONE_INSTRUCTION_SET)
  if(NOT VOXMELT_AARCH64)
    execute_process(COMMAND ${CMAKE_CXX_COMPILER} -march=native -dM -E -x c++ /dev/null OUTPUT_VARIABLE native)
    if(native MATCHES "__AVX2__ 1" AND native MATCHES "__BMI2__ 1" AND native MATCHES "__FMA__ 1")
      set(VOXMELT_INSTRUCTION_SETS avx2)
    else()
      set(VOXMELT_INSTRUCTION_SETS sse42)
    endif()
  endif()
  target_compile_definitions(voxmelt_options INTERFACE VOXMELT_ONLY_${VOXMELT_INSTRUCTION_SETS})
endif()

set(VOXMELT_INSTANCE_LEVEL -O3 CACHE STRING "How far the code of an instruction set is optimised")

# voxmelt_instances(<target> <source> [SETS <name> ...] [OPTIONS <option> ...]): compiles the source once for
# each instruction set, or for those named, into objects <target>_<name> that the target takes.
#
# They are always optimised, whatever the rest is: at -O0 helpers of the standard library would stay out of line, and code of one
# instruction set could be linked in place of another's.
function(voxmelt_instances target source)
  cmake_parse_arguments(ARG "" "" "SETS;OPTIONS" ${ARGN})
  foreach(set IN LISTS VOXMELT_INSTRUCTION_SETS)
    if(ARG_SETS AND NOT set IN_LIST ARG_SETS)
      continue()
    endif()
    add_library(${target}_${set} OBJECT ${source})
    target_link_libraries(${target}_${set} PRIVATE voxmelt_options)
    target_compile_options(${target}_${set} PRIVATE ${VOXMELT_INSTANCE_LEVEL} ${VOXMELT_${set}_OPTIONS} ${ARG_OPTIONS})
    target_compile_definitions(${target}_${set} PRIVATE
      VOXMELT_INSTRUCTION_SET=${set} VOXMELT_LANES_HEADER="kernel/engine/cpu/lanes_${set}.h")
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${target}_${set}>)
    set_property(TARGET ${target} APPEND PROPERTY VOXMELT_INSTANCES $<TARGET_OBJECTS:${target}_${set}>)
  endforeach()
endfunction()
