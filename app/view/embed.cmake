# Writes a C++ source that holds the files of the page: cmake -DFOLDER=... -DOUT=... -P embed.cmake
set(rows "")
set(texts "")
foreach(row "index.html|/|text/html; charset=utf-8" "view.js|/view.js|text/javascript; charset=utf-8"
            "ball.js|/ball.js|text/javascript; charset=utf-8"
            "camera.js|/camera.js|text/javascript; charset=utf-8" "panel.js|/panel.js|text/javascript; charset=utf-8"
            "view.css|/view.css|text/css; charset=utf-8" "icon.svg|/icon.svg|image/svg+xml")
  string(REPLACE "|" ";" parts "${row}")
  list(GET parts 0 file)
  list(GET parts 1 target)
  string(REGEX REPLACE "^[^|]*\\|[^|]*\\|" "" type "${row}")
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
