# Writes a C++ source that holds the program as text: cmake -DFOLDER=program -DOUT=... -P embed.cmake
set(text "")
file(STRINGS "${FOLDER}/all.cl" lines REGEX "^#include")
foreach(line ${lines})
  string(REGEX REPLACE "^.*/([a-z_]+[.]cl)\"$" "\\1" file "${line}")
  list(APPEND files ${file})
endforeach()
set(pieces "")
foreach(file dialect_open_cl.cl ${files})
  file(READ "${FOLDER}/${file}" piece)
  string(APPEND pieces "    R\"program(${piece})program\"\n")
endforeach()
file(WRITE "${OUT}" "// Written by kernel/engine/gpu/embed.cmake.
#include \"kernel/engine/gpu/program_text.h\"

namespace voxmelt::gpu {

std::string_view program_text() {
  return
${pieces}      ;
}

}  // namespace voxmelt::gpu
")
