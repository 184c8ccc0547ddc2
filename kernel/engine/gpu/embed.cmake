# Writes a C++ source that holds a program as text, a literal for each file, as no compiler must take one of more than
# 65536 characters: cmake -DROOT=... -DALL=folder/all.cl -DHEADER=.../program_text.h -DSPACE=voxmelt::gpu -DOUT=...
# -P embed.cmake. ALL includes the files, from ROOT. With -DDIALECTS=open_cl,cuda it holds these, too.
set(functions "")

# Adds a function that returns files one after the other.
function(add_text name)
  set(pieces "")
  foreach(file ${ARGN})
    file(READ "${ROOT}/${file}" piece)
    string(APPEND pieces "    R\"program(${piece})program\",\n")
  endforeach()
  string(APPEND functions "
std::string ${name}() {
  constexpr const char* kFiles[] = {
${pieces}};
  std::string all;
  for (const char* file : kFiles) all += file;
  return all;
}
")
  set(functions "${functions}" PARENT_SCOPE)
endfunction()

file(STRINGS "${ROOT}/${ALL}" lines REGEX "^#include")
set(files "")
foreach(line ${lines})
  string(REGEX REPLACE "^#include \"(.*)\"$" "\\1" file "${line}")
  list(APPEND files ${file})
endforeach()
add_text(program_text ${files})
string(REPLACE "," ";" dialects "${DIALECTS}")
foreach(dialect ${dialects})
  add_text(${dialect}_dialect kernel/engine/gpu/program/dialect_${dialect}.cl)
endforeach()
file(WRITE "${OUT}" "// Written by kernel/engine/gpu/embed.cmake.
#include \"${HEADER}\"

namespace ${SPACE} {
${functions}
}  // namespace ${SPACE}
")
