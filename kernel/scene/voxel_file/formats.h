// Each format of volumes has a reader, which is given the whole file.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "kernel/scene/voxel_file/voxels.h"

namespace voxmelt::scene {

inline constexpr std::size_t kLargestVoxelFile = std::size_t{1} << 30;  // bytes, packed or not

Voxels read_npy_voxels(std::string_view bytes, const VoxelSource& source);
Voxels read_npz_voxels(std::string_view bytes, const VoxelSource& source);
Voxels read_nrrd_voxels(std::string_view bytes, const VoxelSource& source);
Voxels read_meta_image_voxels(std::string_view bytes, const VoxelSource& source);
Voxels read_magica_voxels(std::string_view bytes, const VoxelSource& source);
Voxels read_vdb_voxels(std::string_view bytes, const VoxelSource& source);

// A block of numbers of one type. A step is counted in numbers.
struct NumberBlock {
  enum class Type : std::uint8_t {
    int8,
    uint8,
    int16,
    uint16,
    int32,
    uint32,
    int64,
    uint64,
    float16,
    float32,
    float64
  };

  std::string_view bytes;
  Type type = Type::uint8;
  bool is_big_endian = false;
  std::array<std::uint64_t, 3> size{}, step{};  // along x, y and z

  double at(std::size_t index) const;
};
std::size_t bytes_of(NumberBlock::Type type);

// Returns the type of that many bytes, or nothing. `kind` is i, u, f or b as NumPy has them.
std::optional<NumberBlock::Type> number_type(char kind, std::size_t bytes);

// Sets the steps such that x runs fastest, then y.
void pack_steps(NumberBlock& block);
// Returns how many bytes the numbers take. It fails if a side is none of 1..4096, or if they are too many.
std::size_t checked_bytes(const NumberBlock& block, const VoxelSource& source);
// Fails unless there are just as many bytes, then asks of each number if it is filled.
Voxels voxels_of(const NumberBlock& block, const VoxelSource& source);

// Reads a file that another one names, beside it. Its name may lead elsewhere.
std::string read_beside(const VoxelSource& source, const std::string& name);

enum class Packing { gzip, zlib, deflate };
// Returns `size` bytes out of packed ones. It fails if there are fewer, or more.
std::string unpack(std::string_view packed, Packing packing, std::size_t size, const VoxelSource& source);

}  // namespace voxmelt::scene
