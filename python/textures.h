// What a picture is drawn from, as Python holds it.
#pragma once

#include <pybind11/pybind11.h>
#include <voxmelt/voxmelt.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "python/handle.h"

namespace voxmelt::python {

// These are the structs of textures.h, with names and bytes of their own: those of the library are good only
// as long as its simulation stands still.
struct OwnTexture {
  std::string name;
  TexelFormat format = TexelFormat::u16;
  std::array<int, 3> size{}, brick{};
};
struct OwnNumbers {
  std::string name;
  std::vector<std::int32_t> values;
};
struct OwnBrick {
  std::size_t texture = 0;
  std::array<int, 3> at{};
  pybind11::bytes bytes;
  TexelFormat format = TexelFormat::u16;  // of its texture
  std::array<int, 3> side{};
};
struct OwnTextures {
  std::uint64_t version = 0;
  bool everything = false;
  std::vector<OwnTexture> textures;
  std::vector<OwnNumbers> numbers;
  std::vector<OwnBrick> bricks;
};

OwnTextures textures_of(Handle& handle, std::uint64_t version);
void add_textures(pybind11::module_& m);

}  // namespace voxmelt::python
