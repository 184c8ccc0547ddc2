#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "kernel/scene/text/bytes.h"
#include "kernel/scene/voxel_file/formats.h"

namespace voxmelt::scene {
namespace {

using Type = NumberBlock::Type;
constexpr std::uint64_t kLargestSide = 4096;

// A half: a sign, 5 bits of exponent, 10 of fraction.
double half(std::uint16_t bits) {
  const int exponent = bits >> 10 & 31, fraction = bits & 1023;
  double value = 0;
  if (exponent == 31)
    value = fraction == 0 ? INFINITY : NAN;
  else if (exponent == 0)
    value = std::ldexp(fraction, -24);
  else
    value = std::ldexp(1024 + fraction, exponent - 25);
  return bits >> 15 != 0 ? -value : value;
}

}  // namespace

std::size_t bytes_of(Type type) {
  switch (type) {
    case Type::int8:
    case Type::uint8:
      return 1;
    case Type::int16:
    case Type::uint16:
    case Type::float16:
      return 2;
    case Type::int32:
    case Type::uint32:
    case Type::float32:
      return 4;
    default:
      return 8;
  }
}

std::optional<Type> number_type(char kind, std::size_t bytes) {
  constexpr std::array whole{Type::int8, Type::int16, Type::int32, Type::int64};
  constexpr std::array counting{Type::uint8, Type::uint16, Type::uint32, Type::uint64};
  std::size_t power = 0;  // of two
  while (power < 3 && std::size_t{1} << power < bytes) ++power;
  if (std::size_t{1} << power != bytes) return std::nullopt;
  if (kind == 'b' && bytes == 1) return Type::uint8;
  if (kind == 'i') return whole[power];
  if (kind == 'u') return counting[power];
  if (kind == 'f' && bytes == 2) return Type::float16;
  if (kind == 'f' && bytes == 4) return Type::float32;
  if (kind == 'f' && bytes == 8) return Type::float64;
  return std::nullopt;
}

double NumberBlock::at(std::size_t index) const {
  const std::string_view from = bytes.substr(index * bytes_of(type));
  const bool big = is_big_endian;
  switch (type) {
    case Type::int8:
      return number_at<std::int8_t>(from, big);
    case Type::uint8:
      return number_at<std::uint8_t>(from, big);
    case Type::int16:
      return number_at<std::int16_t>(from, big);
    case Type::uint16:
      return number_at<std::uint16_t>(from, big);
    case Type::int32:
      return number_at<std::int32_t>(from, big);
    case Type::uint32:
      return number_at<std::uint32_t>(from, big);
    case Type::int64:
      return static_cast<double>(number_at<std::int64_t>(from, big));
    case Type::uint64:
      return static_cast<double>(number_at<std::uint64_t>(from, big));
    case Type::float16:
      return half(number_at<std::uint16_t>(from, big));
    case Type::float32:
      return number_at<float>(from, big);
    case Type::float64:
      break;
  }
  return number_at<double>(from, big);
}

void pack_steps(NumberBlock& block) { block.step = {1, block.size[0], block.size[0] * block.size[1]}; }

std::size_t checked_bytes(const NumberBlock& block, const VoxelSource& source) {
  std::uint64_t bytes = bytes_of(block.type);
  for (const std::uint64_t side : block.size) {
    if (side < 1 || side > kLargestSide)
      source.fail(fmt::format("a side of {} voxels; 1 to {} are read", side, kLargestSide));
    bytes *= side;
  }
  if (bytes > kLargestVoxelFile)
    source.fail(fmt::format("{} bytes of numbers; at most {} are read", bytes, kLargestVoxelFile));
  return bytes;
}

Voxels voxels_of(const NumberBlock& block, const VoxelSource& source) {
  const std::size_t wanted = checked_bytes(block, source);
  if (block.bytes.size() != wanted)
    source.fail(fmt::format("{} x {} x {} numbers are {} bytes, and it has {}{}", block.size[0],
                            block.size[1], block.size[2], wanted, block.bytes.size(),
                            block.bytes.size() < wanted ? ": is it truncated?" : ""));
  Voxels voxels;
  for (std::size_t axis = 0; axis < 3; ++axis) voxels.size[axis] = static_cast<int>(block.size[axis]);
  voxels.filled.reserve(block.size[0] * block.size[1] * block.size[2]);
  for (std::uint64_t z = 0; z < block.size[2]; ++z)
    for (std::uint64_t y = 0; y < block.size[1]; ++y)
      for (std::uint64_t x = 0; x < block.size[0]; ++x)
        voxels.filled.push_back(
            source.is_filled(block.at(x * block.step[0] + y * block.step[1] + z * block.step[2])) ? 1 : 0);
  return voxels;
}

}  // namespace voxmelt::scene
