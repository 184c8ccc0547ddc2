// Places of samples that the definition might take: rooks, no two in a row or a column, that err least over
// edges of any direction. They come from a search; docs/picture-error.md has the figures.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "render/rule/antialias.h"

namespace voxmelt::accuracy {

inline constexpr int kRookPixel = 64;  // units of a pixel

template <std::size_t kCount>
constexpr std::array<picture::Sub, kCount> rooks(const std::array<int, kCount>& rows) {
  constexpr int kUnit = kRookPixel / static_cast<int>(kCount);
  std::array<picture::Sub, kCount> of{};
  for (std::size_t i = 0; i < kCount; ++i)
    of[i] = {kUnit * static_cast<std::int32_t>(i) + kUnit / 2, kUnit * rows[i] + kUnit / 2};
  return of;
}

inline constexpr auto kRooks8 = rooks<8>({3, 6, 0, 5, 2, 7, 1, 4});
inline constexpr auto kRooks16 = rooks<16>({12, 2, 6, 9, 15, 3, 11, 8, 0, 4, 13, 7, 10, 1, 14, 5});
inline constexpr auto kRooks32 = rooks<32>({2,  15, 24, 28, 12, 4,  20, 16, 7,  22, 31, 1, 8,  14, 27, 11,
                                            19, 25, 30, 5,  21, 10, 3,  26, 17, 0,  13, 6, 23, 9,  29, 18});
inline constexpr std::array<picture::Sub, 1> kRookMiddle{{{32, 32}}};

}  // namespace voxmelt::accuracy
