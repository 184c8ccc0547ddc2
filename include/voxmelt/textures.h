/// @file
/// A program may draw by a graphics processor. The textures, tables and numbers here are all that a picture
/// is drawn from, and docs/picture/definition.md says how (docs/library.md, "Textures").
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace voxmelt {

/// Names what a texel holds, in the byte order of the machine.
enum class TexelFormat : std::uint8_t {
  u16,    ///< one number of 16 bits
  u8x4,   ///< four bytes
  u32x2,  ///< two numbers of 32 bits
  u32x4,  ///< four numbers of 32 bits
  i32,    ///< one number of 32 bits, with a sign
  i32x2,  ///< two numbers of 32 bits, with a sign
};

/// Describes a texture. It begins as zeros, and consists of whole bricks.
struct Texture {
  std::string_view name;                                             ///< "levels", "matter", "light", ...
  TexelFormat format = TexelFormat::u16;                             ///< what a texel holds
  std::array<int, 3> size{};                                         ///< texels along x, y and z
  std::array<int, 3> brick{};                                        ///< texels along a brick
  friend bool operator==(const Texture&, const Texture&) = default;  ///< the same name and shape
};

/// Holds a brick of a texture that has changed.
struct TextureBrick {
  std::size_t texture = 0;              ///< number of the texture in Textures::textures
  std::array<int, 3> at{};              ///< its first texel
  std::span<const std::uint8_t> bytes;  ///< its texels, along x fastest
};

/// Holds a number of the picture, or several.
struct TextureNumbers {
  std::string_view name;             ///< "to_light", "highest", ...
  std::vector<std::int32_t> values;  ///< integers of docs/picture/definition.md
};

/// Holds what a picture is drawn from, as far as it has changed.
struct Textures {
  std::uint64_t version = 0;            ///< version of these textures; ask with it the next time
  bool everything = false;              ///< the version asked for is unknown: begin with zeros again
  std::vector<Texture> textures;        ///< all textures
  std::vector<TextureNumbers> numbers;  ///< all numbers
  std::vector<TextureBrick> bricks;     ///< bricks that differ since the version asked for
};

}  // namespace voxmelt
