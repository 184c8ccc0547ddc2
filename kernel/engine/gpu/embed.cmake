# Writes a C++ source that holds the program as text, a literal for each file, as no compiler must take one of more than
# 65536 characters: cmake -DFOLDER=program -DOUT=... -P embed.cmake
set(text "")
file(STRINGS "${FOLDER}/all.cl" lines REGEX "^#include")
foreach(line ${lines})
  string(REGEX REPLACE "^.*/([a-z_]+[.]cl)\"$" "\\1" file "${line}")
  list(APPEND files ${file})
endforeach()
set(pieces "")
foreach(file dialect_open_cl.cl ${files})
  file(READ "${FOLDER}/${file}" piece)
  string(APPEND pieces "    R\"program(${piece})program\",\n")
endforeach()
file(WRITE "${OUT}" "// Written by kernel/engine/gpu/embed.cmake.
#include \"kernel/engine/gpu/program_text.h\"

namespace voxmelt::gpu {
namespace {

constexpr const char* kFiles[] = {
${pieces}};

}  // namespace

std::string program_text() {
  std::string all;
  for (const char* file : kFiles) all += file;
  return all;
}

}  // namespace voxmelt::gpu
")
