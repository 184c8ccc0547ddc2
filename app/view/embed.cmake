# Writes a C++ source that holds the files of the page: cmake -DFOLDER=... -DOUT=... -P embed.cmake
set(type_html "text/html; charset=utf-8")
set(type_js "text/javascript; charset=utf-8")
set(type_css "text/css; charset=utf-8")
set(type_glsl "text/plain; charset=utf-8")
set(type_svg "image/svg+xml")
set(rows "")
set(texts "")
file(GLOB files RELATIVE "${FOLDER}" "${FOLDER}/*")
foreach(file ${files})
  string(REGEX REPLACE "^.*[.]" "" ending "${file}")
  set(type "${type_${ending}}")
  if(NOT type)
    message(FATAL_ERROR "${file}: embed.cmake knows no type for it")
  endif()
  set(target "/${file}")
  if(file STREQUAL "index.html")
    set(target "/")
  endif()
  file(READ "${FOLDER}/${file}" bytes HEX)
  string(LENGTH "${bytes}" digits)
  math(EXPR size "${digits} / 2")
  string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
  string(MAKE_C_IDENTIFIER "${file}" name)
  string(APPEND texts "constexpr unsigned char ${name}[] = {${bytes}};\n")
  string(APPEND rows "    PageFile{\"${target}\", \"${type}\", {reinterpret_cast<const char*>(${name}), ${size}}},\n")
endforeach()
file(WRITE "${OUT}" "// Written by app/view/embed.cmake.
#include \"app/view/page_files.h\"

#include <array>

namespace voxmelt::view {
namespace {

${texts}
}  // namespace

std::span<const PageFile> page_files() {
  static const std::array files{
${rows}  };
  return files;
}

}  // namespace voxmelt::view
")
