// Linear light becomes the bytes of a picture (docs/picture/light.md, sections 7 and 8).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "render/rule/look.h"

namespace voxmelt::picture {

// Light above 0.7 is pressed together, so that highlights keep their shape. It becomes 0.7 + 0.3 (1 - e^-x),
// with x = (light - 0.7) / 0.3. The powers are computed by repeated products.
inline constexpr std::int32_t kShoulder = 2867, kShoulderRange = 1229, kBrightest = 12287;

using Tone = std::array<std::uint16_t, kBrightest + 2>;  // one more, as packets read two at once
VOXMELT_RULE Tone tone_table() {
  constexpr std::int64_t kStep = 1072868508;  // e^(-1 / 1229) in 2^30
  Tone table{};
  std::int64_t left = std::int64_t{1} << 30;
  for (std::int32_t i = 0; i <= kBrightest; ++i) {
    if (i <= kShoulder) {
      table[i] = static_cast<std::uint16_t>(i);
      continue;
    }
    left = rounded(left * kStep, 30);
    table[i] = static_cast<std::uint16_t>(kShoulder + kShoulderRange - rounded(left * kShoulderRange, 30));
  }
  return table;
}

// The byte of linear light 0 .. kLight in sRGB is the number of these limits that it reaches. Limit b is
// kLight s((b + 1/2) / 255), rounded up, where s decodes sRGB.
inline constexpr std::array<std::int32_t, 255> kByteLimits{
    1,    2,    4,    5,    6,    7,    9,    10,   11,   12,   14,   15,   16,   18,   19,   21,   23,
    24,   26,   28,   30,   32,   34,   37,   39,   42,   44,   47,   49,   52,   55,   58,   61,   64,
    68,   71,   75,   78,   82,   85,   89,   93,   97,   102,  106,  110,  115,  119,  124,  129,  134,
    139,  144,  149,  154,  160,  165,  171,  177,  183,  189,  195,  201,  207,  214,  220,  227,  234,
    241,  248,  255,  262,  270,  277,  285,  293,  300,  309,  317,  325,  333,  342,  350,  359,  368,
    377,  386,  396,  405,  414,  424,  434,  444,  454,  464,  474,  485,  495,  506,  517,  528,  539,
    550,  562,  573,  585,  597,  609,  621,  633,  645,  658,  671,  683,  696,  709,  722,  736,  749,
    763,  777,  791,  805,  819,  833,  848,  862,  877,  892,  907,  922,  938,  953,  969,  985,  1001,
    1017, 1033, 1050, 1066, 1083, 1100, 1117, 1134, 1152, 1169, 1187, 1205, 1222, 1241, 1259, 1277, 1296,
    1315, 1334, 1353, 1372, 1391, 1411, 1430, 1450, 1470, 1491, 1511, 1531, 1552, 1573, 1594, 1615, 1636,
    1658, 1679, 1701, 1723, 1745, 1768, 1790, 1813, 1835, 1858, 1882, 1905, 1928, 1952, 1976, 2000, 2024,
    2048, 2073, 2097, 2122, 2147, 2172, 2197, 2223, 2249, 2274, 2300, 2327, 2353, 2380, 2406, 2433, 2460,
    2487, 2515, 2542, 2570, 2598, 2626, 2654, 2683, 2712, 2740, 2769, 2799, 2828, 2857, 2887, 2917, 2947,
    2977, 3008, 3038, 3069, 3100, 3131, 3163, 3194, 3226, 3258, 3290, 3322, 3354, 3387, 3420, 3453, 3486,
    3519, 3553, 3587, 3620, 3655, 3689, 3723, 3758, 3793, 3828, 3863, 3898, 3934, 3970, 4006, 4042, 4078,
};

using Bytes = std::array<std::uint8_t, kLight + 1>;
VOXMELT_RULE Bytes byte_table() {
  Bytes table{};
  std::size_t byte = 0;
  for (std::int32_t light = 0; light <= kLight; ++light) {
    while (byte < kByteLimits.size() && kByteLimits[byte] <= light) ++byte;
    table[light] = static_cast<std::uint8_t>(byte);
  }
  return table;
}

}  // namespace voxmelt::picture
