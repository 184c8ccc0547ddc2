// The targets of meshes read a file with some ending, and fill a small grid with it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "tests/fuzz/target.h"

namespace voxmelt::fuzz {

inline void read_mesh(const std::string& ending, const std::uint8_t* data, std::size_t size) {
  static const auto scene = write("scene.toml",
                                  "[grid]\nsize = [16, 12, 14]\n[[solid]]\nshape = \"mesh\"\n"
                                  "file = \"m" +
                                      ending + "\"\nheight = 8\nat = [8, 2, 8]\nrotate = [10, 20, 0]\n");
  write("m" + ending, text_of(data, size));
  try_to([&] { scene::load(scene, {}); });
}

}  // namespace voxmelt::fuzz
