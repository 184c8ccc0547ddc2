// The textures of a picture: bricks are bytes, and arrays of NumPy that point to them.
#include "python/textures.h"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>
#include <vector>

#include "python/docs.h"
#include "python/module.h"
#include "python/record.h"

namespace voxmelt::python {
namespace {

struct Numbers {
  py::dtype type;
  py::ssize_t count = 1;  // in a texel
};

Numbers numbers_of(TexelFormat format) {
  switch (format) {
    case TexelFormat::u16:
      return {py::dtype::of<std::uint16_t>(), 1};
    case TexelFormat::u8x4:
      return {py::dtype::of<std::uint8_t>(), 4};
    case TexelFormat::u32x2:
      return {py::dtype::of<std::uint32_t>(), 2};
    case TexelFormat::u32x4:
      return {py::dtype::of<std::uint32_t>(), 4};
    case TexelFormat::i32:
      return {py::dtype::of<std::int32_t>(), 1};
    case TexelFormat::i32x2:
      return {py::dtype::of<std::int32_t>(), 2};
  }
  throw py::value_error("a format of texels that has no numbers");
}

// Points to the bytes, which nobody can write.
py::array texels_of(const OwnBrick& brick) {
  const Numbers numbers = numbers_of(brick.format);
  std::vector<py::ssize_t> shape(brick.side.rbegin(), brick.side.rend());
  if (numbers.count > 1) shape.push_back(numbers.count);
  py::array made(numbers.type, shape, {}, PYBIND11_BYTES_AS_STRING(brick.bytes.ptr()), brick.bytes);
  py::detail::array_proxy(made.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return made;
}

}  // namespace

OwnTextures textures_of(Handle& handle, std::uint64_t version) {
  const Use use(handle, Access::draw);
  const Textures found = [&] {
    const py::gil_scoped_release release;
    return use->textures(version);
  }();
  OwnTextures own{found.version, found.everything, {}, {}, {}};
  for (const Texture& texture : found.textures)
    own.textures.push_back({std::string(texture.name), texture.format, texture.size, texture.brick});
  for (const TextureNumbers& numbers : found.numbers)
    own.numbers.push_back({std::string(numbers.name), numbers.values});
  for (const TextureBrick& brick : found.bricks) {
    const Texture& texture = found.textures[brick.texture];
    const py::bytes bytes(reinterpret_cast<const char*>(brick.bytes.data()), brick.bytes.size());
    own.bricks.push_back({brick.texture, brick.at, bytes, texture.format, texture.brick});
  }
  return own;
}

void add_textures(py::module_& m) {
  Record<OwnTexture>(m, "Texture")
      .shows("name", &OwnTexture::name)
      .shows("format", &OwnTexture::format)
      .shows("size", &OwnTexture::size)
      .shows("brick", &OwnTexture::brick)
      .made_here();
  Record<OwnNumbers>(m, "TextureNumbers")
      .shows("name", &OwnNumbers::name)
      .shows("values", &OwnNumbers::values)
      .made_here();
  Record<OwnBrick>(m, "TextureBrick")
      .shows("texture", &OwnBrick::texture)
      .shows("at", &OwnBrick::at)
      .shows("bytes", &OwnBrick::bytes)
      .made_here()
      .def_property_readonly("texels", &texels_of,
                             "Its texels as an array (z, y, x), with a last axis where a texel holds several "
                             "numbers. It cannot be written.");
  Record<OwnTextures>(m, "Textures")
      .shows("version", &OwnTextures::version)
      .shows("everything", &OwnTextures::everything)
      .shows("textures", &OwnTextures::textures)
      .shows("numbers", &OwnTextures::numbers)
      .shows("bricks", &OwnTextures::bricks)
      .made_here();
}

}  // namespace voxmelt::python
