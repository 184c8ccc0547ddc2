// Numbers are taken out of bytes, in either order.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>

namespace voxmelt::scene {

// Returns the number of which `bytes` begins. There must be enough of them.
template <class T>
T number_at(std::string_view bytes, bool is_big_endian = false) {
  using Bits = std::conditional_t<
      sizeof(T) == 1, std::uint8_t,
      std::conditional_t<sizeof(T) == 2, std::uint16_t,
                         std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>>>;
  static_assert(sizeof(T) == sizeof(Bits));
  Bits bits = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) {
    const auto byte = static_cast<unsigned char>(bytes[is_big_endian ? sizeof(T) - 1 - i : i]);
    bits = static_cast<Bits>(bits | static_cast<Bits>(Bits{byte} << (8 * i)));
  }
  return std::bit_cast<T>(bits);
}

}  // namespace voxmelt::scene
