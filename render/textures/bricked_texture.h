// A texture is kept as bricks of equal size. Each brick knows the version at which its bytes last changed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <vector>

namespace voxmelt::render {

// Names what a texel holds: numbers without sign, or (`i32`) with one, in the byte order of the machine.
enum class Texel : std::uint8_t { u16, u8x4, u32x2, u32x4, i32, i32x2 };
std::size_t bytes_of(Texel texel);

class BrickedTexture {
 public:
  using Side = std::array<int, 3>;  // along x, y and z

  // Makes a texture of zeros. It is as large as the bricks that hold `size` texels.
  BrickedTexture(std::string_view name, Texel texel, Side size, Side brick);

  std::string_view name() const { return name_; }
  Texel texel() const { return texel_; }
  const Side& brick() const { return brick_; }    // texels along a brick
  const Side& bricks() const { return bricks_; }  // bricks along the texture
  Side size() const;
  std::size_t brick_bytes() const { return brick_bytes_; }
  std::size_t count() const { return versions_.size(); }  // of bricks, x fastest

  // Takes over the bytes of a brick, texels along x fastest. Tells whether they are other ones.
  bool write(std::size_t brick, const void* bytes, std::uint64_t version) {
    std::uint8_t* const kept = bytes_.data() + brick * brick_bytes_;
    if (std::memcmp(kept, bytes, brick_bytes_) == 0) return false;
    std::memcpy(kept, bytes, brick_bytes_);
    versions_[brick] = version;
    return true;
  }
  // Does so for a whole table of texels, row by row. `at` is what a texture of this size would hold.
  bool write_all(const void* table, Side size, std::uint64_t version);

  std::span<const std::uint8_t> bytes(std::size_t brick) const {
    return {bytes_.data() + brick * brick_bytes_, brick_bytes_};
  }
  // Returns 0 for a brick that never was anything but zeros.
  std::uint64_t version(std::size_t brick) const { return versions_[brick]; }

 private:
  std::string_view name_;
  Texel texel_;
  Side brick_, bricks_;
  std::size_t brick_bytes_;
  std::vector<std::uint8_t> bytes_, room_;
  std::vector<std::uint64_t> versions_;
};

}  // namespace voxmelt::render
