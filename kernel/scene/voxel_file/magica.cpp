// The reader of MagicaVoxel's .vox. A voxel's number is its index in the palette, from 1 on; 0 is empty. Its
// z points up, and here y does.
#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "kernel/scene/text/bytes.h"
#include "kernel/scene/voxel_file/formats.h"

namespace voxmelt::scene {
namespace {

constexpr std::size_t kHeader = 8, kChunk = 12;  // bytes
constexpr std::uint32_t kLargestModel = 256;     // voxels along a side

}  // namespace

Voxels read_magica_voxels(std::string_view bytes, const VoxelSource& source) {
  if (!bytes.starts_with("VOX ") || bytes.size() < kHeader + kChunk) source.fail("no file of MagicaVoxel");
  Voxels voxels;
  int models = 0;
  for (std::size_t at = kHeader; at < bytes.size();) {
    if (bytes.size() - at < kChunk) source.fail("a chunk is truncated");
    const std::string_view name = bytes.substr(at, 4);
    const std::size_t size = number_at<std::uint32_t>(bytes.substr(at + 4));
    at += kChunk;
    if (size > bytes.size() - at) source.fail("a chunk is truncated");
    const std::string_view content = bytes.substr(at, size);
    at += size;  // chunks within MAIN follow it
    if (name == "SIZE") {
      if (++models > 1) source.fail("it has several models; save one");
      if (size < 12) source.fail("its size is truncated");
      const auto x = number_at<std::uint32_t>(content), y = number_at<std::uint32_t>(content.substr(4)),
                 z = number_at<std::uint32_t>(content.substr(8));
      for (const std::uint32_t side : {x, y, z})
        if (side < 1 || side > kLargestModel)
          source.fail(fmt::format("a side of {} voxels; 1 to {} are read", side, kLargestModel));
      voxels.size = {static_cast<int>(x), static_cast<int>(z), static_cast<int>(y)};
      voxels.filled.assign(std::size_t{x} * y * z, source.is_filled(0) ? 1 : 0);
    }
    if (name == "XYZI") {
      if (voxels.filled.empty()) source.fail("its voxels come before its size");
      const std::size_t count = size < 4 ? 0 : number_at<std::uint32_t>(content);
      if (size < 4 || count != (size - 4) / 4)
        source.fail(fmt::format("{} voxels are not {} bytes", count, size));
      for (std::size_t i = 0; i < count; ++i) {
        const auto part = [&](std::size_t k) {
          return std::size_t{number_at<std::uint8_t>(content.substr(4 + 4 * i + k))};
        };
        const std::size_t x = part(0), y = part(2), back = part(1);
        const auto [nx, ny, nz] = voxels.size;
        if (x >= static_cast<std::size_t>(nx) || y >= static_cast<std::size_t>(ny) ||
            back >= static_cast<std::size_t>(nz))
          source.fail(fmt::format("voxel {} is at {}, {}, {}, outside of the model", i, x, back, y));
        const std::size_t z = nz - 1 - back;
        voxels.filled[x + nx * (y + ny * z)] = source.is_filled(static_cast<double>(part(3))) ? 1 : 0;
      }
    }
  }
  if (voxels.filled.empty()) source.fail("it has no model");
  return voxels;
}

}  // namespace voxmelt::scene
