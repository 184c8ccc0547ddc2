// Single operations of one instruction set as plain functions on arrays, which a test calls from code that
// was compiled for every processor.
#pragma once

#include <cstddef>
#include <cstdint>

namespace voxmelt::cpu {

inline constexpr std::size_t kAllValues = 65536;

enum class RowOperation {
  high,
  low,
  product_high,  // of the 32-bit product
  product_low,
  unpack_high,  // of a + 65536 s
  unpack_low,
  dithered,  // friction: (a s + r) >> 16
  carried,   // the same by `carry`
  given,     // what falls: part s of a, s = 0..65536, and r more
  less,      // 1 or 0
  more,
  equal,
  min,
  max,
  add_saturated,
  sub_saturated,
  sub_saturated_from,
  mean,    // (a + s + 1) >> 1
  select,  // a < s ? r : a
  keep,    // a < s ? a : 0
  add_if,  // a < s ? a + r : a
  sub_if,
  temperature,  // of heat a; melting point s, latent heat r
  conducted,    // from s to a; weight r >> 16, dither r & 0xFFFF
  falling,      // a s >> 16 with dither r, of conduction
};

struct Operations {
  int count;  // lanes
  // One operation on 65536 values of a, aligned to 64 bytes.
  void (*row)(RowOperation, int s, int r, const std::uint16_t* a, std::uint16_t* out);
  void (*shift)(bool left, int by, const std::uint16_t* a, std::uint16_t* out);
  void (*lookup)(const std::uint16_t* table, const std::uint16_t* index, std::uint16_t* out);
  // 64 lanes from a word, and the word from the lanes. It checks `nonzero` too, and gives another word if
  // that is wrong.
  std::uint64_t (*bits)(std::uint64_t word, std::uint16_t* lanes);
  // n / d, n given by halves. `size` is a multiple of 64, here and below.
  void (*divide)(std::size_t size, const std::uint16_t* low, const std::uint16_t* high,
                 const std::uint16_t* d, std::uint16_t* quotient, std::uint16_t* remainder);
  // a b + c d, signed.
  void (*pair_product)(std::size_t size, const std::uint16_t* a, const std::uint16_t* b,
                       const std::uint16_t* c, const std::uint16_t* d, std::uint16_t* low,
                       std::uint16_t* high);
  void (*pair_sums)(std::size_t size, const std::uint16_t* a, const std::uint16_t* b, std::int32_t* out);
  void (*after)(std::size_t size, const std::uint16_t* previous, const std::uint16_t* current,
                std::uint16_t* out);
  // Vectors beginning at `at` - 1 and at `at` + 1; of bytes, too.
  void (*beside)(const std::uint16_t* at, std::uint16_t* left, std::uint16_t* right);
  void (*bytes_beside)(const std::uint8_t* at, std::uint16_t* left, std::uint16_t* right);
  std::uint64_t (*total)(std::size_t size, const std::uint16_t* a);
  std::uint64_t (*small_total)(std::size_t size, const std::uint16_t* a);  // of lanes below 32,768
  // The mean heat of two parts. Returns what was rounded, in lanes with a1 > 0.
  std::int64_t (*mix)(std::size_t size, int dither, const std::uint16_t* a0, const std::uint16_t* h0,
                      const std::uint16_t* a1, const std::uint16_t* h1, std::uint16_t* out);
  // For two neighbouring vectors, bit d of byte i is set unless a[d] < b[d] in that lane, and kept where
  // `keep` has a bit. The same is done by bits, with bit i for lane i. Returns the lanes with a byte that is
  // not 0, or the complement if the two ways differ.
  std::uint64_t (*bytes)(const std::uint16_t (*a)[64], const std::uint16_t (*b)[64], std::uint64_t keep,
                         std::uint8_t* bytes);
  // 64 bytes as lanes, lanes that have a bit (all ones), how many of their lowest four are set.
  void (*widen)(const std::uint8_t* bytes, int bit, std::uint16_t* lanes, std::uint16_t* has,
                std::uint16_t* count);
  // The bytes of two pairs of vectors of `count` cells.
  void (*dice)(const std::uint32_t* keys, std::uint32_t step, const std::uint32_t* blocks,
               std::uint8_t* bytes);
};

// The operations, compiled for an architecture of xsimd (lane_loops.h).
template <class Arch>
Operations operations_for();

}  // namespace voxmelt::cpu
