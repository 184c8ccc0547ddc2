# Writes a C++ source that holds a program as text, a literal for each file, as no compiler must take one of more than
# 65536 characters: cmake -DROOT=... -DALL=folder/all.cl -DHEADER=.../program_text.h -DSPACE=voxmelt::gpu -DOUT=...
# -P embed.cmake. ALL includes the files, from ROOT, and the dialect comes before them.
file(STRINGS "${ROOT}/${ALL}" lines REGEX "^#include")
set(files kernel/engine/gpu/program/dialect_open_cl.cl)
foreach(line ${lines})
  string(REGEX REPLACE "^#include \"(.*)\"$" "\\1" file "${line}")
  list(APPEND files ${file})
endforeach()
set(pieces "")
foreach(file ${files})
  file(READ "${ROOT}/${file}" piece)
  string(APPEND pieces "    R\"program(${piece})program\",\n")
endforeach()
file(WRITE "${OUT}" "// Written by kernel/engine/gpu/embed.cmake.
#include \"${HEADER}\"

namespace ${SPACE} {
namespace {

constexpr const char* kFiles[] = {
${pieces}};

}  // namespace

std::string program_text() {
  std::string all;
  for (const char* file : kFiles) all += file;
  return all;
}

}  // namespace ${SPACE}
")
