#include <fmt/format.h>
#include <libdeflate.h>

#include <cstddef>
#include <memory>
#include <new>
#include <string>
#include <string_view>

#include "kernel/scene/voxel_file/formats.h"

namespace voxmelt::scene {
namespace {

constexpr std::size_t kMostTimes = 1032;  // what a byte of deflate can become

}  // namespace

std::string unpack(std::string_view packed, Packing packing, std::size_t size, const VoxelSource& source) {
  const auto fail = [&] {
    source.fail(fmt::format("its packed numbers are not {} bytes, or damaged: is it truncated?", size));
  };
  if (size / kMostTimes > packed.size()) fail();  // before memory is taken for them
  std::string bytes(size, '\0');
  const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)> decompressor(
      libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
  if (decompressor == nullptr) throw std::bad_alloc();
  auto* const unpacking = packing == Packing::gzip   ? libdeflate_gzip_decompress
                          : packing == Packing::zlib ? libdeflate_zlib_decompress
                                                     : libdeflate_deflate_decompress;
  if (unpacking(decompressor.get(), packed.data(), packed.size(), bytes.data(), bytes.size(), nullptr) !=
      LIBDEFLATE_SUCCESS)
    fail();
  return bytes;
}

}  // namespace voxmelt::scene
