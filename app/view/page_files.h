// The files of the page are part of the program.
#pragma once

#include <span>
#include <string_view>

namespace voxmelt::view {

struct PageFile {
  std::string_view target;  // what a browser asks for
  std::string_view type;
  std::string_view text;
};
std::span<const PageFile> page_files();

}  // namespace voxmelt::view
